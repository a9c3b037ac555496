#include "figures/ratios.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/keys.hpp"

namespace chute::figures {
namespace {

std::vector<FigureRow> rows_of(const FigureTable& table, const std::string& panel,
                               const std::string& series) {
  std::vector<FigureRow> rows;
  for (const auto& row : table.rows)
    if (row.panel == panel && row.series == series) rows.push_back(row);
  std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  return rows;
}

/// y at x, linearly between the rows; empty outside.
std::optional<FigureRow> row_at(const std::vector<FigureRow>& rows, double x) {
  // as far as sums of steps differ in their last digits
  const double same = 1e-9 * std::max(std::abs(x), 1e-300);
  const auto after =
      std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.x >= x - same; });
  if (after == rows.end()) return {};
  if (std::abs(after->x - x) <= same) return *after;
  if (after == rows.begin()) return {};
  const auto before = std::prev(after);
  FigureRow between = *before;
  between.x = x, between.y += (after->y - before->y) * (x - before->x) / (after->x - before->x);
  return between;
}

}  // namespace

template <class Archive>
static void describe_keys(Archive& a, Ratio& ratio) {
  a.required("panel", ratio.panel, "where the quotients are drawn");
  a.required("of", ratio.of, "the panel of the series");
  a.required("series", ratio.series, "which are divided");
  a.value("over", ratio.over, "the panel of what they are divided by; default the same");
  a.value("by", ratio.by, "the series that they are divided by; default the one of their own name");
}
void describe(KeyLister& a, Ratio& ratio) { describe_keys(a, ratio); }
void describe(TomlReader& a, Ratio& ratio) {
  describe_keys(a, ratio);
  a.check(ratio.over || ratio.by, "by",
          "say by which series, or with `over` by those of which panel, they are divided");
}

void draw_ratio(const Ratio& ratio, FigureTable& table) {
  std::size_t without = 0;
  for (const auto& name : ratio.series) {
    const auto divisor = rows_of(table, ratio.over.value_or(ratio.of), ratio.by.value_or(name));
    for (const auto& row : rows_of(table, ratio.of, name)) {
      const auto by = row_at(divisor, row.x);
      if (!by || by->y == 0) {
        ++without;
        continue;
      }
      FigureRow quotient{ratio.panel, name, row.x, row.y / by->y};
      const double own = row.y_err.value_or(0) / by->y,
                   others = by->y_err.value_or(0) * row.y / (by->y * by->y);
      if (row.y_err || by->y_err) quotient.y_err = std::hypot(own, others);
      table.rows.push_back(quotient);
    }
  }
  table.comments.push_back(fmt::format("{}: series of {} divided by {}{}{}", ratio.panel, ratio.of,
                                       ratio.by ? *ratio.by : "the same",
                                       ratio.over ? " of " + *ratio.over : "",
                                       without ? fmt::format("; {} points have no divisor", without) : ""));
}

}  // namespace chute::figures
