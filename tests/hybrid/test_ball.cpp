// The thesis's ball on a line (4.2): in time steps as from collision to collision.
#include <catch2/catch.hpp>

#include "core/frame.hpp"
#include "core/sphere.hpp"
#include "engines/event/event_engine.hpp"
#include "few_grains.hpp"

using namespace chute;
using namespace chute::test;

TEST_CASE("a ball on a line runs as fast as with the event-driven method") {
  for (const double size_ratio : {2.25, 3.0}) {
    constexpr double r = 5e-3, density = 7800;
    Grains<2> grains;
    const auto add = [&](Vec<2> place, double radius, bool moves) {
      const double mass = sphere_mass(density, radius);
      add_ball<2>(grains, place, {}, moves, radius, mass);
    };
    add({{2 * r, (size_ratio + 1.05) * r}}, size_ratio * r, true);
    grains.velocity[0][0] = 0.4;
    for (int i = 0; i < 20; ++i) add({{r + i * 2 * r, 0}}, r, false);
    Surroundings<2> around;
    around.domain.length[0] = 40 * r;
    around.gravity = gravity_on_incline<2>(9.81, std::asin(0.1));
    const hard::HardContact contact{laws::ConstantRestitution{0.7}, {.friction = 0.13, .beta = 0.34}};

    event::EventSetup<2> hard{around};
    hard.contact = contact;
    hard.contact_time = 1e-5;
    hard.tick = 0.1;
    hybrid::HybridSetup<2> setup{around};
    setup.contact = contact;
    setup.time_step = 2e-4;
    setup.diameter = 2 * r;
    event::EventEngine<2> reference(grains, hard);
    hybrid::HybridEngine<2> engine(grains, setup);
    constexpr double from = 5, until = 605;
    const auto velocity = [&](Engine& e) {
      e.advance_to(std::llround(from / e.time_step()));
      const double begin = e.grains().unwrapped(0, 0);
      e.advance_to(std::llround(until / e.time_step()));
      return (e.grains().unwrapped(0, 0) - begin) / (until - from);
    };
    const double expected = velocity(reference), found = velocity(engine);
    CAPTURE(size_ratio, expected, found);
    CHECK(found == Approx(expected).epsilon(0.005));
  }
}
