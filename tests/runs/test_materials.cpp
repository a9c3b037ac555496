// Materials with laws by pair, in every method that knows them.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <sstream>

#include "io/vtk_files.hpp"
#include "read/grain_frame.hpp"
#include "scene/world.hpp"

using namespace chute;

namespace materials_tests {

namespace {

/// e_n and μ of two materials, as the scene below gives them.
struct Pair {
  int a, b;
  double e_n, mu;
};
constexpr std::array<Pair, 3> pairs{{{0, 0, 0.5, 0.3}, {0, 1, 0.9, 0.05}, {1, 1, 0.8, 0.1}}};

const std::string two_materials = R"(
seed = 3
incline = { angle = "0 deg", gravity = 0 }
bed.kind = "none"
domain.size = [20, 20]
[[material]]
name = "light"
share = 0.5
density = 1.0
diameter.mean = 1.0
[[material]]
name = "heavy"
share = 0.5
density = 3.0
diameter.mean = 1.5
[grains]
count = 2
start = { lattice = "square", spacing = 3 }
[contact]
attraction = false
normal = { stiffness = 1e8, restitution = 0.8 }
tangential = { law = "coulomb", friction = 0.1 }
[[contact.between]]
materials = ["light", "light"]
restitution = 0.5
friction = 0.3
[[contact.between]]
materials = ["heavy", "light"]
restitution = 0.9
friction = 0.05
[run]
duration = 0.1
)";

const std::array<std::vector<std::string>, 4> methods{{{"engine.method=soft", "engine.steps_per_contact=400"},
                                                       {"engine.method=event"},
                                                       {"engine.method=hybrid", "engine.time_step=0.001"},
                                                       {"engine.method=contact", "engine.time_step=0.001"}}};

scene::Scene parse(const std::string& text, std::vector<std::string> settings,
                   const std::vector<std::string>& more = {}) {
  settings.insert(settings.end(), more.begin(), more.end());
  return scene::parse_scene(text, "scene.toml", settings);
}

double mass_of(int material) {
  const double d = material == 0 ? 1 : 1.5;
  return (material == 0 ? 1 : 3) * std::numbers::pi / 6 * d * d * d;
}
double radius_of(int material) { return material == 0 ? 0.5 : 0.75; }

/// Two grains of these materials meet along x with v_n = 2 and slip at 4 where they touch.
template <int D>
World<D> two_grains(const scene::Scene& scene, const Pair& pair) {
  World<D> world = scene::make_world<D>(scene);
  auto& g = world.grains;
  REQUIRE(g.moving == 2);
  constexpr double until = 0.02, v_n = 2, v_s = 4;
  for (std::size_t i = 0; i < 2; ++i) {
    const int material = i == 0 ? pair.a : pair.b;
    g.material[i] = material;
    g.radius[i] = radius_of(material), g.mass[i] = mass_of(material);
    g.inertia[i] = 0.4 * g.mass[i] * g.radius[i] * g.radius[i];
    g.inverse_mass[i] = 1 / g.mass[i], g.inverse_inertia[i] = 1 / g.inertia[i];
    for (int k = 0; k < D; ++k) g.position[k][i] = 5, g.velocity[k][i] = 0;
  }
  g.velocity[0][0] = v_n, g.velocity[1][0] = v_s;
  g.position[0][1] = 5 + g.radius[0] + g.radius[1] + v_n * until;
  g.position[1][1] = 5 + v_s * until;
  return world;
}

template <int D>
void check_impact(const std::vector<std::string>& method, const Pair& pair) {
  const auto scene = parse(two_materials, method,
                           D == 3 ? std::vector<std::string>{"dimensions=3", "domain.size=[20, 20, 20]"}
                                  : std::vector<std::string>{});
  const auto engine = scene.engine->make(two_grains<D>(scene, pair), scene::setting_of(scene), 1);
  const double m0 = mass_of(pair.a), m1 = mass_of(pair.b), m_eff = m0 * m1 / (m0 + m1);
  engine->advance_to(std::llround(0.05 / engine->time_step()));
  const auto g = engine->grains();
  const double J_n = m1 * g.velocity[0][1], J_s = m1 * g.velocity[1][1];
  CAPTURE(method, D, pair.a, pair.b, J_n, J_s);
  CHECK(m0 * g.velocity[0][0] + J_n == Approx(2 * m0).epsilon(1e-12));
  CHECK(m0 * g.velocity[1][0] + J_s == Approx(4 * m0).epsilon(1e-12));
  CHECK(J_n == Approx(m_eff * (1 + pair.e_n) * 2).epsilon(0.004));
  CHECK(J_s == Approx(pair.mu * J_n).epsilon(0.01));  // it slides all the time
  CHECK(engine->energy().residual() == Approx(0).margin(2e-3 * engine->energy().normal_loss));
}

}  // namespace

