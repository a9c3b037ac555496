#include "figures/table_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/column_texts.hpp"
#include "common/error.hpp"
#include "common/keys.hpp"
#include "common/not_settled.hpp"
#include "figures/formula.hpp"
#include "read/table.hpp"

namespace chute::figures {

template <class Archive>
static void describe_filter(Archive& a, RowFilter& filter) {
  a.required("column", filter.column, "whose cells decide");
  a.value("is", filter.is, "rows that hold this text");
  a.value("low", filter.low, "rows whose number is not below; default none");
  a.value("high", filter.high, "rows whose number is below; default none");
}
static void describe(TomlReader& a, RowFilter& filter) { describe_filter(a, filter); }
static void describe(KeyLister& a, RowFilter& filter) { describe_filter(a, filter); }

namespace {

template <class Archive>
void describe_columns(Archive& a, TableColumns& columns) {
  a.value("panel", columns.panel, "of the rows");
  a.value("series", columns.series, "name of the series; default the y column's");
  a.value("by", columns.by, "a column: a series for each of its values, numbers or texts such as verdicts");
  a.value("x", columns.x, "column of x");
  a.value("y", columns.y,
          "column of y; left out: the table has the columns of a figure (panel, series, x, y …)");
  a.value(
      "z", columns.z,
      "column of a map over x and y: for each y a series \"z y=…\", which [plot.panel.map] makes its rows");
  a.value("x_err", columns.x_err, "column of the error of x");
  a.value("y_err", columns.y_err, "column of the error of y");
  a.sections("where", columns.where);
}

template <class Archive>
void describe_formula(Archive& a, FormulaCurve& curve) {
  a.value("panel", curve.panel, "of the line");
  a.required("series", curve.series, "its name");
  a.required("expression", curve.expression,
             "a formula of x for a line, read by muParser: \"0.3*(1-exp(-x/2))\"");
  a.required("range", curve.range, "[low, high] of x");
  a.value("logarithmic", curve.logarithmic, "places evenly spaced in ln x");
  a.value("points", curve.points, between(2, 100000), "of the line");
  a.check(curve.range.size() == 2 && curve.range[0] < curve.range[1], "range",
          "must be [low, high] with low < high");
  a.check(!curve.logarithmic || curve.range[0] > 0, "range", "must be above 0 with logarithmic = true");
}

}  // namespace

void describe(TomlReader& a, TableColumns& columns) {
  describe_columns(a, columns);
  a.check(!columns.z || (!columns.y.empty() && !columns.by && !columns.x_err && !columns.y_err), "z",
          "goes with x, y and where; a map has one series for each y, and no errors");
  a.check(!columns.y.empty() || (!columns.by && columns.where.empty() && columns.series.empty()), "y",
          "missing: which column is drawn?");
}
void describe(KeyLister& a, TableColumns& columns) { describe_columns(a, columns); }

void describe(TomlReader& a, FormulaCurve& curve) {
  describe_formula(a, curve);
  try {
    const Formula right(curve.expression);
  } catch (const InputError& error) {
    a.fail("expression", error.what());
  }
}
void describe(KeyLister& a, FormulaCurve& curve) { describe_formula(a, curve); }

namespace {

/// A table with the columns that figures have.
FigureTable plain_rows(const read::Table& table) {
  const auto x = table.values("x"), y = table.values("y");
  const auto series = table.text("series");
  const auto optional = [&](const char* name) {
    return table.has(name) ? table.column(name) : std::vector<double>(x.size(), NAN);
  };
  const auto x_err = optional("x_err"), y_err = optional("y_err");
  const auto panel = table.has("panel") ? table.text("panel") : std::vector<std::string>(x.size());
  const auto known = [](double v) { return std::isfinite(v) ? std::optional(v) : std::nullopt; };
  FigureTable made;
  made.comments = table.comments;
  made.x_times = table.is_time("x"), made.y_times = table.is_time("y");
  for (std::size_t i = 0; i < x.size(); ++i)
    made.rows.push_back({panel[i], series[i], x[i], y[i], known(x_err[i]), known(y_err[i])});
  return made;
}

/// A name of a series may not hold what divides cells of a figure's table.
std::string as_name(std::string text) {
  for (char& c : text)
    if (c == ',' || c == '"' || c == '\n') c = ' ';
  return text;
}

/// What a key is called in names of series: its last word.
std::string last_word(const std::string& column) { return column.substr(column.rfind('.') + 1); }

/// A map: each value of y is a series, whose name ends with it.
FigureTable rows_of_map(const TableColumns& columns, const read::Table& table,
                        const std::filesystem::path& file, const std::vector<bool>& counts) {
  const auto x = table.values(columns.x), y = table.column(columns.y), z = table.column(*columns.z);
  const std::string name = series_of_map(columns);
  FigureTable made;
  made.comments = {fmt::format("{}…: {} over {} and {} of {}, a series for each {}", name, *columns.z,
                               columns.x, columns.y, file.string(), columns.y)};
  made.x_times = table.is_time(columns.x);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (counts[i] && std::isfinite(x[i]) && std::isfinite(y[i]) && std::isfinite(z[i]))
      made.rows.push_back({columns.panel, as_name(fmt::format("{}{}", name, y[i])), x[i], z[i]});
  if (made.rows.empty())
    throw InputError(fmt::format("{}: no row has numbers in {}, {} and {}{}", file.string(), columns.x,
                                 columns.y, *columns.z,
                                 columns.where.empty() ? "" : " and passes what `where` asks"));
  return made;
}

}  // namespace

std::vector<std::string> doubts(const std::vector<std::string>& comments, const std::string& panel,
                                const std::vector<std::string>& names) {
  const auto said =
      std::ranges::find_if(comments, [](const std::string& line) { return line.starts_with(not_settled); });
  std::vector<std::string> lines;
  if (said == comments.end()) return lines;
  for (const auto& name : names) {
    lines.push_back(name + ": " + *said);
    lines.push_back(fmt::format("hollow{}: {}", panel.empty() ? "" : " " + panel, name));
  }
  return lines;
}

std::string series_of_map(const TableColumns& columns) {
  return (columns.series.empty() ? last_word(*columns.z) : columns.series) + " " + last_word(columns.y) + "=";
}

FigureTable rows_of_table(const TableColumns& columns, const std::filesystem::path& file) {
  const auto table = read::read_table(file);
  if (columns.y.empty()) return plain_rows(table);
  const auto x = table.values(columns.x), y = table.values(columns.y);
  const auto errors = [&](const std::optional<std::string>& name) {
    return name ? table.column(*name) : std::vector<double>(x.size(), NAN);
  };
  const auto x_err = errors(columns.x_err), y_err = errors(columns.y_err);
  std::vector<std::string> names(x.size(), columns.series.empty() ? columns.y : columns.series);
  if (columns.by) {
    const auto values = table.text(*columns.by);
    // Numbers are named after their key's last word: size_ratio=2.25.
    const auto word = last_word(*columns.by);
    const bool number = table.is_number(*columns.by);
    for (std::size_t i = 0; i < names.size(); ++i)
      names[i] =
          (columns.series.empty() ? "" : columns.series + " ") + (number ? word + "=" : "") + values[i];
  }
  std::vector<bool> counts(x.size(), true);
  for (const auto& filter : columns.where) {
    if (filter.is) {
      const auto texts = table.text(filter.column);
      for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = counts[i] && texts[i] == *filter.is;
    }
    if (std::isinf(filter.low) && std::isinf(filter.high)) continue;
    const auto numbers = table.column(filter.column);
    for (std::size_t i = 0; i < counts.size(); ++i)
      counts[i] = counts[i] && numbers[i] >= filter.low && numbers[i] < filter.high;
  }
  if (columns.z) return rows_of_map(columns, table, file, counts);
  FigureTable made;
  made.comments = {fmt::format("{}: {} over {} of {}{}", columns.series.empty() ? columns.y : columns.series,
                               columns.y, columns.x, file.string(),
                               columns.by ? ", a series for each " + *columns.by : "")};
  for (auto& line : column_lines(file.filename().string(), {columns.x, columns.y, columns.x_err.value_or(""),
                                                            columns.y_err.value_or("")}))
    made.comments.push_back(std::move(line));
  made.x_times = table.is_time(columns.x), made.y_times = table.is_time(columns.y);
  const auto known = [](double v) { return std::isfinite(v) ? std::optional(v) : std::nullopt; };
  for (std::size_t i = 0; i < x.size(); ++i)
    if (counts[i] && std::isfinite(x[i]) && std::isfinite(y[i]))
      made.rows.push_back({columns.panel, as_name(names[i]), x[i], y[i], known(x_err[i]), known(y_err[i])});
  std::vector<std::string> drawn;
  for (const auto& row : made.rows)
    if (std::ranges::find(drawn, row.series) == drawn.end()) drawn.push_back(row.series);
  for (auto& line : doubts(table.comments, columns.panel, drawn)) made.comments.push_back(std::move(line));
  if (made.rows.empty())
    throw InputError(fmt::format("{}: no row has numbers in {} and {}{}", file.string(), columns.x, columns.y,
                                 columns.where.empty() ? "" : " and passes what `where` asks"));
  return made;
}

FigureTable rows_of_formula(const FormulaCurve& curve) {
  const Formula formula(curve.expression);
  FigureTable made;
  made.comments = {fmt::format("{}: {}", curve.series, curve.expression)};
  const double low = curve.range[0], high = curve.range[1];
  for (std::int64_t k = 0; k < curve.points; ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(curve.points - 1);
    const double x = curve.logarithmic ? low * std::pow(high / low, part) : low + part * (high - low);
    if (const double y = formula.at(x); std::isfinite(y))
      made.rows.push_back({curve.panel, curve.series, x, y});
  }
  if (made.rows.empty())
    throw InputError(fmt::format("expression: \"{}\" has no value in [{}, {}]", curve.expression, low, high));
  return made;
}

}  // namespace chute::figures
