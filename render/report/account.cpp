#include "report/account.hpp"

#include <algorithm>
#include <cmath>

namespace chute::report {
namespace {

struct Line {
  const char *column, *name;
};
constexpr Line in_lines[] = {{"gravity_work", "work of gravity"},
                             {"wall_work", "work of moving walls"},
                             {"projection_work", "moving pressed grains apart"},
                             {"energy_in", "grains that came in"}};
constexpr Line kept_lines[] = {
    {"translation", "translation"}, {"rotation", "rotation"}, {"elastic", "elastic energy"}};
constexpr Line lost_lines[] = {{"normal_loss", "normal dissipation"},
                               {"shear_loss", "tangential dissipation"},
                               {"energy_out", "grains that left"}};

}  // namespace

double EnergyAccount::total_in() const {
  double sum = 0;
  for (const auto& entry : in) sum += entry.amount;
  return sum;
}

std::optional<EnergyAccount> account_of(const RunFiles& run) {
  const auto table = run.table("series.csv");
  if (!table || !table->has("gravity_work") || !table->has("residual")) return {};
  bool anything = false;
  const auto change = [&](const char* column) {
    if (!table->has(column)) return 0.0;
    const auto values = table->column(column);
    anything = anything ||
               std::any_of(values.begin(), values.end(), [](double v) { return v != 0 && !std::isnan(v); });
    return values.back() - values.front();
  };
  EnergyAccount account;
  for (const auto& line : in_lines) account.in.push_back({line.name, change(line.column)});
  for (const auto& line : kept_lines) account.kept.push_back({line.name, change(line.column)});
  for (const auto& line : lost_lines) account.lost.push_back({line.name, change(line.column)});
  account.residual = change("residual");
  if (!anything) return {};
  return account;
}

}  // namespace chute::report