TEST_CASE("two grains bounce and rub with what their materials have between them, in every method") {
  for (const auto& method : methods)
    for (const auto& pair : pairs) {
      check_impact<2>(method, pair);
      check_impact<3>(method, pair);
    }
}

TEST_CASE("a ball bounces off bed and walls with what their materials have between them") {
  const std::string ball = R"(
incline = { angle = "0 deg", gravity = 1 }
bed = { kind = "flat", length = 20, material = "steel" }
[[material]]
name = "glass"
[[material]]
name = "steel"
[[material]]
name = "rubber"
[[wall]]
point = [0, 4]
normal = [0, -1]
material = "rubber"
[grains]
count = 1
diameter.mean = 1.0
start = { kind = "none", height = 1.5, velocity = 30, velocity_up = 0 }
[contact]
attraction = false
normal = { stiffness = 1e7, restitution = 0.7 }
tangential = { law = "coulomb", friction = 0.2 }
[[contact.between]]
materials = ["steel", "glass"]
restitution = 0.95
friction = 0.1
[[contact.between]]
materials = ["rubber", "glass"]
restitution = 0.3
friction = 0.5
[run]
duration = 4
)";
  for (const auto& method : methods) {
    // Down to the bed, without the wall above; and up to the wall
    for (const bool up : {false, true}) {
      auto scene =
          parse(ball, method,
                up ? std::vector<std::string>{"grains.start.velocity_up=3"} : std::vector<std::string>{});
      const auto engine = scene.engine->make(scene::make_world<2>(scene), scene::setting_of(scene), 1);
      const double v0 = up ? 3 : 0, h = up ? 2 : -1;                // way to the contact
      const double v = std::sqrt(v0 * v0 - 2 * h) * (up ? 1 : -1);  // just before it
      const double at = v0 - v, after = 0.3;
      engine->advance_to(std::llround((at + after) / engine->time_step()));
      const auto g = engine->grains();
      const double e_n = up ? 0.3 : 0.95, mu = up ? 0.5 : 0.1;
      CAPTURE(method, up, g.position[1][0]);
      CHECK(g.velocity[1][0] + after == Approx(-e_n * v).epsilon(0.01));
      CHECK(30 - g.velocity[0][0] == Approx(mu * (1 + e_n) * std::abs(v)).epsilon(0.02));
    }
  }
}

TEST_CASE(
    "a grain on a bed holds by the static friction of the two materials, and slides with their other one") {
  const std::string block = R"(
incline = { tan = 0.3, gravity = 1 }
bed = { kind = "flat", length = 20, material = "steel" }
[[material]]
name = "glass"
[[material]]
name = "steel"
[grains]
count = 1
diameter.mean = 1.0
rotation = false
start = { kind = "none", height = 0.5, velocity = 0 }
[contact]
normal = { stiffness = 1e5, restitution = 0.5 }
tangential = { law = "coulomb", friction = 0.1 }
[engine]
method = "contact"
[run]
duration = 4
)";
  const auto way = [&](const std::string& between) {
    const auto scene = parse(block, {"contact.between=[" + between + "]"});
    const auto engine = scene.engine->make(scene::make_world<2>(scene), scene::setting_of(scene), 1);
    const auto x = [&] { return engine->grains().unwrapped(0, 0); };
    const double from = x();
    engine->advance_to(std::llround(4 / engine->time_step()));
    return x() - from;
  };
  const double sine = 0.3 / std::sqrt(1.09), cosine = 1 / std::sqrt(1.09);
  CHECK(way(R"({materials=["glass", "steel"], friction=0.2, static_friction=0.4})") ==
        Approx(0).margin(1e-6));
  CHECK(way(R"({materials=["glass", "steel"], friction=0.2})") ==
        Approx(8 * (sine - 0.2 * cosine)).epsilon(0.01));
  CHECK(way(R"({materials=["glass", "glass"], friction=0.4})") ==
        Approx(8 * (sine - 0.1 * cosine)).epsilon(0.01));
}

