// One contact alone: its solution against a search that knows only the law, and the residual against its definition.
#include <catch2/catch.hpp>

#include "scene.hpp"

using namespace chute;
using namespace chute::contact;
using Catch::Matchers::WithinAbs;

namespace {

template <int D>
Block<D> random_block(std::mt19937& dice) {
  std::normal_distribution<double> any;
  Block<D> a, w;
  for (auto& x : a.c) x = any(dice);
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      w(i, j) = i == j ? 0.1 : 0;
      for (int k = 0; k < D; ++k) w(i, j) += a(k, i) * a(k, j);
    }
  return w;
}

/// How far r and u are from the law, by its inequalities one by one: no projection, no ρ.
template <int D>
double breach(const Vec<D>& r, const Vec<D>& u, double friction) {
  double shear = 0, slip = 0, along = 0;
  for (int k = 1; k < D; ++k) shear += r[k] * r[k], slip += u[k] * u[k], along += r[k] * u[k];
  shear = std::sqrt(shear), slip = std::sqrt(slip);
  double most = std::max({-r[0], -u[0], std::abs(r[0] * u[0]), shear - friction * r[0]});
  // friction does the most work it can against the slip: r_t·u_t = −μ r_n |u_t|
  return std::max(most, std::abs(along + friction * r[0] * slip));
}

TEMPLATE_TEST_CASE_SIG("a contact alone obeys the law, whatever its block", "", ((int D), D), 2, 3) {
  std::mt19937 dice(1);
  std::normal_distribution<double> any;
  std::uniform_real_distribution<double> share(0, 1);
  int opened = 0, stuck = 0, slid = 0;
  for (int k = 0; k < 20'000; ++k) {
    const auto w = random_block<D>(dice);
    const double friction = k % 7 == 0 ? 0 : 1.5 * share(dice);
    Vec<D> q, guess;
    for (int i = 0; i < D; ++i) q[i] = any(dice), guess[i] = any(dice);
    const auto r = OneContact<D>(w, friction).solve(q, k % 2 ? guess : Vec<D>{});
    const auto u = w * r + q;
    INFO("problem " << k);
    REQUIRE(breach(r, u, friction) < 1e-9 * (1 + dot(r, r) + dot(u, u)));
    double slip = 0;
    for (int i = 1; i < D; ++i) slip += std::abs(u[i]);
    (r[0] == 0 ? opened : slip < 1e-9 ? stuck : slid) += 1;
  }
  REQUIRE(opened > 1000);
  REQUIRE(stuck > 1000);
  REQUIRE(slid > 1000);
}

TEMPLATE_TEST_CASE_SIG("the projection is the nearest point of the cone", "", ((int D), D), 2, 3) {
  std::mt19937 dice(2);
  std::normal_distribution<double> any;
  std::uniform_real_distribution<double> share(0, 1);
  for (int k = 0; k < 500; ++k) {
    const double friction = k % 5 == 0 ? 0 : share(dice);
    Vec<D> x;
    for (int i = 0; i < D; ++i) x[i] = any(dice);
    const auto p = project_on_cone(x, friction);
    for (int other = 0; other < 200; ++other) {  // no point of the cone is nearer
      Vec<D> y;
      y[0] = 3 * share(dice);
      Vec<D> t;
      for (int i = 1; i < D; ++i) t[i] = any(dice);
      const double size = norm(t);
      for (int i = 1; i < D; ++i) y[i] = size > 0 ? friction * y[0] * share(dice) * t[i] / size : 0;
      REQUIRE(norm(x - p) <= norm(x - y) + 1e-12);
    }
  }
}

TEST_CASE("the residual is what its definition says, and free of units") {
  std::mt19937 dice(3);
  const auto problem = test::random_problem<3>(dice, 4, 0.5);
  std::normal_distribution<double> any;
  std::vector<Vec<3>> r(4);
  for (auto& x : r)
    for (int k = 0; k < 3; ++k) x[k] = any(dice);
  // by hand, on scalars
  const auto element = [](const Problem<3>& p, std::size_t i, std::size_t j, int k, int l) {
    for (auto b = p.row_starts[i]; b < p.row_starts[i + 1]; ++b)
      if (p.columns[b] == j) return p.blocks[b](k, l);
    return 0.0;
  };
  const auto by_hand = [&](const Problem<3>& p, const std::vector<Vec<3>>& x) {
    double above = 0, below = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      double u[3], trace = 0;
      for (int k = 0; k < 3; ++k) {
        trace += element(p, i, i, k, k);
        u[k] = p.q[i][k];
        for (std::size_t j = 0; j < 4; ++j)
          for (int l = 0; l < 3; ++l) u[k] += element(p, i, j, k, l) * x[j][l];
      }
      const double rho = 3 / trace, mu = p.friction[i];
      const double z0 = x[i][0] - rho * (u[0] + mu * std::hypot(u[1], u[2]));
      const double z1 = x[i][1] - rho * u[1], z2 = x[i][2] - rho * u[2], t = std::hypot(z1, z2);
      double p0 = z0, p1 = z1, p2 = z2;
      if (mu * t <= -z0) {
        p0 = p1 = p2 = 0;
      } else if (t > mu * z0) {
        p0 = (z0 + mu * t) / (1 + mu * mu);
        p1 = mu * p0 * z1 / t, p2 = mu * p0 * z2 / t;
      }
      above += std::pow(x[i][0] - p0, 2) + std::pow(x[i][1] - p1, 2) + std::pow(x[i][2] - p2, 2);
      for (int k = 0; k < 3; ++k) below += std::pow(rho * p.q[i][k], 2);
    }
    return std::sqrt(above / below);
  };
  const double expected = by_hand(problem, r);
  REQUIRE(expected > 0.1);
  REQUIRE_THAT(natural_residual<3>(problem, r, test::reference(problem)),
               WithinAbs(expected, 1e-12 * expected));
  // the solver reports the same: after one sweep it has not arrived
  Team team(1);
  AssembledSystem<3> system(problem, r);
  const auto c = nsgs(system, {.tolerance = 1e-15, .iterations = 1}, team);
  REQUIRE_FALSE(c.reached);
  REQUIRE_THAT(c.residual, WithinAbs(by_hand(problem, system.result()), 1e-12 * c.residual));
  // grams for kilograms, millimetres for metres
  auto scaled = problem;
  for (auto& block : scaled.blocks)
    for (auto& x : block.c) x /= 1e3;
  for (auto& q : scaled.q) q = 1e3 * q;
  auto scaled_r = r;
  for (auto& x : scaled_r) x = 1e6 * x;
  REQUIRE_THAT(natural_residual<3>(scaled, scaled_r, test::reference(scaled)),
               WithinAbs(expected, 1e-12 * expected));
}

}  // namespace
