#include "figures/fits.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include "common/error.hpp"
#include "common/keys.hpp"
#include "figures/formula.hpp"

namespace chute::figures {
namespace {
using namespace std::string_view_literals;
using Form = Fit::Form;
constexpr std::array form_words{"power"sv, "exponential"sv, "line"sv, "expression"sv};

double abscissa(Form form, double x) { return form == Form::power ? std::log(x) : x; }
double ordinate(Form form, double y) { return form == Form::line ? y : std::log(y); }

struct Parameters {
  std::vector<std::string> names;
  std::vector<double> values;
};

/// InputError if they are not of the form NAME=VALUE, or the formula does not go with them.
Parameters parameters_of(const Fit& fit) {
  Parameters found;
  for (const auto& text : fit.start) {
    const auto equals = text.find('=');
    double value = 0;
    const char* end = text.data() + text.size();
    if (equals == 0 || equals == text.npos ||
        std::from_chars(text.data() + equals + 1, end, value).ptr != end)
      throw InputError(fmt::format("\"{}\" is not of the form NAME=VALUE", text));
    found.names.push_back(text.substr(0, equals));
    found.values.push_back(value);
  }
  const Formula right(fit.expression, found.names);
  return found;
}

/// Weighted distances of points from a formula, as Eigen's minimiser wants them.
struct Distances {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const Formula& formula;
  const std::vector<FitPoint>& points;
  bool weighted;

  int inputs() const { return 0; }
  int values() const { return static_cast<int>(points.size()); }
  int operator()(const Eigen::VectorXd& parameters, Eigen::VectorXd& distances) const {
    const std::vector<double> values(parameters.begin(), parameters.end());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double off = formula.at(points[i].x, values) - points[i].y;
      distances[static_cast<Eigen::Index>(i)] = weighted ? off / *points[i].y_err : off;
    }
    return 0;
  }
};

double law_at(Form form, const Fitted& f, double x) {
  switch (form) {
    case Form::power:
      return f.c.value * std::pow(x, f.k.value);
    case Form::exponential:
      return f.c.value * std::exp(f.k.value * x);
    case Form::line:
    case Form::expression:
      break;
  }
  return f.c.value + f.k.value * x;
}

std::vector<FitPoint> points_of(const Fit& fit, const FigureTable& table) {
  std::vector<FitPoint> points;
  for (const auto& row : table.rows) {
    const auto at = std::ranges::find(fit.of, row.series);
    if (row.panel != fit.panel || at == fit.of.end()) continue;
    if (fit.range && !(row.x >= (*fit.range)[0] && row.x <= (*fit.range)[1])) continue;
    const bool logarithmic = fit.form == Form::power || fit.form == Form::exponential;
    if (logarithmic && !(row.y > 0)) continue;  // such as a rate of what never happened
    const auto k = static_cast<std::size_t>(at - fit.of.begin());
    points.push_back({row.x, row.y, fit.factors.empty() ? 1 : fit.factors[k], row.y_err});
  }
  return points;
}

std::string told(const Fit& fit, const Fitted& f, std::size_t points) {
  const auto constant = [](const Constant& c) { return fmt::format("{:.3g} +- {:.1g}", c.value, c.error); };
  const auto law = fit.form == Form::power         ? fmt::format("x^({})", constant(f.k))
                   : fit.form == Form::exponential ? fmt::format("exp(({}) x)", constant(f.k))
                                                   : fmt::format("{} + ({}) x", constant(f.c), constant(f.k));
  const auto factor = fit.factors.empty() ? "" : fmt::format(" F^({})", constant(f.n));
  const auto misfit =
      fit.form == Form::line ? fmt::format("{:.2g}", f.misfit) : fmt::format("{:.1f} %", 100 * f.misfit);
  return fmt::format("{}, {} points, which scatter about it by {}",
                     fit.form == Form::line ? law : fmt::format("{:.4g} {}{}", f.c.value, law, factor),
                     points, misfit);
}

}  // namespace

