#pragma once
#include <optional>
#include <string>
#include <vector>

#include "common/figure_table.hpp"
#include "common/toml_reader.hpp"

namespace chute {
class KeyLister;
}
namespace chute::figures {

/// A law with two constants that is put through series of a figure, drawn as one more series, and told with the errors of
/// its constants in the figure's comments. [[data.fit]]
struct Fit {
  std::string panel, series;    ///< of the line that is drawn
  std::vector<std::string> of;  ///< the series of this panel that it is put through, taken together
  enum class Form {
    power,        ///< y = c x^k
    exponential,  ///< y = c exp(k x)
    line,         ///< y = c + k x
    expression    ///< y = `expression`, whose parameters begin at `start`
  } form = Form::power;
  std::string expression;
  std::vector<std::string> start;  ///< NAME=VALUE, one for each parameter
  bool legend = false;             ///< the constants with their errors stand in the legend
  std::vector<double> factors;     ///< power: of each series a factor F, such as a size ratio: y = c x^k F^n
  std::optional<std::vector<double>> range;        ///< only points with x in it, [low, high]
  std::optional<std::vector<double>> quick_range;  ///< of a quick figure, where its flows are smaller
};
void describe(TomlReader& a, Fit& fit);
void describe(KeyLister& a, Fit& fit);

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
/// A point of a series with its factor; the error of y where it is known.
struct FitPoint {
  double x, y, factor;
  std::optional<double> y_err{};
};

/// A formula put through points.
struct FittedFormula {
  std::vector<std::string> names;   ///< of its parameters
  std::vector<Constant> constants;  ///< theirs
  double misfit = 0;                ///< root mean square of y − formula
};
/// Least squares by Levenberg and Marquardt from `start`, weighted by 1/y_err² where all errors are known and above 0; errors of the constants from
/// the scatter of the points about the formula. Empty where the points are not more than the parameters, or it does not
/// converge. InputError if the formula cannot be read.
std::optional<FittedFormula> fit_formula(const Fit& fit, const std::vector<FitPoint>& points);

/// "0.301 \\pm 0.004": the error with one digit, two where that is a 1, and the value to the same place.
std::string with_error(const Constant& constant);

/// Least squares in ln y over ln x or x, or in y over x, the points counting alike; errors from their scatter, so three points
/// are needed, and one more with factors. Empty with fewer, or where a logarithm does not exist;
/// draw_fit leaves points with y ≤ 0 out before.
std::optional<Fitted> fit_law(const Fit& fit, const std::vector<FitPoint>& points);

/// Adds a label of the legend with the constants, if that is asked for. Adds the law through the points of the table to it: a line over their range and a comment. Only a comment where the points
/// are too few, or where factors tell series apart.
void draw_fit(const Fit& fit, FigureTable& table);
/// The same fit as a quick figure has it.
Fit quick_of(Fit fit);

}  // namespace chute::figures
