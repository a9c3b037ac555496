#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <sstream>

#include "../runs/make_engine.hpp"
#include "common/error.hpp"
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

test::Made make(const std::vector<std::string>& settings) {
  return test::make_engine(scene::parse_scene(ball, "ball.toml", settings));
}
double mean_velocity(Engine& engine) {
  const auto at = [&](double t) {
    engine.advance_to(std::llround(t / engine.time_step()));
    return engine.grains().unwrapped(0, 0);
  };
  const double from = at(2);
  return (at(10) - from) / 8;
}

/// The same over whole beads: between the first and the last hit on a new bead.
double mean_velocity_over_beads(Engine& engine, double from, double to) {
  engine.advance_to(std::llround(from / engine.time_step()));
  engine.collect_impacts(true);
  engine.advance_to(std::llround(to / engine.time_step()));
  std::int64_t bead = -1;
  double first = 0, last = 0;
  int passed = -2;  // the bead that it is on is passed in part
  for (const auto& impact : engine.take_impacts()) {
    if (impact.bead == bead) continue;
    bead = impact.bead;
    last = impact.time;
    if (++passed == 0) first = last;
  }
  return passed * 0.01 / (last - first);
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

TEST_CASE(
    "one ball, bouncing and rolling: soft and hard agree on v_x to 0.1 % at k_n = 2e8 N/m, 0.3 % at 2e6") {
  // (3.12) sticks like β = 0 when γ_s is large against m/t_n: it grows like the square root of k_n.
  for (const auto& [phi, sine] : {std::pair{"2.25", "0.05"}, std::pair{"3", "0.05"}}) {
    const std::vector<std::string> line{fmt::format("grains.size_ratio={}", phi),
                                        fmt::format("incline.sin={}", sine)};
    const auto with = [&](std::vector<std::string> settings) {
      settings.insert(settings.end(), line.begin(), line.end());
      return mean_velocity_over_beads(*make(settings).engine, 3, 7);
    };
    const double hard =
        with({"engine.method=event", "engine.tangential_restitution=0", "engine.contact_time=1e-5"});
    const double soft = with({"contact.normal.stiffness=2e6", "contact.tangential.viscosity=1e3"}),
                 stiff = with({"contact.normal.stiffness=2e8", "contact.tangential.viscosity=1e4"});
    CAPTURE(phi, hard, soft, stiff);
    CHECK(stiff == Approx(hard).epsilon(1e-3));
    CHECK(soft == Approx(hard).epsilon(3e-3));
  }
}

TEST_CASE("in region C the hard ball goes on getting faster, and soft ones do not: the stiffer the later") {
  const auto speeds = [](std::vector<std::string> settings) {
    settings.push_back("incline.sin=0.3");
    auto made = make(settings);
    const auto at = [&](double t) {
      made.engine->advance_to(std::llround(t / made.engine->time_step()));
      return made.engine->grains().unwrapped(0, 0);
    };
    std::array<double, 3> mean{};  // over 20 s each
    double before = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double now = at(20.0 * static_cast<double>(k + 1));
      mean[k] = (now - before) / 20;
      before = now;
    }
    return mean;
  };
  const auto hard = speeds({"engine.method=event", "engine.tangential_restitution=0.34"});
  CHECK(hard[1] > 1.5 * hard[0]);
  CHECK(hard[2] > 1.25 * hard[1]);
  double slower = 0;
  for (const char* stiffness : {"1e4", "2e4"}) {
    const auto soft =
        speeds({fmt::format("contact.normal.stiffness={}", stiffness), "engine.deepest_overlap=1"});
    CAPTURE(stiffness, soft[0], soft[1], soft[2]);
    CHECK(soft[2] == Approx(soft[1]).epsilon(0.05));
    CHECK(soft[2] > 1.2 * slower);
    CHECK(soft[2] < 0.7 * hard[2]);
    slower = soft[2];
  }
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