namespace {

const std::string flow = R"(
seed = 5
incline.angle = "20 deg"
bed = { kind = "row", count = 12 }
[grains]
count = 60
diameter = { mean = 1.0, std = 0.05 }
start = { lattice = "square", spacing = 1.25, velocity = 2.0, spread = 1.0 }
[contact]
normal = { stiffness = 1e5, restitution = 0.6 }
tangential = { law = "coulomb-viscous", viscosity = 50, friction = 0.5 }
[run]
duration = 3
)";

/// The whole state after a while, as a checkpoint has it.
std::string state_after(const scene::Scene& scene, int threads = 1, double time = 1.5) {
  const auto advance = [&](const auto& engine) {
    engine->advance_to(std::llround(time / engine->time_step()));
    std::ostringstream out;
    engine->save(out);
    return out.str();
  };
  const auto setting = scene::setting_of(scene);
  return scene.dimensions == 2 ? advance(scene.engine->make(scene::make_world<2>(scene), setting, threads))
                               : advance(scene.engine->make(scene::make_world<3>(scene), setting, threads));
}

}  // namespace

TEST_CASE(
    "one material with a name is as none, to the bytes; so are several that have nothing of their own") {
  const std::string
      one = "material=[{name=\"glass\"}]",
      several = "material=[{name=\"a\", share=0.5}, {name=\"b\", share=0.3}, {name=\"c\", share=0.2}]";
  for (const auto& method : methods) {
    const auto without = state_after(parse(flow, method));
    CAPTURE(method);
    const bool named = state_after(parse(flow, method, {one})) == without,
               parted = state_after(parse(flow, method, {several})) == without;
    CHECK(named);
    CHECK(parted);
  }
}

TEST_CASE(
    "laws by pair that are the same for all pairs give the bytes of one law, with and without a memory, in space and in the plane") {
  const std::string
      materials = "material=[{name=\"a\", share=0.5}, {name=\"b\", share=0.5}]",
      same =
          "contact.between=[{materials=[\"a\",\"b\"], friction=0.5}, {materials=[\"a\",\"a\"], restitution=0.6}]";
  const std::vector<std::vector<std::string>> laws{
      {"engine.method=soft"},
      {"engine.method=soft", "contact.normal={law=\"walton-braun\", stiffness=1e5, restitution=0.6}",
       "contact.tangential={law=\"cundall-strack\", stiffness_ratio=0.28, friction=0.5}"},
      {"engine.method=soft", "dimensions=3", "bed={kind=\"lattice\", count=5, count_across=4}",
       "contact.tangential={law=\"walton-braun-mindlin\", stiffness_ratio=0.28, friction=0.5}"},
      {"engine.method=soft",
       "contact.normal={law=\"hertz-linear-damping\", stiffness=1e5, restitution=0.6, at_velocity=1}",
       "contact.tangential={law=\"mindlin\", stiffness_ratio=0.8, friction=0.5}",
       "grains.diameter.std=0"},  // for its restitution is that of mean grains
      methods[1],
      methods[2],
      methods[3]};
  for (const auto& law : laws) {
    CAPTURE(law);
    const bool alike = state_after(parse(flow, law, {materials, same})) == state_after(parse(flow, law));
    CHECK(alike);
  }
}

namespace {

const std::vector<std::string> mixture{
    "material=[{name=\"a\", share=0.4, density=2}, {name=\"b\", share=0.6, diameter={kind=\"uniform\", from=0.7, to=1.1}}, {name=\"bed\"}]",
    "bed.material=bed",
    "contact.between=[{materials=[\"a\",\"b\"], friction=0.1, normal={stiffness=3e4}}, {materials=[\"bed\",\"b\"], restitution=0.9, friction=1.0}, "
    "{materials=[\"a\",\"a\"], friction=0}]"};

}  // namespace

