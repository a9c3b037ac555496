#include "view/time_series.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "common/error.hpp"
#include "common/toml_reader.hpp"
#include "plot/legend.hpp"
#include "read/table.hpp"

namespace chute::view {
namespace {

/// A column of series.csv: what it is, and its unit in both systems.
struct Known {
  std::string_view name, title, si, reduced;
};
constexpr std::string_view joule = "J", energy = "mgd", speed = "m/s", reduced_speed = "\\sqrt{gd}";
constexpr std::array known{
    Known{"x", "mean distance $\\bar{x}$", "m", "d"},
    Known{"v_x", "mean velocity $\\bar{v}_x$", speed, reduced_speed},
    Known{"v_y", "mean velocity $\\bar{v}_y$", speed, reduced_speed},
    Known{"omega", "mean spin $\\bar{\\omega}$", "rad/s", "\\sqrt{g/d}"},
    Known{"contacts", "number of contacts", "", ""},
    Known{"translation", "energy of translation", joule, energy},
    Known{"rotation", "energy of rotation", joule, energy},
    Known{"elastic", "elastic energy", joule, energy},
    Known{"gravity_work", "work of gravity", joule, energy},
    Known{"normal_loss", "normal dissipation", joule, energy},
    Known{"shear_loss", "tangential dissipation", joule, energy},
    Known{"residual", "residual of the energy account", joule, energy},
};

}  // namespace

std::string column_title(const std::string& column, const std::string& units) {
  for (const auto& k : known) {
    if (k.name != column) continue;
    if (units == "SI" && !k.si.empty()) return fmt::format("{} ({})", k.title, k.si);
    if (units == "reduced" && !k.reduced.empty()) return fmt::format("{} (${}$)", k.title, k.reduced);
    return std::string(k.title);
  }
  return plot::label_from_name(column);
}

TimeSeries read_time_series(const std::filesystem::path& path, const std::vector<std::string>& columns) {
  const auto table = read::read_table(path);
  for (const auto& name : columns)
    if (!table.has(name)) {
      const auto hint = nearest(name, table.header);
      throw InputError(fmt::format("{}: no column \"{}\"{}", path.string(), name,
                                   hint.empty() ? "" : fmt::format(", did you mean \"{}\"?", hint)));
    }
  TimeSeries series;
  series.times = table.column(table.header.front());  // the clock: time, shakes, sweeps …
  if (series.times.size() < 2)
    throw InputError(
        fmt::format("{}: {} rows, a curve needs two at least", path.string(), series.times.size()));
  for (std::size_t i = 0; i < series.times.size(); ++i)
    if (!std::isfinite(series.times[i]) || (i > 0 && !(series.times[i] > series.times[i - 1])))
      throw InputError(fmt::format("{}:{}: time must rise from row to row", path.string(), table.lines[i]));
  for (const auto& name : columns) series.columns.push_back({name, table.column(name)});
  return series;
}

}  // namespace chute::view
