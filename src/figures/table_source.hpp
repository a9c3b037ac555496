#pragma once
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "common/figure_table.hpp"
#include "common/toml_reader.hpp"

namespace chute {
class KeyLister;
}
namespace chute::figures {

/// Which rows of a table count: those whose column lies in [low, high), or holds a text.
struct RowFilter {
  std::string column;
  std::optional<std::string> is;
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
};

/// How the columns of any table become rows of a figure: `y = "v_x"`. Without `y` the table has a figure's columns already.
struct TableColumns {
  std::string panel;
  std::string series;             ///< the series' name, default that of the y column
  std::optional<std::string> by;  ///< a column: a series for each of its values, in the order of the table
  std::string x = "time", y;
  std::optional<std::string> z;  ///< of a map: a series "z y=…" of it over x for each value of y
  std::optional<std::string> x_err, y_err;
  std::vector<RowFilter> where;
};
/// The keys beside `table` of [data].
void describe(TomlReader& a, TableColumns& columns);
void describe(KeyLister& a, TableColumns& columns);

/// Lines for a figure's table where a file of averages says that no steady state was found: its own line, with the names of the series
/// that are drawn from it, and that these are drawn hollow. Empty if it says nothing of that.
std::vector<std::string> doubts(const std::vector<std::string>& comments, const std::string& panel,
                                const std::vector<std::string>& names);

/// What the names of a map's series begin with, "z y=": the value of y follows.
std::string series_of_map(const TableColumns& columns);

/// The rows of a table. InputError that names the file and the nearest column if one is not there.
FigureTable rows_of_table(const TableColumns& columns, const std::filesystem::path& file);

/// A formula drawn as a line: keys beside `expression` of [data].
struct FormulaCurve {
  std::string panel, series;
  std::string expression;
  std::vector<double> range;  ///< of x
  bool logarithmic = false;   ///< places of x are evenly spaced in ln x
  std::int64_t points = 200;
};
void describe(TomlReader& a, FormulaCurve& curve);
void describe(KeyLister& a, FormulaCurve& curve);
FigureTable rows_of_formula(const FormulaCurve& curve);

}  // namespace chute::figures
