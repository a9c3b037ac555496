#include "figures/fits.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

namespace chute::figures {
namespace {
using namespace std::string_view_literals;
using Form = Fit::Form;
constexpr std::array form_words{"power"sv, "exponential"sv, "line"sv};

double abscissa(Form form, double x) { return form == Form::power ? std::log(x) : x; }
double ordinate(Form form, double y) { return form == Form::line ? y : std::log(y); }

double law_at(Form form, const Fitted& f, double x) {
  switch (form) {
    case Form::power:
      return f.c.value * std::pow(x, f.k.value);
    case Form::exponential:
      return f.c.value * std::exp(f.k.value * x);
    case Form::line:
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
    if (fit.form != Form::line && !(row.y > 0)) continue;  // such as a rate of what never happened
    const auto k = static_cast<std::size_t>(at - fit.of.begin());
    points.push_back({row.x, row.y, fit.factors.empty() ? 1 : fit.factors[k]});
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

void describe(TomlReader& a, Fit& fit) {
  a.value("panel", fit.panel);
  a.required("series", fit.series);
  a.required("of", fit.of);
  a.choice("form", fit.form, form_words);
  a.value("factors", fit.factors);
  a.value("range", fit.range);
  a.check(fit.factors.empty() || (fit.form == Form::power && fit.factors.size() == fit.of.size()), "factors",
          "are of form = \"power\", one for each series of `of`");
  a.check(!fit.range || (fit.range->size() == 2 && (*fit.range)[0] < (*fit.range)[1]), "range",
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

void draw_fit(const Fit& fit, FigureTable& table) {
  const auto points = points_of(fit, table);
  const auto fitted = fit_law(fit, points);
  const auto what = fmt::format("{}{}: through {}: ", fit.panel.empty() ? "" : fit.panel + " ", fit.series,
                                fmt::join(fit.of, ", "));
  if (!fitted) {
    table.comments.push_back(what + fmt::format("{} points are too few", points.size()));
    return;
  }
  table.comments.push_back(what + told(fit, *fitted, points.size()));
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
