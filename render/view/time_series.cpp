#include "view/time_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/columns.hpp"
#include "common/error.hpp"
#include "common/fields.hpp"
#include "common/toml_reader.hpp"
#include "plot/legend.hpp"
#include "read/table.hpp"

namespace chute::view {
std::string column_title(const std::string& column, const std::string& units) {
  for (const auto& known : columns::series) {
    if (known.name != column) continue;
    if (units == "SI" && !known.si_unit.empty()) return fmt::format("{} ({})", known.label, known.si_unit);
    if (units == "reduced" && !known.reduced.empty())
      return fmt::format("{} (${}$)", known.label, known.reduced);
    return std::string(known.label);
  }
  return plot::label_from_name(column);
}

TimeSeries read_time_series(const std::filesystem::path& path, const std::vector<std::string>& names) {
  const auto table = read::read_table(path);
  for (const auto& name : names)
    if (!table.has(name)) {
      const auto hint = nearest(name, table.header);
      throw InputError(fmt::format("{}: no column \"{}\"{}", path.string(), name,
                                   hint.empty() ? "" : fmt::format(", did you mean \"{}\"?", hint)));
    }
  TimeSeries series;
  const auto clock = std::ranges::find_if(
      fields::clocks, [&](std::string_view word) { return table.has(std::string(word)); });
  if (clock != fields::clocks.end()) series.clock = *clock;
  series.times = table.column(series.clock);
  if (series.times.size() < 2)
    throw InputError(
        fmt::format("{}: {} rows, a curve needs two at least", path.string(), series.times.size()));
  for (std::size_t i = 0; i < series.times.size(); ++i)
    if (!std::isfinite(series.times[i]) || (i > 0 && !(series.times[i] > series.times[i - 1])))
      throw InputError(fmt::format("{}:{}: time must rise from row to row", path.string(), table.lines[i]));
  for (const auto& name : names) series.columns.push_back({name, table.column(name)});
  return series;
}

}  // namespace chute::view
