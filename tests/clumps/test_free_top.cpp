#include <catch2/catch.hpp>

#include "few_clumps.hpp"
#include "theory/free_top.hpp"

using namespace chute;
using namespace chute::test;

// Steps of a fiftieth of t_n = π √(m/2k), k = 1e5: the default of grains with m = d = 1. The spins are those of grains in fast
// flows, a few √(g/d).
TEST_CASE("a free crooked grain turns as Jacobi's functions say, to 1e-10 over ten periods") {
  const auto scheme = GENERATE(soft::Scheme::gear5, soft::Scheme::verlet);
  const double dt = std::numbers::pi * std::sqrt(0.5e-5) / 50;
  Bodies<3> bodies;
  const int form = bodies.form(crooked());
  const Vec<3> moments = bodies.clumps.forms.front().gyration;
  const Vec<3> spin{{1.5, 0.3, 3}};            // along the principal axes
  const theory::FreeTop truth(moments, spin);  // which obeys Euler's equations: tests/theory
  const Vec<4> attitude = (1 / std::sqrt(30.0)) * Vec<4>{{1, 2, -3, 4}};
  bodies.put(form, {{0.3, 0.2, 5}}, {{1, -2, 0.5}}, soft::in_space(attitude, spin), attitude);
  soft::ClumpEngine<3> engine(bodies.grains, bodies.clumps, setup<3>(smooth(1e5), dt, scheme));
  const auto momentum = engine.angular_momentum();
  const double start = engine.energy().rotation;
  const double size = norm(spin);
  double worst = 0, drift = 0;
  const auto last = static_cast<std::int64_t>(10 * truth.period() / dt);
  for (int k = 1; k <= 100; ++k) {
    engine.advance_to(last * k / 100);
    const auto& g = engine.state();
    const auto w = soft::in_body(g.attitude(0), g.turning(0));
    worst = std::max(worst, norm(w - truth.at(engine.time())) / size);
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
  CHECK(view.velocity[0][2] == 0);  // of the body
}