TEST_CASE("a mixture's energy account closes, whatever its laws") {
  for (std::vector<std::string> law :
       {std::vector<std::string>{},
        {"contact.tangential={law=\"cundall-strack\", stiffness_ratio=0.28, friction=0.5}"},
        {"contact.normal={law=\"walton-braun\", stiffness=1e5, restitution=0.6}",
         "contact.tangential={law=\"walton-braun-mindlin\", stiffness_ratio=0.28, friction=0.5}"}}) {
    law.insert(law.end(), mixture.begin(), mixture.end());
    const auto scene = parse(flow, law);
    const auto engine = scene.engine->make(scene::make_world<2>(scene), scene::setting_of(scene), 1);
    engine->advance_to(std::llround(3 / engine->time_step()));
    const auto e = engine->energy();
    CAPTURE(law);
    CHECK(e.normal_loss > 10);
    CHECK(std::abs(e.residual()) < 2e-3 * (e.normal_loss + e.shear_loss));
  }
}

TEST_CASE("a mixture of bodies of one sphere moves as round grains do, to the bytes") {
  for (const auto& law :
       {std::string("contact.attraction=true"),
        std::string("contact.tangential={law=\"cundall-strack\", stiffness_ratio=0.28, friction=0.5}")}) {
    const auto after = [&](const std::string& shapes) {
      const auto scene = parse(flow, mixture, {law, shapes});
      const auto engine = scene.engine->make(scene::make_world<2>(scene), scene::setting_of(scene), 1);
      engine->advance_to(std::llround(1.5 / engine->time_step()));
      const auto g = engine->grains();
      std::vector<double> all;
      for (const auto& column : {g.position[0], g.position[1], g.spin[0]})
        all.insert(all.end(), column.begin(), column.begin() + static_cast<std::ptrdiff_t>(g.moving));
      return all;
    };
    CAPTURE(law);
    const bool alike = after("grains.shape=[{aspect=1}]") == after("grains.independent=false");
    CHECK(alike);
  }
}

TEST_CASE("rods of one material among round grains of another: energy and laws are those of their pairs") {
  // Of rods no pair has friction, and so their spin changes by what their arms do; round grains then never turn.
  const auto scene = parse(
      flow, {"material=[{name=\"a\", share=0.5}, {name=\"b\", share=0.5, density=3}, {name=\"bed\"}]",
             "bed.material=bed", "grains.start.spacing=1.7", "grains.shape=[{aspect=2, material=\"a\"}]",
             "contact.tangential={law=\"coulomb-viscous\", viscosity=50, friction=0}",
             "contact.between=[{materials=[\"a\",\"a\"], restitution=0.3}]"});
  const auto engine = scene.engine->make(scene::make_world<2>(scene), scene::setting_of(scene), 1);
  engine->advance_to(std::llround(3 / engine->time_step()));
  const auto g = engine->grains();
  int turned = 0;
  for (std::size_t i = 0; i < g.moving; ++i) {
    if (g.material[i] == 1) CHECK(std::abs(g.spin[0][i]) < 1e-12);
    turned += std::abs(g.spin[0][i]) > 1e-3;
  }
  CHECK(turned > 20);
  const auto e = engine->energy();
  CHECK(e.normal_loss > 10);
  CHECK(std::abs(e.residual()) < 2e-3 * e.normal_loss);
}

TEST_CASE("momentum of a mixture is conserved where nothing acts from outside") {
  auto settings = mixture;
  settings[1] = "bed={kind=\"none\"}";
  settings.insert(settings.end(),
                  {"incline.gravity=0", "domain.size=[12, 12]", "domain.periodic=[\"x\", \"y\"]"});
  const auto scene = parse(flow, settings);
  const auto engine = scene.engine->make(scene::make_world<2>(scene), scene::setting_of(scene), 1);
  const auto momentum = [&] {
    const auto g = engine->grains();
    std::array<double, 2> p{};
    for (std::size_t i = 0; i < g.moving; ++i)
      for (std::size_t k = 0; k < 2; ++k) p[k] += g.mass[i] * g.velocity[k][i];
    return p;
  };
  const auto before = momentum();
  engine->advance_to(std::llround(2 / engine->time_step()));
  CHECK(engine->energy().normal_loss > 1);
  for (std::size_t k = 0; k < 2; ++k) CHECK(momentum()[k] == Approx(before[k]).epsilon(1e-10));
}

