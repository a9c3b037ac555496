#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/curvature.hpp"
#include "experiments/binary_impact.hpp"
#include "experiments/curves.hpp"
#include "experiments/pushed_cylinder.hpp"
#include "experiments/rigid_cylinder.hpp"
#include "laws/walton.hpp"

namespace chute::experiments {
namespace {

/// ψ_f of two equal spheres that collide with v_n = −1 and v_s = ψ_i under Walton's model.
double walton_psi(const laws::Walton& walton, double e_n, double psi) {
  const double R = 1, m = 1;
  laws::Collider<2> i{{{1, psi}}, {}, R, 1 / m, 2.5 / (m * R * R)}, j{{}, {}, R, 1 / m, 2.5 / (m * R * R)};
  const Vec<2> n{{1, 0}};
  walton(n, e_n, i, j);
  return -laws::surface_slip(n, i, j)[1];  // s = (0, −1)
}

laws::HertzLinearDamping linearly_damped(double damping) {
  return {laws::Hertz::from_stiffness(Acetate::hertz_stiffness), damping, laws::MassScaling::none};
}

}  // namespace

FigureTable compute_fig_1_06(const FigureContext& context) {
  const laws::Walton walton{0.21, 0.39};
  FigureTable table;
  table.comments = {"x: psi_i = v_s/|v_n| before the collision", "y: psi_f = v_s/|v_n before| after it",
                    "Walton's collision operator (2.22) to (2.31) on two "
                    "equal spheres; e_n = 0.89, mu = 0.21, beta = 0.39"};
  table.rows = evaluate({{"", "walton", evenly(0, 5, context.quick ? 51 : 501),
                          [&](double psi) { return walton_psi(walton, 0.89, psi); }}},
                        context.jobs);
  note_quick(table, context, "51 points instead of 501");
  return table;
}

FigureTable compute_fig_3_02(const FigureContext&) {
  constexpr double steps = 20'000, v = 1;
  // The predictor knows nothing of the jump at the first contact: what it makes of it in its first steps is no force.
  constexpr std::size_t settling = 8;
  FigureTable table;
  table.comments = {
      "x: time since the first contact, s", "y: F_n over its largest value in that collision",
      "head-on impacts of two free acetate spheres at 1 m/s; repulsion is positive",
      "a: (3.1), k_n = 7.32e6 N/m; b: (3.5), k_n = 9.0e7 N/m^1.5; gamma_n such that e_n is as named"};
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
      for (std::size_t k = settling; k < trace.size(); ++k) most = std::max(most, trace[k].normal_force);
      const auto series = fmt::format("e_n={}", e_n);
      std::vector<double> time, force;
      for (std::size_t k = settling; k < trace.size(); ++k)
        time.push_back(trace[k].time), force.push_back(trace[k].normal_force / most);
      for (const std::size_t k : needed_points(time, force))
        table.rows.push_back({panel, series, time[k], force[k]});
    }
  return table;
}

namespace {

constexpr double block_friction = 0.5, plane_friction = 0.25, stiffness = 2e7;
constexpr Push first{0.8, 0.02}, second{0.2, 0.04};

/// The cylinder with one of the laws of Fig. 3.10: a (3.12), b (3.13), c (3.13) with (3.25).
PushedCylinder cylinder(char law) {
  PushedCylinder set_up;
  const auto make = [&](double mu) -> laws::Shear {
    if (law == 'a') return laws::RegularisedCoulomb{1000, mu, laws::MassScaling::none, {}};
    return laws::CundallStrack{{stiffness, 0, 0, 0}, {mu, law == 'c'}};
  };
  set_up.block = make(block_friction);
  set_up.plane = make(plane_friction);
  return set_up;
}

const std::string set_up_note =
    "cylinder pushed along a plane by a massless block (3.2): m = g = r = 1, I = "
    "1/2, mu_b = 0.5, mu_p = 0.25, (3.1) with k_n = 2e7, e_n = 0.2 on the plane; "
    "from rest, F_p = 0.8 until t = 0.02, then 0.2 until t = 0.06; Runge-Kutta";
const std::string laws_note = "a: (3.12) with gamma_s = 1000; b: (3.13) with k_s = k_n; c: as b with (3.25)";
const std::string rigid_note =
    ": rigid, by contact dynamics (2.2) in steps of 1e-4: Coulomb's relation in place of a law";

}  // namespace

