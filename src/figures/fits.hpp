#pragma once
#include <optional>
#include <string>
#include <vector>

#include "common/figure_table.hpp"
#include "common/toml_reader.hpp"

namespace chute::figures {

/// A law with two constants that is put through series of a figure, drawn as one more series, and told with the errors of
/// its constants in the figure's comments. [[data.fit]]
struct Fit {
  std::string panel, series;    ///< of the line that is drawn
  std::vector<std::string> of;  ///< the series of this panel that it is put through, taken together
  enum class Form {
    power,        ///< y = c x^k
    exponential,  ///< y = c exp(k x)
    line          ///< y = c + k x
  } form = Form::power;
  std::vector<double> factors;  ///< power: of each series a factor F, such as a size ratio: y = c x^k F^n
  std::optional<std::vector<double>> range;  ///< only points with x in it, [low, high]
};
void describe(TomlReader& a, Fit& fit);

/// One constant and its standard error.
struct Constant {
  double value = 0, error = 0;
};
/// c, k and, with factors, n; and how far points lie from the law: the root mean square of ln y − ln law, or, of a line, of
/// y − law.
struct Fitted {
  Constant c, k, n;
  double misfit = 0;
};
/// A point of a series with its factor.
struct FitPoint {
  double x, y, factor;
};

/// Least squares in ln y over ln x or x, or in y over x, the points counting alike; errors from their scatter, so three points
/// are needed, and one more with factors. Empty with fewer, or where a logarithm does not exist;
/// draw_fit leaves points with y ≤ 0 out before.
std::optional<Fitted> fit_law(const Fit& fit, const std::vector<FitPoint>& points);

/// Adds the law through the points of the table to it: a line over their range and a comment. Only a comment where the points
/// are too few, or where factors tell series apart.
void draw_fit(const Fit& fit, FigureTable& table);

}  // namespace chute::figures
