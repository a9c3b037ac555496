#include "app/compare_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "read/table.hpp"

namespace chute::app {

std::string TableComparison::summary() const {
  if (!shape.empty()) return "different: " + shape;
  if (over == 0) return fmt::format("same: {} cells", cells);
  return fmt::format("different: {} of {} cells, the worst in {}", over, cells, worst_at);
}

TableComparison compare_tables(const std::filesystem::path& expected, const std::filesystem::path& actual,
                               double rtol, double atol) {
  const auto before = read::read_table(expected), after = read::read_table(actual);
  TableComparison found;
  for (const auto& name : before.header)
    if (!after.has(name)) found.shape = fmt::format("column {} is missing", name);
  for (const auto& name : after.header)
    if (found.shape.empty() && !before.has(name)) found.shape = fmt::format("column {} is new", name);
  if (found.shape.empty() && before.rows.size() != after.rows.size())
    found.shape = fmt::format("{} rows, expected {}", after.rows.size(), before.rows.size());
  if (!found.shape.empty()) return found;
  const auto differs = [&](double by, std::size_t row, const std::string& name, const std::string& a,
                           const std::string& b) {
    ++found.over;
    if (by <= found.worst) return;
    found.worst = by;
    found.worst_at = fmt::format("line {}, {}: {} and {}", after.lines[row], name, a, b);
  };
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const auto& name : before.header) {
    const auto a = before.text(name), b = after.text(name);
    found.cells += a.size();
    const bool numbers = before.is_number(name) && after.is_number(name);
    const auto x = numbers ? before.column(name) : std::vector<double>{},
               y = numbers ? after.column(name) : std::vector<double>{};
    for (std::size_t row = 0; row < a.size(); ++row) {
      if (!numbers) {
        if (a[row] != b[row]) differs(infinite, row, name, a[row], b[row]);
        continue;
      }
      if (x[row] == y[row] || (std::isnan(x[row]) && std::isnan(y[row]))) continue;
      const double allowed = atol + rtol * std::abs(x[row]), off = std::abs(x[row] - y[row]);
      if (off <= allowed) continue;
      differs(std::isfinite(off) ? off / std::max(allowed, std::numeric_limits<double>::min()) : infinite,
              row, name, a[row], b[row]);
    }
  }
  return found;
}

}  // namespace chute::app
