#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <catch2/catch.hpp>

#include "few_clumps.hpp"

using namespace chute;
using namespace chute::test;

namespace {

/// A torque-free top with moments I_1 < I_2 < I_3 that begins with ω = (a, 0, c), L² > 2 E I_2: Landau and Lifshitz,
/// Mechanics, § 37, with time counted from an instant at which ω_2 = 0.
struct Jacobi {
  Vec<3> I;
  double a, c;

  double energy() const { return 0.5 * (I[0] * a * a + I[2] * c * c); }
  double square() const { return I[0] * I[0] * a * a + I[2] * I[2] * c * c; }  // L²
  double rate() const {
    return std::sqrt((I[2] - I[1]) * (square() - 2 * energy() * I[0]) / (I[0] * I[1] * I[2]));
  }
  double modulus() const {
    return std::sqrt((I[1] - I[0]) * (2 * energy() * I[2] - square()) /
                     ((I[2] - I[1]) * (square() - 2 * energy() * I[0])));
  }
  double period() const { return 4 * boost::math::ellint_1(modulus()) / rate(); }
  Vec<3> at(double t) const {
    double cn = 0, dn = 0;
    const double sn = boost::math::jacobi_elliptic(modulus(), rate() * t, &cn, &dn);
    const double b = std::sqrt((2 * energy() * I[2] - square()) / (I[1] * (I[2] - I[1])));
    return {{a * cn, b * sn, c * dn}};
  }
};

/// Indices of the principal moments from the least to the largest.
std::array<int, 3> ascending(const Vec<3>& moments) {
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int i, int j) { return moments[i] < moments[j]; });
  return order;
}

}  // namespace

TEST_CASE("the truth of the cases below obeys Euler's equations") {
  const Jacobi top{{{0.2, 0.35, 0.5}}, 1.5, 2};
  REQUIRE(top.square() > 2 * top.energy() * top.I[1]);
  const double h = 1e-5;
  for (const double t : {0.0, 0.4, 1.7}) {
    const auto w = top.at(t), rate = (1 / (2 * h)) * (top.at(t + h) - top.at(t - h));
    CHECK(top.I[0] * rate[0] == Approx((top.I[1] - top.I[2]) * w[1] * w[2]).margin(1e-8));
    CHECK(top.I[1] * rate[1] == Approx((top.I[2] - top.I[0]) * w[2] * w[0]).margin(1e-8));
    CHECK(top.I[2] * rate[2] == Approx((top.I[0] - top.I[1]) * w[0] * w[1]).margin(1e-8));
  }
}

// Steps of a fiftieth of t_n = π √(m/2k), k = 1e5: the default of grains with m = d = 1. The spins are those of grains in fast
// flows, a few √(g/d).
TEST_CASE("a free crooked grain turns as Jacobi's functions say, to 1e-10 over ten periods") {
  const auto scheme = GENERATE(soft::Scheme::gear5, soft::Scheme::verlet);
  const double dt = std::numbers::pi * std::sqrt(0.5e-5) / 50;
  Bodies<3> bodies;
  const int form = bodies.form(crooked());
  const Vec<3> moments = bodies.clumps.forms.front().gyration;
  const auto order = ascending(moments);
  REQUIRE(moments[order[1]] / moments[order[0]] > 1.2);
  REQUIRE(moments[order[2]] / moments[order[1]] > 1.1);
  Vec<3> I;  // in the order of the truth
  for (int k = 0; k < 3; ++k) I[k] = 0.25 * moments[order[static_cast<std::size_t>(k)]];
  const Jacobi truth{I, 2.5, 3};
  REQUIRE(truth.square() > 2 * truth.energy() * I[1]);

  // in some attitude, and the axes of the truth are right-handed ones or the mirrored
  const Vec<4> attitude = (1 / std::sqrt(30.0)) * Vec<4>{{1, 2, -3, 4}};
  const double hand = (order[1] - order[0] + 3) % 3 == 1 ? 1 : -1;
  const auto in_frame = [&](const Vec<3>& w) {
    Vec<3> v;
    for (int k = 0; k < 3; ++k) v[order[static_cast<std::size_t>(k)]] = (k == 1 ? hand : 1) * w[k];
    return v;
  };
  bodies.put(form, {{0.3, 0.2, 5}}, {{1, -2, 0.5}}, soft::in_space(attitude, in_frame(truth.at(0))),
             attitude);
  soft::ClumpEngine<3> engine(bodies.grains, bodies.clumps, setup<3>(smooth(1e5), dt, scheme));
  const auto momentum = engine.angular_momentum();
  const double start = engine.energy().rotation;
  CHECK(start == Approx(truth.energy()).epsilon(1e-12));
  const double size = norm(truth.at(0));
  double worst = 0, drift = 0;
  const auto last = static_cast<std::int64_t>(10 * truth.period() / dt);
  for (int k = 1; k <= 100; ++k) {
    engine.advance_to(last * k / 100);
    const auto& g = engine.state();
    const auto w = soft::in_body(g.attitude(0), g.turning(0));
    worst = std::max(worst, norm(w - in_frame(truth.at(engine.time()))) / size);
    drift = std::max(drift, std::abs(engine.energy().rotation / start - 1));
    // of the orbit, place and velocity round; the body's own is not touched
    for (int axis = 0; axis < 3; ++axis)
      CHECK(engine.angular_momentum()[axis] == Approx(momentum[axis]).epsilon(1e-10).margin(1e-10));
  }
  INFO("largest error " << worst << ", of the energy " << drift);
  CHECK(worst < 1e-10);
  CHECK(drift < 1e-11);
  CHECK(engine.energy().residual() == Approx(0).margin(1e-10));
}

TEST_CASE("the error of a free turn falls with the fourth power of the step") {
  const auto off = [](double dt) {
    Bodies<3> bodies;
    const int form = bodies.form(crooked());
    bodies.put(form, {}, {}, {{3, -2, 4}});
    soft::ClumpEngine<3> engine(bodies.grains, bodies.clumps,
                                setup<3>(smooth(1e5), dt, soft::Scheme::verlet));
    engine.advance_to(std::llround(2 / dt));
    return engine.state().attitude(0);
  };
  const auto finest = off(1.0 / 4096);
  const double coarse = norm(off(1.0 / 64) - finest), fine = norm(off(1.0 / 128) - finest);
  CHECK(coarse / fine > 13);
  CHECK(fine < 1e-6);
}

TEST_CASE("a free body in the plane turns evenly") {
  Bodies<2> bodies;
  const int form = bodies.form(rod());
  bodies.put(form, {{0, 0}}, {{0, 0}}, {{3}}, {{0.4}});
  soft::ClumpEngine<2> engine(bodies.grains, bodies.clumps, setup<2>(smooth(1e5), 1e-3, soft::Scheme::gear5));
  engine.advance_to(1000);
  CHECK(engine.state().orientation[0][0] == Approx(3.4).epsilon(1e-12));
  const auto view = engine.drawn();
  const double R = bodies.clumps.forms[0].members[2].at[0] * 0.5;
  CHECK(view.position[0][2] == Approx(R * std::cos(3.4)).epsilon(1e-11));
  CHECK(view.position[1][2] == Approx(R * std::sin(3.4)).epsilon(1e-11));
  CHECK(view.velocity[0][2] == Approx(-3 * R * std::sin(3.4)).epsilon(1e-11));
}
