#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "experiments/binary_impact.hpp"
#include "experiments/column.hpp"
#include "experiments/curves.hpp"
#include "laws/walton.hpp"

namespace chute::experiments {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// ψ_f of two equal spheres that collide with v_n = −1 and v_s = ψ_i under Walton's model.
double walton_psi(const laws::Walton& walton, double e_n, double psi) {
  const double R = 1, m = 1;
  laws::Collider<2> i{{{1, psi}}, {}, R, 1 / m, 2.5 / (m * R * R)}, j{{}, {}, R, 1 / m, 2.5 / (m * R * R)};
  const Vec<2> n{{1, 0}};
  walton(n, e_n, i, j);
  return -laws::surface_slip(n, i, j)[1];  // s = (0, −1)
}

/// The acetate spheres made softer: t_n longer by `factor` at the same restitution.
laws::Normal softened(double factor) {
  return laws::SpringDashpot::from_damping(Acetate::stiffness / (factor * factor), Acetate::damping / factor,
                                           laws::MassScaling::none);
}

}  // namespace

FigureTable compute_fig_1_06(const FigureContext& context) {
  const laws::Walton walton{0.21, 0.39};
  FigureTable table;
  table.comments = {"x: psi_i = v_s/|v_n| before the collision", "y: psi_f = v_s/|v_n before| after it",
                    "Walton's collision operator (2.22) to (2.31) on two equal spheres; e_n = 0.89, mu = "
                    "0.21, beta = 0.39"};
  table.rows = evaluate({{"", "walton", evenly(0, 5, context.quick ? 51 : 501),
                          [&](double psi) { return walton_psi(walton, 0.89, psi); }}},
                        context.jobs);
  note_quick(table, context, "51 points instead of 501");
  return table;
}

FigureTable compute_fig_2_02(const FigureContext& context) {
  const double theta = 87.4 * degree, steps = context.quick ? 300 : 2000;
  const auto braking = [=](double factor, double v) {
    const laws::Contact laws{softened(factor), laws::Coulomb{Acetate::friction}};
    const auto impact = Acetate::meet(laws, v, theta, steps);
    const auto before = impact.j.velocity - impact.i.velocity;
    const auto outcome = collide(impact);
    return norm(before) - dot(outcome.j.velocity - outcome.i.velocity, before) / norm(before);
  };
  // (2.16) with the chord of two free spheres: 2 (R_i + R_j) cos ϑ, in place of 2 R cos ϑ
  const auto failure = [=](double factor) {
    return 4 * Acetate::radius / std::numbers::pi * std::cos(theta) *
           std::sqrt(Acetate::stiffness / Acetate::reduced_mass) / factor;
  };
  const auto velocities = logarithmically(0.1, 1000, context.quick ? 25 : 97);
  FigureTable table;
  table.comments = {
      "x: v_i, relative velocity before the impact, m/s",
      "y: -Delta v_x, what it loses of its component along itself, m/s",
      "impacts of two free acetate spheres under 87.4 deg: (3.1) with k_n = 7.32e6 N/m, gamma_n = 2.06 kg/s "
      "(t_n = 1e-5 s), or k_n/100, gamma_n/10 (t_n = 1e-4 s), and (3.10) with mu = 0.25",
      fmt::format(
          "series v_bf: the points of the two curves at v_bf (2.16), corrected: {:.4g} and {:.4g} m/s",
          failure(1), failure(10))};
  table.rows = evaluate({{"", "t_n=1e-5", velocities, [&](double v) { return braking(1, v); }},
                         {"", "t_n=1e-4", velocities, [&](double v) { return braking(10, v); }},
                         {"", "v_bf", {failure(1)}, [&](double v) { return braking(1, v); }},
                         {"", "v_bf", {failure(10)}, [&](double v) { return braking(10, v); }}},
                        context.jobs);
  note_quick(table, context, "25 velocities instead of 97, 300 steps per contact instead of 2000");
  return table;
}

FigureTable compute_fig_2_15(const FigureContext& context) {
  FigureTable table;
  table.comments = {
      "x: t_0/t_n, time that a grain needs for the gap to the next over the contact time of two grains",
      "y: e_tot (2.15) of a column of 10 grains that hits a wall",
      "soft spheres in one dimension, (3.1) with e_n = 0.87 for every pair and for the wall"};
  const double steps = context.quick ? 50 : 200;
  table.rows = evaluate({{"", "e_tot", logarithmically(1e-3, 100, context.quick ? 16 : 76),
                          [&](double ratio) {
                            return total_restitution({10, 0.87, ratio, steps});
                          }}},
                        context.jobs);
  note_quick(table, context, "16 points instead of 76, 50 steps per contact instead of 200");
  return table;
}

}  // namespace chute::experiments