TEST_CASE("a mixture goes on from a checkpoint as if it had not stopped, and at any number of threads") {
  const std::vector<std::string> memory{
      "contact.tangential={law=\"cundall-strack\", stiffness_ratio=0.28, friction=0.5}"};
  for (const auto& law : {std::vector<std::string>{}, memory})
    for (const auto& method : methods) {
      auto settings = mixture;
      settings.insert(settings.end(), law.begin(), law.end());
      const bool soft = method.front().ends_with("soft");
      if (!soft && !law.empty()) continue;
      const auto scene = parse(flow, settings, method);
      const auto setting = scene::setting_of(scene);
      const auto make = [&] { return scene.engine->make(scene::make_world<2>(scene), setting, 1); };
      const auto whole = make(), first = make(), second = make();
      const auto half = std::llround(0.7 / whole->time_step());
      std::stringstream kept;
      first->advance_to(half), first->save(kept);
      second->restore(kept);
      std::ostringstream straight, resumed;
      whole->advance_to(half), whole->advance_to(2 * half), whole->save(straight);
      second->advance_to(2 * half), second->save(resumed);
      CAPTURE(method, law);
      const bool alike = straight.str() == resumed.str();
      CHECK(alike);
    }
  const std::vector<std::string> many{"grains.count=4200", "bed.count=600"};
  for (const auto& law : {std::vector<std::string>{}, memory}) {
    auto settings = mixture;
    settings.insert(settings.end(), law.begin(), law.end());
    const auto scene = parse(flow, settings, many);
    const bool alike = state_after(scene, 1, 0.05) == state_after(scene, 2, 0.05);
    CHECK(alike);
  }
}

TEST_CASE("the time step resolves the stiffest pair") {
  const auto step = [](const std::vector<std::string>& settings) {
    const auto scene = parse(flow, settings, {"grains.diameter.std=0", "output.series.every=1e6"});
    return scene.engine->step(scene::setting_of(scene));
  };
  const std::string materials = "material=[{name=\"a\", share=0.5}, {name=\"b\", share=0.5, density=0.5}]";
  // t_n ∝ √(m_eff/k): stiffer by 16, and half as dense
  const double usual = step({}), mass = 6 / std::numbers::pi;
  CHECK(step({materials, "contact.between=[{materials=[\"a\",\"a\"], normal={stiffness=16e5}}]",
              fmt::format("grains.density={}", mass)}) == Approx(usual / 4).epsilon(1e-3));
  CHECK(step({materials, "contact.between=[{materials=[\"b\",\"b\"], normal={stiffness=4e5}}]"}) ==
        Approx(usual * std::sqrt(0.5 / mass) / 2).epsilon(1e-3));
}

TEST_CASE("frames name the materials, and pictures read their names") {
  const auto scene = parse(two_materials, methods[0]);
  const auto world = scene::make_world<2>(scene);
  auto facts = io::facts_of(world, "reduced");
  facts.materials = {"light", "heavy"};
  const std::array<Array, 2> force;
  const auto bytes = io::grains_vtp(view_of<2>(world.grains, force, world.domain, 0), facts);
  const auto frame = read::parse_frame({{"frame.vtp", bytes}});
  const auto* species = frame.find("species");
  REQUIRE(species);
  CHECK(species->words == std::vector<std::string>{"light", "heavy"});
  for (std::size_t i = 0; i < frame.size(); ++i) CHECK(species->at(i) == world.grains.material[i]);
  facts.materials.clear();  // no names, no array
  CHECK_FALSE(read::parse_frame(
                  {{"frame.vtp", io::grains_vtp(view_of<2>(world.grains, force, world.domain, 0), facts)}})
                  .find("species"));
}

TEST_CASE("a pair's contact time is that of its own mean grains") {
  const auto scene =
      parse(flow, {"material=[{name=\"a\", share=0.5}, {name=\"b\", share=0.5, density=30}]",
                   "contact.between=[{materials=[\"a\",\"b\"], normal={contact_time=0.02, restitution=0.8}}]",
                   "grains.diameter.std=0"});
  const auto fact = [&](const std::string& name) {
    for (const auto& f : scene.engine->facts(scene::setting_of(scene)))
      if (f.name == name) return f.value;
    return 0.0;
  };
  CHECK(fact("t_n a-b") == Approx(0.02));
  CHECK(fact("e_n a-b") == Approx(0.8));
  // m_eff of two equal ones is half of m, and t_n goes as its root at equal restitution
  CHECK(fact("t_n b-b") / fact("t_n a-a") == Approx(std::sqrt(30 / (6 / std::numbers::pi))));
}

}  // namespace materials_tests