template <class Archive>
static void describe_keys(Archive& a, Fit& fit) {
  a.value("panel", fit.panel, "of the series");
  a.required("series", fit.series, "name of the line that is drawn");
  a.required("of", fit.of, "the series that it is put through, taken together");
  a.choice("form", fit.form, form_words, "c x^k, c exp(k x), c + k x, or a formula of your own");
  a.value("expression", fit.expression, "form = \"expression\": the formula, \"a*(1-exp(-x/b))\"");
  a.value("start", fit.start, "form = \"expression\": where its parameters begin, [\"a=1\", \"b=2\"]");
  a.value("legend", fit.legend, "the constants stand in the legend with their errors");
  a.value("factors", fit.factors, "power: of each series a factor F, for c x^k F^n");
  a.value("range", fit.range, "only points with x in [low, high]");
  a.value("quick_range", fit.quick_range, "instead, of a quick figure");
}
void describe(KeyLister& a, Fit& fit) { describe_keys(a, fit); }
void describe(TomlReader& a, Fit& fit) {
  describe_keys(a, fit);
  a.check((fit.form == Form::expression) == !fit.expression.empty(), "expression",
          "goes with form = \"expression\"");
  if (fit.form == Form::expression) {
    a.check(!fit.start.empty(), "start", "missing: where do the parameters begin? start = [\"a=1\"]");
    try {
      parameters_of(fit);
    } catch (const InputError& error) {
      a.fail(a.has("start") ? "start" : "expression", error.what());
    }
  }
  a.check(fit.factors.empty() || (fit.form == Form::power && fit.factors.size() == fit.of.size()), "factors",
          "are of form = \"power\", one for each series of `of`");
  for (const auto& [key, range] :
       {std::pair("range", &fit.range), std::pair("quick_range", &fit.quick_range)})
    a.check(!*range || ((*range)->size() == 2 && (**range)[0] < (**range)[1]), key,
            "must be [low, high] with low < high");
}

std::optional<Fitted> fit_law(const Fit& fit, const std::vector<FitPoint>& points) {
  const Eigen::Index n = static_cast<Eigen::Index>(points.size()), unknown = fit.factors.empty() ? 2 : 3;
  if (n <= unknown) return {};
  Eigen::MatrixXd basis(n, unknown);
  Eigen::VectorXd values(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& p = points[static_cast<std::size_t>(i)];
    basis(i, 0) = 1, basis(i, 1) = abscissa(fit.form, p.x), values[i] = ordinate(fit.form, p.y);
    if (unknown == 3) basis(i, 2) = std::log(p.factor);
  }
  if (!basis.allFinite() || !values.allFinite()) return {};
  const auto solver = basis.colPivHouseholderQr();
  if (solver.rank() < unknown) return {};
  const Eigen::VectorXd solution = solver.solve(values);
  const double square = (values - basis * solution).squaredNorm();
  const Eigen::MatrixXd spread =
      (basis.transpose() * basis).inverse() * (square / static_cast<double>(n - unknown));
  const auto constant = [&](Eigen::Index k) { return Constant{solution[k], std::sqrt(spread(k, k))}; };
  Fitted fitted{constant(0), constant(1), unknown == 3 ? constant(2) : Constant{},
                std::sqrt(square / static_cast<double>(n))};
  if (fit.form != Form::line)
    fitted.c = {std::exp(fitted.c.value), std::exp(fitted.c.value) * fitted.c.error};
  return fitted;
}

std::optional<FittedFormula> fit_formula(const Fit& fit, const std::vector<FitPoint>& points) {
  const auto parameters = parameters_of(fit);
  const std::size_t n = points.size(), unknown = parameters.names.size();
  if (n <= unknown) return {};
  const Formula formula(fit.expression, parameters.names);
  const bool weighted = std::ranges::all_of(points, [](const auto& p) { return p.y_err && *p.y_err > 0; });
  using Numeric = Eigen::NumericalDiff<Distances, Eigen::Central>;
  Numeric distances(Distances{formula, points, weighted});
  Eigen::LevenbergMarquardt<Numeric> minimiser(distances);
  Eigen::VectorXd at =
      Eigen::Map<const Eigen::VectorXd>(parameters.values.data(), static_cast<Eigen::Index>(unknown));
  minimiser.parameters.maxfev = 10000;
  minimiser.minimize(at);
  Eigen::MatrixXd slopes(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(unknown));
  distances.df(at, slopes);
  Eigen::VectorXd off(static_cast<Eigen::Index>(n));
  distances(at, off);
  if (!at.allFinite() || !off.allFinite() || !slopes.allFinite()) return {};
  const auto decomposed = slopes.colPivHouseholderQr();
  if (decomposed.rank() < static_cast<Eigen::Index>(unknown)) return {};
  const Eigen::MatrixXd spread =
      (slopes.transpose() * slopes).inverse() * (off.squaredNorm() / static_cast<double>(n - unknown));
  FittedFormula fitted;
  fitted.names = parameters.names;
  for (Eigen::Index k = 0; k < at.size(); ++k) fitted.constants.push_back({at[k], std::sqrt(spread(k, k))});
  const std::vector<double> values(at.begin(), at.end());
  double square = 0;
  for (const auto& p : points) square += std::pow(formula.at(p.x, values) - p.y, 2);
  fitted.misfit = std::sqrt(square / static_cast<double>(n));
  return fitted;
}

