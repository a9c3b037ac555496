#include "theory/theory_figures.hpp"

#include <fmt/format.h>

#include <array>
#include <boost/math/statistics/linear_regression.hpp>
#include <cmath>
#include <vector>

#include "common/curvature.hpp"
#include "core/estimate.hpp"
#include "theory/hard_gas.hpp"
#include "theory/rolling.hpp"
#include "theory/stochastic.hpp"

namespace chute::theory {
namespace {

const char* const line_comment =
    "r = 5 mm, g = 9.81 m/s^2, solid sphere; e_n = 0 and endless friction: "
    "the ball rolls without bouncing. Curves end where it would lift off";
const char* const versions_comment =
    "theory: as printed (arc length, energy kept while the spin adjusts); theory "
    "corrected: way along the line, angular momentum about the contact kept";

const char* name(Version version) { return version == Version::printed ? "theory" : "theory corrected"; }

/// v̄_x from θ_AB, where it rises like 1/log (so the parameter of the curve is the cube root of the way), to where the ball
/// would lift off.
void add_velocity(FigureTable& table, const std::string& series, const Line& line, Version version) {
  const double lowest = std::sin(boundary_ab(line, version)),
               steepest = std::sin(lift_off_angle(line, version));
  const auto sine = [&](double part) {
    return lowest + (steepest - lowest) * (1e-6 + (1 - 1e-6) * part * part * part);
  };
  const auto velocity = [&](double part) {
    const auto passage = steady_passage(line, std::asin(sine(part)), version);
    return passage ? passage->mean_velocity : NAN;
  };
  for (const auto& [part, v] : by_curvature(velocity, 0, 1))
    if (std::isfinite(v)) table.rows.push_back({"", series, sine(part), v});
}

}  // namespace

FigureTable compute_theory_4_17(const FigureContext&) {
  FigureTable table;
  table.comments = {"x: sin theta", "y: mean velocity v_x, m/s", line_comment, versions_comment};
  for (const Version version : {Version::printed, Version::corrected})
    for (const double phi : {1.75, 2.25, 3.0})
      add_velocity(table, fmt::format("{} Phi={}", name(version), phi), Line{phi}, version);
  return table;
}

FigureTable compute_theory_4_18(const FigureContext&) {
  FigureTable table;
  table.comments = {"x: sin theta", "y: mean velocity v_x, m/s", line_comment, versions_comment,
                    "Phi = 3; mean gap 0.1 for the disordered line with eps_max = 0.2 (4.52)"};
  for (const Version version : {Version::printed, Version::corrected})
    add_velocity(table, name(version), Line{3, 0.1}, version);
  return table;
}

FigureTable compute_fig_4_19(const FigureContext&) {
  FigureTable table;
  table.comments = {"x: sin theta", "y: mean velocity v_x, m/s", line_comment,
                    "exact: (4.47) as printed; linear: (4.55), its expansion"};
  for (const double phi : {3.0, 2.25, 1.75})
    add_velocity(table, fmt::format("exact Phi={}", phi), Line{phi}, Version::printed);
  for (const double phi : {3.0, 2.25, 1.75}) {
    const double steepest = std::sin(lift_off_angle(Line{phi}, Version::printed));
    const auto velocity = [&](double part) {
      return linear_velocity(Line{phi}, std::asin(steepest * part * part), Version::printed);
    };
    for (const auto& [part, v] : by_curvature(velocity, 0, 1))
      table.rows.push_back({"", fmt::format("linear Phi={}", phi), steepest * part * part, v});
  }
  return table;
}

FigureTable compute_theory_4_20(const FigureContext&) {
  FigureTable table;
  table.comments = {
      "x: size ratio Phi", "y: theta_AB, rad", line_comment,
      "theory: (4.62) as printed; theory corrected: with the angular momentum about the contact kept",
      "a: eps = 0; b: disordered, mean gap 0.1, largest gap 0.2"};
  for (const auto& [panel, mean, largest] : {std::tuple{"a", 0.0, 0.0}, std::tuple{"b", 0.1, 0.2}})
    for (const Version version : {Version::printed, Version::corrected}) {
      const auto logarithm = [&, mean = mean, largest = largest](double phi) {  // as the figure shows it
        return std::log(boundary_ab(Line{phi, mean}, largest, version));
      };
      for (const auto& [phi, y] : by_curvature(logarithm, 1.25, 5))
        table.rows.push_back({panel, name(version), phi, std::exp(y)});
    }
  return table;
}

FigureTable compute_fig_4_04(const FigureContext& context) {
  // The fit takes the middle of the range with a steady state, away from the upturn at its end.
  constexpr double fit_from = 0.1, fit_to = 0.3, step = 0.02;
  const std::int64_t hops = context.quick ? 20'000 : 1'000'000;
  FigureTable table;
  const StochasticModel usual;
  table.comments = {
      "x: sin theta",
      "y: mean velocity v_x per time, m/s",
      fmt::format("stochastic model (4.1.3): r = 0.5 mm, eps = 0, mu = {}, e_n = {}, beta = {}; y_err from "
                  "block averages",
                  usual.friction, usual.restitution, usual.beta),
      fmt::format("made with {} impacts a point, seed 1; no point where the ball is trapped or runs away",
                  hops),
      "R=3mm ...: e_t by (4.8), as published; with (4.9): e_t of a ball that cannot turn",
      fmt::format("fit: straight line through the points with sin theta in [{}, {}]", fit_from, fit_to)};
  for (const Friction law : {Friction::published, Friction::without_rotation})
    for (const int mm : {3, 4, 5}) {
      const std::string series = fmt::format("R={}mm{}", mm, law == Friction::published ? "" : " with (4.9)");
      std::vector<double> x, y;
      for (int k = 1; k <= 30; ++k) {
        const double sine = k * step;
        StochasticModel model;
        model.ball_radius = mm * 1e-3;
        model.theta = std::asin(sine);
        model.law = law;
        const auto mean = mean_velocity(model, 1, hops);
        if (mean.trapped || mean.accelerates) continue;
        table.rows.push_back({"", series, sine, mean.velocity, {}, mean.error});
        if (sine > fit_from - step / 2 && sine < fit_to + step / 2)
          x.push_back(sine), y.push_back(mean.velocity);
      }
      if (law != Friction::published) continue;  // its range ends where the other's middle begins
      const auto [intercept, slope] = boost::math::statistics::simple_ordinary_least_squares(x, y);
      for (const double sine : {fit_from, fit_to})
        table.rows.push_back({"", series + " fit", sine, intercept + slope * sine});
    }
  return table;
}

FigureTable compute_theory_m_08(const FigureContext&) {
  FigureTable table;
  table.comments = {"x: packing fraction", "y: Z = beta P/n",
                    "virial: ten coefficients of Clisby & McCoy (2006) and a geometric tail"};
  const auto add = [&](const char* panel, const char* series, double largest, double (*z)(double)) {
    for (const auto& [phi, pressure] : by_curvature(z, 0, largest))
      table.rows.push_back({panel, series, phi, pressure});
  };
  add("a", "virial", 0.62, virial_discs);
  add("a", "henderson", 0.62, henderson);
  add("b", "carnahan-starling", 0.5, carnahan_starling);
  return table;
}

FigureTable compute_theory_m_02(const FigureContext& context) {
  constexpr double e = 0.9, until = 7;
  FigureTable table;
  table.comments = {"theory: a: 1 + t/tau (Haff); b: a_2 of van Noije & Ernst (1998)"};
  const int points = context.quick ? 7 : 70;
  for (int k = 0; k <= points; ++k) {
    const double x = until * k / points;
    table.rows.push_back({"a", "theory", x, 1 + x});
    table.rows.push_back({"b", "theory", x, sonine_a2(e, 2)});
  }
  return table;
}

namespace {

/// Accelerations over g of what slides or rolls down a plane, at the tangent of its angle.
double at_angle(double tangent, double along, double across) {
  return (along * tangent - across) / std::sqrt(1 + tangent * tangent);
}

}  // namespace

FigureTable compute_theory_m_03(const FigureContext& context) {
  constexpr double mu_s = 0.5, mu_d = 0.3, kappa = 0.4, roll = (1 + kappa) / kappa;
  FigureTable table;
  table.comments = {
      "theory: a: rests up to tan theta = mu, then g (sin theta - mu_d cos theta); b: rolls with g sin theta/(1 + 2/5) "
      "up to 7/2 mu, then slides; mu: mu_s from rest, mu_d pushed"};
  const int points = context.quick ? 60 : 300;
  for (const auto& [series, mu] : {std::pair("theory from rest", mu_s), std::pair("theory pushed", mu_d)})
    for (const auto& [panel, limit, most] : {std::tuple("a", mu, 0.8), std::tuple("b", roll * mu, 2.4)}) {
      const double held =
          *panel == 'a' ? 0 : 1 / (1 + kappa);  // part of g sin θ that is left while the contact sticks
      for (int k = 0; k <= points; ++k)
        if (const double x = most * k / points; x < limit)
          table.rows.push_back({panel, series, x, at_angle(x, held, 0)});
      table.rows.push_back({panel, series, limit, at_angle(limit, held, 0)});
      table.rows.push_back({panel, series, limit, at_angle(limit, 1, mu_d)});
      for (int k = 0; k <= points; ++k)
        if (const double x = most * k / points; x > limit)
          table.rows.push_back({panel, series, x, at_angle(x, 1, mu_d)});
    }
  return table;
}

FigureTable compute_theory_m_05(const FigureContext&) {
  // P = k x^α below the mean and k exp(β(1 − x)) above; that P is normalised and its mean 1 gives k and α from β.
  constexpr double beta = 1.45;
  const double alpha = (-3 + std::sqrt(1 + 4 * beta * beta)) / 2, k = 1 / (1 / (1 + alpha) + 1 / beta);
  FigureTable table;
  table.comments = {fmt::format(
      "radjai: {:.3g} exp({} (1 - x)) above the mean, the published slope being 1.4 to 1.5 (Radjai et al. 1996)",
      k, beta)};
  for (const double x : {1.0, 8.0}) table.rows.push_back({"", "radjai", x, k * std::exp(beta * (1 - x))});
  return table;
}

FigureTable compute_theory_m_09(const FigureContext&) {
  constexpr int grains = 20;  // as in the scene
  FigureTable table;
  table.comments = {
      "theory: z_k = d/2 + (k-1) d + sum over j = 1 ... k of T/((N-j+1) m g), exact; N = 20, T = m g d"};
  double gaps = 0;
  for (int k = 1; k <= grains; ++k) {
    gaps += 1.0 / (grains - k + 1);
    table.rows.push_back({"", "theory", k - 1.0, 0.5 + k - 1 + gaps});
  }
  return table;
}

namespace {

/// The times of flight of the stochastic model as a histogram over the range of fig. 4.32, and their means by side.
void add_flights(const char* panel, const StochasticModel& model, std::int64_t hops, FigureTable& table) {
  constexpr double longest = 0.02;
  constexpr std::size_t bins = 80;
  constexpr double width = longest / bins;
  constexpr std::int64_t transient = 1000;
  Random random(1, Purpose::stochastic);
  const double scale = std::sqrt(model.gravity * model.ball_radius);
  StochasticWalk walk(model, {{2 * scale, -0.3 * scale}});
  std::array<double, bins> counts{};
  double inside = 0;
  std::array<std::vector<double>, 2> by_side;  // after downhill and after uphill impacts
  for (std::int64_t k = 0; k < hops; ++k) {
    const auto hop = walk.hop(random);
    if (!hop) break;
    if (k < transient) continue;
    by_side[hop->gamma < 0].push_back(hop->time);
    if (hop->time >= longest) continue;
    counts[static_cast<std::size_t>(hop->time / width)] += 1, inside += 1;
  }
  for (std::size_t b = 0; b < bins && inside > 0; ++b)
    table.rows.push_back(
        {panel, "stochastic", (static_cast<double>(b) + 0.5) * width, counts[b] / (inside * width)});
  table.comments.push_back(
      fmt::format("{} stochastic: mean times after downhill and uphill impacts {:.2f}, {:.2f} ms", panel,
                  1e3 * estimate_of(by_side[0]).mean, 1e3 * estimate_of(by_side[1]).mean));
}

}  // namespace

FigureTable compute_theory_4_32(const FigureContext& context) {
  struct Case {
    const char* panel;
    double restitution, theta;
  };
  const std::int64_t hops = context.quick ? 50'000 : 500'000;
  FigureTable table;
  table.comments = {fmt::format(
      "stochastic: the stochastic model as published (4.8), Phi = 5, mu = 0.13, beta = 0; {} impacts, seed 1",
      hops)};
  for (const auto& [panel, restitution, theta] :
       {Case{"a", 0.4, 0.05}, Case{"b", 0.4, 0.08}, Case{"c", 0.8, 0.03}, Case{"d", 0.8, 0.05}}) {
    StochasticModel model;
    model.ball_radius = 5 * model.bead_radius;
    model.theta = theta, model.restitution = restitution, model.friction = 0.13, model.beta = 0;
    add_flights(panel, model, hops, table);
  }
  return table;
}

const std::map<std::string, std::function<FigureTable(const FigureContext&)>>& theory_figures() {
  static const std::map<std::string, std::function<FigureTable(const FigureContext&)>> all{
      {"fig-1-04", compute_fig_1_04},       {"fig-3-09", compute_fig_3_09},
      {"fig-4-01", compute_fig_4_01},       {"fig-4-03", compute_fig_4_03},
      {"fig-4-04", compute_fig_4_04},       {"fig-4-19", compute_fig_4_19},
      {"fig-4-31", compute_fig_4_31},       {"theory-4-17", compute_theory_4_17},
      {"theory-4-18", compute_theory_4_18}, {"theory-4-20", compute_theory_4_20},
      {"theory-4-32", compute_theory_4_32}, {"theory-m-02", compute_theory_m_02},
      {"theory-m-03", compute_theory_m_03}, {"theory-m-05", compute_theory_m_05},
      {"theory-m-08", compute_theory_m_08}, {"theory-m-09", compute_theory_m_09}};
  return all;
}

}  // namespace chute::theory
