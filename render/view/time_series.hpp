#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace chute::view {

/// Columns of a table against time, for the plot beside the grains.
struct TimeSeries {
  struct Column {
    std::string name;
    std::vector<double> values;  ///< one per time; NaN where not known
  };
  std::string clock = "time";  ///< the column that the others are told against (fields::clocks)
  std::vector<double> times;   ///< rising
  std::vector<Column> columns;

  bool empty() const { return columns.empty(); }
};

/// Reads the columns `names` of a table that has a column `time`, such as a run's series.csv. InputError, one line that
/// names the file, if a column is missing (with the nearest name), there are fewer than two rows, or times do
/// not rise.
TimeSeries read_time_series(const std::filesystem::path& table, const std::vector<std::string>& names);

/// What an axis or a legend says of a column, with its unit: "mean velocity $\\bar{v}_x$ ($\\sqrt{gd}$)".
/// `units` as in VTK files; a column that chute does not write keeps its name.
std::string column_title(const std::string& column, const std::string& units);

}  // namespace chute::view
