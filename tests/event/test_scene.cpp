#include <catch2/catch.hpp>
#include <sstream>

#include "common/error.hpp"
#include "run/engine_factory.hpp"
#include "theory/stochastic.hpp"

using namespace chute;

namespace {

constexpr const char* ball = R"(
units = "SI"
[incline]
sin = 0.06
[bed]
diameter = 0.01
count = 20
[grains]
count = 1
size_ratio = 2.25
density = 7800
start = { lattice = "none", velocity = 0.4, velocity_up = 0.02 }
[contact.normal]
stiffness = 2e6
restitution = 0.7
[contact.tangential]
viscosity = 100
friction = 0.13
[run]
duration = 10
)";

run::Made make(const std::vector<std::string>& settings) {
  return run::make_engine(scene::parse_scene(ball, "ball.toml", settings));
}
double mean_velocity(Engine& engine) {
  const auto at = [&](double t) {
    engine.advance_to(std::llround(t / engine.time_step()));
    return engine.grains().unwrapped(0, 0);
  };
  const double from = at(2);
  return (at(10) - from) / 8;
}

}  // namespace

TEST_CASE(
    "one key makes a soft scene event-driven, with the restitution, friction and contact time of its "
    "contact") {
  const auto soft = make({}), hard = make({"engine.method=event", "engine.integrator=gear5"});
  // Bouncing and rolling in region B: the two methods share nothing but the scene.
  CHECK(mean_velocity(*hard.engine) == Approx(mean_velocity(*soft.engine)).epsilon(0.01));
  CHECK_FALSE(hard.engine->energy().normal_loss == 0);
}

TEST_CASE("keys of the event-driven method are read, written back and checked") {
  const auto scene = scene::parse_scene(
      ball, "ball.toml",
      {"engine.method=event", "engine.restitution=0", "engine.friction=10",
       "engine.tangential_restitution=0.3", "engine.contact_time=1e-4", "engine.restitution_velocity=1"});
  const auto text = scene::to_toml(scene);
  CHECK(scene::to_toml(scene::parse_scene(text, "again.toml")) == text);
  for (const char* key : {"restitution = 0", "friction = 10", "tangential_restitution = 0.3",
                          "contact_time = 0.0001", "restitution_exponent = 0.2"})
    CHECK_THAT(text, Catch::Contains(key));
  CHECK_THROWS_WITH(make({"engine.contact_time=1e-4"}),
                    Catch::Contains("contact_time"));  // soft knows no such key
  CHECK_THROWS_AS(make({"engine.method=event", "engine.tangential_restitution=1.5"}), InputError);
  CHECK_THROWS_AS(make({"engine.method=event", "engine.shadowed=true"}), InputError);
}

TEST_CASE("the stochastic method runs a scene, and refuses what it cannot do") {
  const auto made = make({"engine.method=stochastic", "engine.tangential_restitution=0.45",
                          "engine.restitution=0.9", "engine.friction=0.142", "grains.size_ratio=8",
                          "bed.diameter=1e-3", "incline.sin=0.2", "bed.count=100", "engine.time_step=1e-3"});
  theory::StochasticModel model;
  model.theta = std::asin(0.2);
  CHECK(mean_velocity(*made.engine) ==
        Approx(theory::mean_velocity(model, 3, 100'000).velocity).epsilon(0.02));
  CHECK_THROWS_AS(make({"engine.method=stochastic", "grains.start.velocity=0"}), InputError);
  CHECK_THROWS_AS(make({"engine.method=stochastic", "grains.count=4", "grains.start.lattice=square"}),
                  InputError);
}
