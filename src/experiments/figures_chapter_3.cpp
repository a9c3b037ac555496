#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/binary_impact.hpp"
#include "experiments/curves.hpp"
#include "experiments/pushed_cylinder.hpp"

namespace chute::experiments {
namespace {

double restitution(const laws::Normal& normal, double v, double steps) {
  return collide(Acetate::meet({normal, laws::Frictionless{}}, v, 0, steps)).restitution();
}

const laws::Hertz& hertz() {
  static const auto law = laws::Hertz::from_stiffness(Acetate::hertz_stiffness);
  return law;
}

laws::HertzLinearDamping linearly_damped(double damping) {
  return {hertz(), damping, laws::MassScaling::none};
}

}  // namespace

FigureTable compute_fig_3_01(const FigureContext& context) {
  struct Series {
    const char* name;
    laws::Normal law;
    double exponent;
    double elastic;  ///< velocity at the end of the range where the law is most elastic
  };
  const std::vector<Series> all = {
      {"spring-dashpot", Acetate::spring_dashpot(), 0, 1},
      {"hertz-linear-damping", linearly_damped(0.35), -0.2, 100},
      {"hertz-kuwabara-kono", laws::HertzKuwabaraKono::from_damping(hertz(), 190, laws::MassScaling::none),
       0.2, 0.01}};
  const double steps = context.quick ? 500 : 4000;
  const auto velocities = logarithmically(0.01, 100, context.quick ? 17 : 65);
  std::vector<ComputedCurve> curves;
  for (const auto& [name, law, exponent, elastic] : all) {
    curves.push_back(
        {"", name, velocities, [law = law, steps](double v) { return restitution(law, v, steps); }});
    const double amplitude = (1 - restitution(law, elastic, steps)) / std::pow(elastic, exponent);
    curves.push_back({"", std::string(name) + " fit", velocities,
                      [=, e = exponent](double v) { return 1 - amplitude * std::pow(v, e); }});
  }
  FigureTable table;
  table.comments = {
      "x: impact velocity, m/s", "y: coefficient of normal restitution e_n",
      "head-on impacts of two free acetate spheres, integrated by the soft-sphere engine: (3.1) with k_n = "
      "7.32e6 N/m, "
      "gamma_n = 2.06 kg/s; (3.5) with k_n = 9.0e7 N/m^1.5, gamma_n = 0.35 kg/s; (3.6) with k_n = 9.0e7 "
      "N/m^1.5, "
      "gamma_n = 190 kg/(m^0.5 s)",
      "fit: 1 - e_n = a v^p with p = 0, -1/5, 1/5, and a from the most elastic point of the range"};
  table.rows = evaluate(curves, context.jobs);
  note_quick(table, context, "17 velocities instead of 65, 500 steps per contact instead of 4000");
  return table;
}

FigureTable compute_fig_3_02(const FigureContext& context) {
  const double steps = context.quick ? 200 : 2000, v = 1;
  FigureTable table;
  table.comments = {
      "x: time since the first contact, s", "y: F_n over its largest value in that collision",
      "head-on impacts of two free acetate spheres at 1 m/s; repulsion is positive",
      "a: (3.1), k_n = 7.32e6 N/m; b: (3.5), k_n = 9.0e7 N/m^1.5; gamma_n such that e_n is as named"};
  const std::size_t every = static_cast<std::size_t>(steps / 200);
  for (const char* panel : {"a", "b"})
    for (const double e_n : {0.95, 0.6, 0.2}) {
      laws::Normal law = laws::SpringDashpot::from_restitution(Acetate::stiffness, e_n);
      if (*panel == 'b') {
        const double gamma = laws::damping_for(
            [&](double g) { return linearly_damped(g).impact(v, Acetate::pair()).restitution; }, e_n, 0.1);
        law = linearly_damped(gamma);
        table.comments.push_back(fmt::format("b: e_n = {} with gamma_n = {:.5g} kg/s", e_n, gamma));
      }
      auto impact = Acetate::meet({law, laws::Frictionless{}}, v, 0, steps);
      impact.trace = true;
      const auto trace = collide(impact).trace;
      double most = 0;
      for (const auto& p : trace) most = std::max(most, p.normal_force);
      const auto series = fmt::format("e_n={}", e_n);
      for (std::size_t k = 0; k < trace.size(); ++k)
        if (k % every == 0 || k + 1 == trace.size())
          table.rows.push_back({panel, series, trace[k].time, trace[k].normal_force / most});
    }
  note_quick(table, context, "200 steps per contact instead of 2000");
  return table;
}

FigureTable compute_fig_3_03(const FigureContext& context) {
  const double k_1 = Acetate::stiffness, s = 2e5, steps = context.quick ? 500 : 4000;
  const laws::Normal law = laws::WaltonBraun::from_hardening(k_1, s);
  const auto velocities = logarithmically(0.01, 100, context.quick ? 17 : 65);
  FigureTable table;
  table.comments = {
      "x: impact velocity, m/s", "y: coefficient of normal restitution e_n",
      "head-on impacts of two free acetate spheres, integrated by the soft-sphere engine: (3.7) with "
      "k_1 = 7.32e6 N/m, k_2 = k_1 + s F_max, s = 2e5 1/m"};
  table.rows = evaluate(
      {{"", "simulation", velocities, [&](double v) { return restitution(law, v, steps); }},
       {"", "eq 3.8", velocities,
        [&](double v) { return 1 / std::sqrt(1 + s * v * std::sqrt(Acetate::reduced_mass / k_1)); }}},
      context.jobs);
  note_quick(table, context, "17 velocities instead of 65, 500 steps per contact instead of 4000");
  return table;
}

namespace {

constexpr double block_friction = 0.5, plane_friction = 0.25, stiffness = 2e7;
constexpr Push first{0.8, 0.02}, second{0.2, 0.04};

/// The cylinder with one of the laws of Fig. 3.10: a (3.12), b (3.13), c (3.13) with (3.25).
PushedCylinder cylinder(char law) {
  PushedCylinder set_up;
  const auto make = [&](double mu) -> laws::Shear {
    if (law == 'a') return laws::RegularisedCoulomb{1000, mu, laws::MassScaling::none};
    return laws::CundallStrack{{stiffness, 0, 0, 0}, {mu, law == 'c'}};
  };
  set_up.block = make(block_friction);
  set_up.plane = make(plane_friction);
  return set_up;
}

const std::string set_up_note =
    "cylinder pushed along a plane by a massless block (3.2): m = g = r = 1, I = 1/2, mu_b = 0.5, mu_p = "
    "0.25, (3.1) with "
    "k_n = 2e7, e_n = 0.2 on the plane; from rest, F_p = 0.8 until t = 0.02, then 0.2 until t = 0.06; "
    "Runge-Kutta";
const std::string laws_note = "a: (3.12) with gamma_s = 1000; b: (3.13) with k_s = k_n; c: as b with (3.25)";

/// Mean and half of the range of one quantity over the last part of a push. The mean is weighted with a bell,
/// 1 − cos, so that a ringing leaves nothing of the period that the interval cuts off.
struct Steady {
  double mean, swing;
};
template <class Get>
Steady steady(const std::vector<CylinderState>& states, double from, double to, const Get& get) {
  double sum = 0, weights = 0, low = INFINITY, high = -INFINITY;
  for (const auto& s : states) {
    if (s.time <= from || s.time >= to) continue;
    const double weight = 1 - std::cos(2 * std::numbers::pi * (s.time - from) / (to - from)), value = get(s);
    sum += weight * value;
    weights += weight;
    low = std::min(low, value), high = std::max(high, value);
  }
  return {sum / weights, (high - low) / 2};
}

}  // namespace

FigureTable compute_fig_3_10(const FigureContext& context) {
  FigureTable table;
  table.comments = {"x: time, sqrt(r/g)", "y: friction force on the cylinder, mg", set_up_note, laws_note};
  const int every = context.quick ? 400 : 50;
  for (const char* panel : {"a", "b", "c"}) {
    const auto states = push(cylinder(*panel), {first, second}, every);
    for (const auto& s : states) table.rows.push_back({panel, "F_s^b", s.time, s.block_force});
    for (const auto& s : states) table.rows.push_back({panel, "F_s^p", s.time, s.plane_force});
  }
  note_quick(table, context, "a row every 4e-4 instead of every 5e-5");
  return table;
}

FigureTable compute_table_3_1(const FigureContext& context) {
  FigureTable table;
  table.comments = {"x: 1 F_s^p, 2 F_s^b (mg), 3 dv/dt, 4 domega/dt (g, g/r); panel: F_p",
                    "y: value in the steady state; y_err: half of its range where the law leaves it ringing",
                    "theory: (3.26) to (3.31); a, b, c: mean over the last quarter of each push",
                    set_up_note,
                    laws_note,
                    "b, c: integrated exactly, the tangential spring has no damping of its own, so the "
                    "sticking contact goes on "
                    "ringing, at F_p = 0.2 over the full friction force; the thesis's table shows the mean",
                    "b at F_p = 0.2: the spring of the plane, stretched by all the slip before, still holds "
                    "the sliding force; it "
                    "lets go at t = 0.072 and then swings to the other side"};
  const double end = first.duration + second.duration;
  std::vector<std::vector<CylinderState>> runs;
  for (const char law : {'a', 'b', 'c'}) runs.push_back(push(cylinder(law), {first, second}, 1));
  for (const auto& [panel, pushing, from, to] :
       {std::tuple{"0.8", first.force, 0.75 * first.duration, first.duration},
        std::tuple{"0.2", second.force, end - 0.25 * second.duration, end}}) {
    const auto theory = steady_cylinder(pushing, block_friction, plane_friction);
    const double exact[] = {theory.plane_force, theory.block_force, theory.acceleration, theory.spin_up};
    for (int q = 0; q < 4; ++q) table.rows.push_back({panel, "theory", q + 1.0, exact[q]});
    for (std::size_t law = 0; law < runs.size(); ++law)
      for (int q = 0; q < 4; ++q) {
        const auto value = steady(runs[law], from, to, [q](const CylinderState& s) {
          return q == 0 ? s.plane_force : q == 1 ? s.block_force : q == 2 ? s.acceleration : s.spin_up;
        });
        const auto swing = law == 0 ? std::optional<double>() : value.swing;
        table.rows.push_back(
            {panel, std::string(1, static_cast<char>('a' + law)), q + 1.0, value.mean, {}, swing});
      }
  }
  static_cast<void>(context);  // it takes no time
  return table;
}

}  // namespace chute::experiments