FigureTable compute_fig_3_10(const FigureContext&) {
  FigureTable table;
  table.comments = {"x: time, sqrt(r/g)", "y: friction force on the cylinder, mg", set_up_note, laws_note,
                    "d" + rigid_note};
  // Every step's forces, then of each stretch the least and the largest, in their order: the envelope of what rings faster than
  // the figure's points follow each other, in place of the beats that single samples of it make.
  constexpr std::size_t points = 300;
  for (const char* panel : {"a", "b", "c"}) {
    const auto states = push(cylinder(*panel), {first, second}, 1);
    for (const auto& [series, force] :
         {std::pair{"F_s^b", &CylinderState::block_force}, {"F_s^p", &CylinderState::plane_force}})
      for (std::size_t from = 0; from < states.size();) {
        const std::size_t to =
            std::min(states.size(), from + std::max<std::size_t>(2, states.size() / points));
        const auto [least, most] =
            std::minmax_element(states.begin() + static_cast<std::ptrdiff_t>(from),
                                states.begin() + static_cast<std::ptrdiff_t>(to),
                                [&, force = force](auto& a, auto& b) { return a.*force < b.*force; });
        for (const auto& s : {std::min(least, most), std::max(least, most)})
          table.rows.push_back({panel, series, s->time, (*s).*force});
        from = to;
      }
  }
  for (const auto& s : push(RigidCylinder{block_friction, plane_friction}, {first, second})) {
    table.rows.push_back({"d", "F_s^b", s.time, s.block_force});
    table.rows.push_back({"d", "F_s^p", s.time, s.plane_force});
  }
  return table;
}

constexpr auto ringing_note =
    "b, c: integrated exactly, the tangential spring has no damping of its own, so the sticking contact goes on "
    "ringing, at F_p = 0.2 over the full friction force; the thesis's table shows the mean";
constexpr auto stretched_note =
    "b at F_p = 0.2: the spring of the plane, stretched by all the slip before, still holds the sliding force; it "
    "lets go at t = 0.072 and then swings to the other side";

FigureTable compute_table_3_1(const FigureContext& context) {
  FigureTable table;
  table.comments = {"x: 1 F_s^p, 2 F_s^b (mg), 3 dv/dt, 4 domega/dt (g, g/r); panel: F_p",
                    "y: value in the steady state; y_err: half of its range where the law leaves it ringing",
                    "theory: (3.26) to (3.31); others: mean over the last quarter of each push",
                    set_up_note,
                    laws_note,
                    ringing_note,
                    stretched_note,
                    "contact" + rigid_note};
  constexpr double CylinderState::*quantities[] = {&CylinderState::plane_force, &CylinderState::block_force,
                                                   &CylinderState::acceleration, &CylinderState::spin_up};
  const double end = first.duration + second.duration;
  std::vector<std::vector<CylinderState>> runs;
  for (const char law : {'a', 'b', 'c'}) runs.push_back(push(cylinder(law), {first, second}, 1));
  runs.push_back(push(RigidCylinder{block_friction, plane_friction}, {first, second}));
  const std::array series{"a", "b", "c", "contact"};
  const auto rings = [](std::size_t law) { return law == 1 || law == 2; };
  for (const auto& [panel, pushing, from, to] :
       {std::tuple{"0.8", first.force, 0.75 * first.duration, first.duration},
        std::tuple{"0.2", second.force, end - 0.25 * second.duration, end}}) {
    const auto theory = steady_cylinder(pushing, block_friction, plane_friction);
    const double exact[] = {theory.plane_force, theory.block_force, theory.acceleration, theory.spin_up};
    for (int q = 0; q < 4; ++q) table.rows.push_back({panel, "theory", q + 1.0, exact[q]});
    for (std::size_t law = 0; law < runs.size(); ++law)
      for (int q = 0; q < 4; ++q) {
        const auto value = steady(runs[law], from, to, quantities[q]);
        const auto swing = rings(law) ? value.swing : std::optional<double>();
        table.rows.push_back({panel, series[law], q + 1.0, value.mean, {}, swing});
      }
  }
  static_cast<void>(context);  // it takes no time
  return table;
}

const std::map<std::string, std::function<FigureTable(const FigureContext&)>>& computed_figures() {
  static const std::map<std::string, std::function<FigureTable(const FigureContext&)>> all = {
      {"fig-1-06", compute_fig_1_06},
      {"fig-3-02", compute_fig_3_02},
      {"fig-3-10", compute_fig_3_10},
      {"fig-b-11", compute_fig_b_11},
      {"table-3-1", compute_table_3_1}};
  return all;
}

}  // namespace chute::experiments