std::string with_error(const Constant& c) {
  if (!(c.error > 0) || !std::isfinite(c.error)) return fmt::format("{:.4g}", c.value);
  int place = static_cast<int>(std::floor(std::log10(c.error)));
  if (c.error / std::pow(10, place) < 2) --place;  // two digits of an error that begins with 1
  constexpr int most = 5;                          // beyond it powers of ten read better
  if (std::abs(place) > most || std::abs(c.value) >= 1e6) {
    const int power = static_cast<int>(std::floor(std::log10(std::max(std::abs(c.value), c.error))));
    const double scale = std::pow(10, power);
    return fmt::format("({:.{}f} \\pm {:.{}f}) 10^{{{}}}", c.value / scale, std::max(0, power - place),
                       c.error / scale, std::max(0, power - place), power);
  }
  const int digits = std::max(0, -place);
  return fmt::format("{:.{}f} \\pm {:.{}f}", c.value, digits, c.error, digits);
}

namespace {

/// "$a = 0.301 \\pm 0.004$, $b = …$"
std::string legend_of(const std::vector<std::string>& names, const std::vector<Constant>& constants) {
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < names.size(); ++k)
    texts.push_back(fmt::format("${} = {}$", names[k], with_error(constants[k])));
  return fmt::format("{}", fmt::join(texts, ", "));
}

void draw_formula(const Fit& fit, const std::vector<FitPoint>& points, const std::string& what,
                  FigureTable& table) {
  const auto fitted = fit_formula(fit, points);
  if (!fitted) {
    table.comments.push_back(what +
                             fmt::format("{} does not go through {} points", fit.expression, points.size()));
    return;
  }
  std::vector<std::string> told;
  std::vector<double> values;
  for (std::size_t k = 0; k < fitted->names.size(); ++k) {
    const auto& c = fitted->constants[k];
    told.push_back(fmt::format("{} = {:.5g} +- {:.2g}", fitted->names[k], c.value, c.error));
    values.push_back(c.value);
  }
  table.comments.push_back(what + fmt::format("{} with {}; {} points, which scatter about it by {:.2g}",
                                              fit.expression, fmt::join(told, ", "), points.size(),
                                              fitted->misfit));
  if (fit.legend) table.labels[fit.series] = legend_of(fitted->names, fitted->constants);
  const Formula formula(fit.expression, fitted->names);
  const auto [first, last] = std::ranges::minmax_element(points, {}, [](const FitPoint& p) { return p.x; });
  constexpr int steps = 200;
  for (int k = 0; k <= steps; ++k) {
    const double x = first->x + (last->x - first->x) * k / steps;
    table.rows.push_back({fit.panel, fit.series, x, formula.at(x, values)});
  }
}

}  // namespace

Fit quick_of(Fit fit) {
  if (fit.quick_range) fit.range = fit.quick_range;
  return fit;
}

void draw_fit(const Fit& fit, FigureTable& table) {
  const auto points = points_of(fit, table);
  const auto what = fmt::format("{}{}: through {}: ", fit.panel.empty() ? "" : fit.panel + " ", fit.series,
                                fmt::join(fit.of, ", "));
  if (fit.form == Form::expression) return draw_formula(fit, points, what, table);
  const auto fitted = fit_law(fit, points);
  if (!fitted) {
    table.comments.push_back(what + fmt::format("{} points are too few", points.size()));
    return;
  }
  table.comments.push_back(what + told(fit, *fitted, points.size()));
  if (fit.legend) {
    const auto law = fit.form == Form::power         ? "$c\\,x^k$"
                     : fit.form == Form::exponential ? "$c\\,e^{kx}$"
                                                     : "$c + k x$";
    table.labels[fit.series] = fmt::format("{}: {}", law, legend_of({"c", "k"}, {fitted->c, fitted->k}));
  }
  if (!fit.factors.empty()) return;
  const auto [first, last] = std::ranges::minmax_element(points, {}, [](const FitPoint& p) { return p.x; });
  constexpr int steps = 40;
  for (int k = 0; k <= steps; ++k) {
    const double part = static_cast<double>(k) / steps;
    const double x = fit.form == Form::power ? first->x * std::pow(last->x / first->x, part)
                                             : first->x + part * (last->x - first->x);
    table.rows.push_back({fit.panel, fit.series, x, law_at(fit.form, *fitted, x)});
  }
}

}  // namespace chute::figures
