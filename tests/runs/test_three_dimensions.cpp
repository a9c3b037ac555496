// Scenes in three dimensions, walls, and starts from what others left.
#include <catch2/catch.hpp>
#include <numeric>

#include "common/error.hpp"
#include "folder.hpp"
#include "make_engine.hpp"
#include "run/run.hpp"
#include "scene/world.hpp"

using namespace chute;
using namespace chute::test;

namespace three_dimensions_tests {

namespace {

double mean_velocity(const scene::Scene& scene, double from, double to) {
  const auto made = make_engine(scene);
  const auto place_at = [&](double t) {
    made.engine->advance_to(std::llround(t / made.engine->time_step()));
    return made.engine->grains().unwrapped(0, 0);
  };
  const double begin = place_at(from);
  return (place_at(to) - begin) / (to - from);
}

/// A box of spheres above a smooth plane, small enough for a test.
std::vector<std::string> small(std::vector<std::string> more = {}) {
  more.insert(more.end(), {"grains.count=40", "domain.size=[4, 4]", "contact.normal.stiffness=2e4",
                           "run.duration=14", "output.frames=", "output.contacts=false",
                           "output.fields=", "output.profiles={from=12, bin=0.5, every=0.05}"});
  return more;
}

}  // namespace

// With e_n = 0.1 the ball's motion repeats from bead to bead, so that means can be compared; with 0.7 it bounces
// irregularly, and rounding, which differs, grows: there only the first bounces can.
TEST_CASE("a ball in space that runs over a single row, at y = 0, moves as one in the plane") {
  for (const char* method : {"soft", "event"}) {
    const auto scene = [&](const char* e_n, std::vector<std::string> settings) {
      settings.insert(settings.end(), {"grains.start.spread=0", std::string("engine.method=") + method,
                                       std::string("contact.normal.restitution=") + e_n, "incline.sin=0.08"});
      return scene::read_scene(scenes + "ball-2d.toml", settings);
    };
    const std::vector<std::string> in_space{"dimensions=3", "domain.size=[0.5, 0.2]"};
    const double plane = mean_velocity(scene("0.1", {}), 1, 5),
                 space = mean_velocity(scene("0.1", in_space), 1, 5);
    CAPTURE(method, plane, space);
    CHECK(space == Approx(plane).epsilon(1e-4));
    const auto flat = make_engine(scene("0.7", {})), deep = make_engine(scene("0.7", in_space));
    for (const auto* made : {&flat, &deep})
      made->engine->advance_to(std::llround(0.2 / made->engine->time_step()));
    const auto a = flat.engine->grains(), b = deep.engine->grains();
    CHECK(b.position[0][0] == Approx(a.position[0][0]).epsilon(1e-9));
    CHECK(b.velocity[2][0] == Approx(a.velocity[1][0]).epsilon(1e-7));
    CHECK(b.spin[1][0] == Approx(-a.spin[0][0]).epsilon(1e-7));
    CHECK(b.position[1][0] == 0);
  }
}

TEST_CASE(
    "spheres that fall on a smooth plane come to rest, weigh what they weigh, and their account closes") {
  const Folder folder;
  run::RunOptions options;
  options.directory = folder / "run";
  const auto scene = scene::read_scene(scenes + "settle-3d.toml", small());
  run::run_scene(scene, options);
  const auto world = scene::make_world<3>(scene);
  const auto& m = world.grains.mass;
  const double weight = std::accumulate(m.begin(), m.end(), 0.0);
  const auto load = column(folder / "run" / "profiles.csv", "contact_zz");
  CHECK(load[0] * 16 == Approx(weight).epsilon(0.01));  // half a diameter above the plane lies no centre
  const auto eta = column(folder / "run" / "profiles.csv", "eta_exact");
  const double volume =
      std::accumulate(world.grains.radius.begin(), world.grains.radius.end(), 0.0,
                      [](double sum, double R) { return sum + 4.0 / 3 * M_PI * R * R * R; });
  CHECK(std::accumulate(eta.begin(), eta.end(), 0.0) * 0.5 * 16 == Approx(volume).epsilon(0.01));
  const auto series = folder / "run" / "series.csv";
  const auto moving = column(series, "translation"), work = column(series, "gravity_work"),
             residual = column(series, "residual");
  CHECK(moving.back() < 1e-4 * work.back());
  CHECK(std::abs(residual.back()) < 2e-3 * work.back());
}

TEST_CASE("a ball on a smooth plane bounces to e_n^2 of its height, with soft and with hard grains") {
  for (const char* method : {"soft", "event"}) {
    for (const int dimensions : {2, 3}) {
      const auto scene = scene::read_scene(
          scenes + "settle-3d.toml",
          {"dimensions=" + std::to_string(dimensions),
           dimensions == 2 ? "domain.periodic=[\"x\"]" : "domain.periodic=[\"x\", \"y\"]", "grains.count=1",
           "grains.diameter.std=0", "grains.start={lattice=\"none\", height=3.5}",
           "contact.normal.stiffness=1e7", std::string("engine.method=") + method, "output.impacts={from=0}",
           "run.duration=7"});
      const auto made = make_engine(scene);
      made.engine->collect_impacts(true);
      made.engine->advance_to(std::llround(7 / made.engine->time_step()));
      const auto impacts = made.engine->take_impacts();
      CAPTURE(method, dimensions, impacts.size());
      REQUIRE(impacts.size() >= 3);
      CHECK(impacts[0].v_n == Approx(-std::sqrt(2 * 3.0)).epsilon(2e-3));
      for (std::size_t k = 1; k < 3; ++k)
        CHECK(impacts[k].v_n == Approx(0.5 * impacts[k - 1].v_n).epsilon(0.02));
      CHECK(impacts[0].bead == wall_id(0));
      CHECK(impacts[0].gamma == Approx(0).margin(1e-12));
    }
  }
}

// I = 2/5 m R²: it rolls with 5/7 g sin θ as long as tan θ < 7/2 μ, and slides with g (sin θ − μ cos θ) beyond.
TEST_CASE("a ball on an inclined smooth plane rolls or slides as the closed form has it") {
  for (const auto& [degrees, friction] : {std::pair{20.0, 0.5}, {40.0, 0.1}}) {
    const double theta = degrees * M_PI / 180, t = 3;
    const auto scene =
        scene::read_scene(scenes + "settle-3d.toml",
                          {"incline.angle=" + std::to_string(degrees) + " deg", "grains.count=1",
                           "grains.diameter.std=0", "grains.start={lattice=\"none\", height=0.49999}",
                           "contact.tangential.friction=" + std::to_string(friction),
                           "contact.normal.stiffness=1e5", "run.duration=3"});
    const auto made = make_engine(scene);
    made.engine->advance_to(std::llround(t / made.engine->time_step()));
    const bool rolls = std::tan(theta) < 3.5 * friction;
    const double a = rolls ? 5.0 / 7 * std::sin(theta) : std::sin(theta) - friction * std::cos(theta);
    const auto grains = made.engine->grains();
    CAPTURE(degrees, friction);
    CHECK(grains.velocity[0][0] == Approx(a * t).epsilon(5e-3));
    if (rolls) CHECK(grains.spin[1][0] * 0.5 == Approx(a * t).epsilon(5e-3));
    // turned about y, by the way over the radius where it rolls
    const double angle = 2 * std::atan2(grains.orientation[2][0], grains.orientation[0][0]);
    if (rolls) CHECK(std::cos(angle) == Approx(std::cos(a * t * t / 2 / 0.5)).margin(0.05));
    const auto contacts = made.engine->contacts();
    REQUIRE(contacts.size() == 1);
    CHECK(contacts[0].b == wall_id(0));
    CHECK(contacts[0].normal_force == Approx(std::cos(theta)).epsilon(5e-3));
    CHECK(contacts[0].point[2] == Approx(0).margin(1e-3));
  }
}

TEST_CASE("a run of spheres is the same bytes, interrupted or not, with any number of threads") {
  const Folder folder;
  for (const char* scene_file : {"settle-3d.toml", "chute-3d.toml"}) {
    const bool chute = std::string(scene_file) == "chute-3d.toml";
    auto settings = chute ? std::vector<std::string>{"grains.count=60",          "bed.count=5",
                                                     "bed.count_across=4",       "run.duration=1",
                                                     "output.profiles.from=0.5", "output.fields.from=0.5"}
                          : small({"run.duration=3", "output.profiles=", "output.checkpoint=0.7"});
    if (!chute) settings.push_back("run.duration=3"), settings.push_back("output.profiles=");
    const auto scene = scene::read_scene(scenes + scene_file, settings);
    run::RunOptions options;
    options.directory = folder / (std::string("whole") + scene_file);
    run::run_scene(scene, options);
    options.directory = folder / (std::string("parts") + scene_file);
    options.threads = 2;
    int calls = 0;
    options.progress = [&](double) { return ++calls < 2; };
    auto done = run::run_scene(scene, options).finished;
    options.existing = run::Existing::resume;
    options.progress = nullptr;
    if (!done) CHECK(run::run_scene(scene, options).finished);
    for (const auto& [name, bytes] : tree(folder / (std::string("whole") + scene_file)))
      if (name != "run.json") CHECK(content(folder / (std::string("parts") + scene_file) / name) == bytes);
  }
}

TEST_CASE("a scene goes on from what another run left, with another method too") {
  const Folder folder;
  run::RunOptions options;
  options.directory = folder / "first";
  const std::vector<std::string> settings = small({"output.checkpoint=1", "run.duration=2"});
  auto first = scene::read_scene(scenes + "settle-3d.toml", [&] {
    auto s = settings;
    s.insert(s.end(), {"run.duration=2", "output.profiles=", "output.frames={every=0.5}"});
    return s;
  }());
  run::run_scene(first, options);
  const auto from = [&](std::vector<std::string> more) {
    auto s = settings;
    s.insert(s.end(), {"run.duration=1", "output.profiles=", "grains.count=", "grains.diameter="});
    s.insert(s.end(), more.begin(), more.end());
    return scene::read_scene(scenes + "settle-3d.toml", s);
  };
  const auto run = (folder / "first").string();
  const auto last = make_engine(from({"grains.start={from=\"" + run + "\"}"}));
  const auto fourth = make_engine(from({"grains.start={from=\"" + run + "\", frame=4}"}));
  const auto at = make_engine(from({"grains.start={from=\"" + run + "\", time=2.0}"}));
  const auto file = make_engine(from({"grains.start={from=\"" + run + "/frames/000004.vtp\"}"}));
  for (const auto* made : {&fourth, &at, &file})
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = last.engine->grains(), b = made->engine->grains();
      REQUIRE(a.moving == 40);
      REQUIRE(b.moving == 40);
      for (std::size_t i = 0; i < 40; ++i) {
        CHECK(a.position[k][i] == b.position[k][i]);
        CHECK(a.velocity[k][i] == b.velocity[k][i]);
        CHECK(a.spin[k][i] == b.spin[k][i]);
      }
    }
  CHECK(last.engine->grains().orientation[0][3] != 1);  // it goes on turned as it was
  // some of them can be pushed downhill: those that lie higher than the others
  const auto pushed = make_engine(from({"grains.start={from=\"" + run + "\", velocity=2, above=1.2}"}));
  const auto rest = last.engine->grains(), some = pushed.engine->grains();
  int high = 0;
  for (std::size_t i = 0; i < 40; ++i) {
    const bool above = rest.position[2][i] > 1.2;
    high += above;
    CHECK(some.velocity[0][i] == rest.velocity[0][i] + (above ? 2 : 0));
    CHECK(some.velocity[2][i] == rest.velocity[2][i]);
  }
  CHECK(high > 5);
  CHECK(high < 35);
  // hard grains take over, in flight and where soft ones overlapped: they move as far as that, and no farther
  const auto settled = make_engine(from({"grains.start={from=\"" + run + "\"}", "engine.method=event"}));
  const auto a = last.engine->grains(), b = settled.engine->grains();
  double overlap = 0, way = 0;
  for (std::size_t i = 0; i < 40; ++i) {
    for (std::size_t j = i + 1; j < 40; ++j) {
      const auto gap = [&](const GrainsView& g) {
        return std::hypot(g.position[0][i] - g.position[0][j], g.position[1][i] - g.position[1][j],
                          g.position[2][i] - g.position[2][j]) -
               g.radius[i] - g.radius[j];
      };
      overlap = std::max(overlap, -gap(a));
      CHECK(gap(b) > -2e-9);
    }
    for (std::size_t k = 0; k < 3; ++k) way = std::max(way, std::abs(a.position[k][i] - b.position[k][i]));
  }
  CHECK(overlap > 1e-6);  // there was something to do
  CHECK(way < 0.05);
  settled.engine->advance_to(5);
  const auto hard = from({"grains.start={from=\"" + run + "\", frame=0}", "engine.method=event"});
  const auto other = make_engine(hard);
  other.engine->advance_to(20);
  CHECK(other.engine->grains().moving == 40);
  const auto refused = [&](const std::string& start) {
    return message<InputError>([&] { from({"grains.start={" + start + "}"}); });
  };
  CHECK_THAT(refused("from=\"" + run + "\", frame=99"),
             Catch::Contains("frame: 99 is not there, the run has frames 0 to 4"));
  CHECK_THAT(refused("from=\"" + run + "\", time=0.3"), Catch::Contains("no frame at 0.3"));
  CHECK_THAT(refused("from=\"nowhere\""), Catch::Contains("nowhere: no such run or file"));
  write(folder / "damaged.vtp", content(folder / "first" / "frames" / "000004.vtp").substr(0, 2000));
  CHECK_THAT(refused("from=\"" + (folder / "damaged.vtp").string() + "\""), Catch::Contains("damaged.vtp: "));
}

TEST_CASE("domains say what they lack") {
  const auto refused = [&](std::vector<std::string> settings) {
    return message<InputError>([&] { scene::read_scene(scenes + "settle-3d.toml", settings); });
  };
  CHECK_THAT(refused({"domain.size=[8]"}),
             Catch::Contains("domain.size: missing: how long is a period along y"));
  CHECK_THAT(refused({"domain.periodic=[\"q\"]"}),
             Catch::Contains("\"q\" is no direction, allowed: x, y, z"));
  CHECK_THAT(refused({"bed={kind=\"lattice\", count=8, count_across=8}", "domain.size=[9, 8]"}),
             Catch::Contains("is not the bed's own length"));
  CHECK_THAT(refused({"dimensions=2", "bed={kind=\"lattice\", count=8, count_across=8}"}),
             Catch::Contains("it needs dimensions = 3"));
  CHECK_THAT(refused({"domain.size=[2, 8]"}), Catch::Contains("would touch its own image"));
  CHECK_THAT(refused({"engine.method=stochastic"}), Catch::Contains("knows no third dimension"));
}

// Without friction an impact pushes along the line of centres: Δv_y/Δv_x = tan φ, whatever e_n.
TEST_CASE("a frictionless impact on a bead deflects a ball by the azimuth of where it hits") {
  for (const char* method : {"soft", "event"}) {
    const auto scene = scene::read_scene(
        scenes + "ball-3d.toml",
        {"incline.angle=0 deg", "contact.tangential={law=\"frictionless\"}", "contact.normal.stiffness=2e9",
         "bed={kind=\"lattice\", diameter=0.001, count=40, count_across=40}",
         "grains.start={lattice=\"none\", x=0.0203, y=0.0202, "
         "height=0.0035, velocity=0}",
         "run.duration=0.1", "output.impacts={from=0}", std::string("engine.method=") + method});
    const auto made = make_engine(scene);
    made.engine->collect_impacts(true);
    std::vector<Impact> impacts;
    std::array<double, 2> before{}, after{};
    for (int k = 1; impacts.empty() && k < 3000; ++k) {
      const auto g = made.engine->grains();
      before = {g.velocity[0][0], g.velocity[1][0]};
      made.engine->advance_to(made.engine->step() + 200);
      impacts = made.engine->take_impacts();
    }
    REQUIRE(impacts.size() == 1);
    const auto g = made.engine->grains();
    after = {g.velocity[0][0], g.velocity[1][0]};
    CAPTURE(method, impacts[0].phi);
    CHECK((after[1] - before[1]) / (after[0] - before[0]) == Approx(std::tan(impacts[0].phi)).epsilon(1e-3));
  }
}

// A plane has no place of its own: moved by a part of its period, with the ball, it is the same run.
TEST_CASE("a ball does not notice where a period of the plane begins") {
  const auto scene = scene::read_scene(
      scenes + "ball-3d.toml",
      {"bed.count=408", "bed.size=[0.035575, 0.013756]", "grains.size_ratio=3", "run.duration=0.4"});
  const auto run = [&](double dx, double dy) {
    auto world = scene::make_world<3>(scene);
    for (std::size_t i = 0; i < world.grains.size(); ++i)
      for (const auto& [k, shift] : {std::pair<std::size_t, double>{0, dx}, {1, dy}}) {
        auto& x = world.grains.position[k][i];
        x += shift;
        const double period = world.domain.length[static_cast<int>(k)];
        if (i >= world.grains.moving) x -= period * std::floor(x / period);
      }
    auto engine = scene.engine->make(std::move(world), scene::setting_of(scene), 1);
    engine->advance_to(std::llround(0.15 / engine->time_step()));
    return std::array{engine->grains().unwrapped(0, 0) - dx, engine->grains().unwrapped(0, 1) - dy};
  };
  const auto here = run(0, 0), there = run(0.35 * 0.035575, 0.61 * 0.013756);
  for (std::size_t k = 0; k < 2; ++k) CHECK(there[k] == Approx(here[k]).margin(1e-7));
}

// No force but that of the contact acts on two free spheres: whatever it is, it leaves their momentum as it was, and their
// angular momentum but for the arms, which overlap shortens (hard spheres have none).
TEST_CASE("an oblique impact of two spinning spheres in space keeps momentum and angular momentum") {
  for (const char* method : {"soft", "event"}) {
    const auto scene = scene::read_scene(
        scenes + "settle-3d.toml",
        {"grains.count=2", "grains.diameter.std=0", "contact.normal.stiffness=1e7",
         "contact.tangential={law=\"coulomb-viscous\", friction=0.4, viscosity=1e4, relaxation_steps=12}",
         std::string("engine.method=") + method});
    auto world = scene::make_world<3>(scene);
    world.gravity = {};
    auto& g = world.grains;
    const std::array<Vec<3>, 2> place{{{{3, 3, 5}}, {{4.2, 3.4, 5.3}}}},
        velocity{{{{1, 0, 0}}, {{-1, 0.3, -0.2}}}}, spin{{{{1, -2, 0.5}}, {{0.3, 2, -1}}}};
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        g.position[k][i] = place[i][k], g.velocity[k][i] = velocity[i][k], g.spin[k][i] = spin[i][k];
    const auto engine = scene.engine->make(std::move(world), scene::setting_of(scene), 1);
    const auto momenta = [&] {
      const auto v = engine->grains();
      std::array<Vec<3>, 2> sum{};
      for (std::size_t i = 0; i < 2; ++i) {
        Vec<3> r, p, L;
        for (std::size_t k = 0; k < 3; ++k) {
          r[k] = v.unwrapped(i, k), p[k] = v.mass[i] * v.velocity[k][i];
          L[k] = 0.4 * v.mass[i] * v.radius[i] * v.radius[i] * v.spin[k][i];
        }
        sum[0] = sum[0] + p, sum[1] = sum[1] + L + cross(r, p);
      }
      return sum;
    };
    const auto before = momenta();
    const double energy = engine->energy().stored();
    engine->advance_to(std::llround(0.5 / engine->time_step()));
    const auto after = momenta();
    CAPTURE(method);
    CHECK(engine->energy().stored() < 0.9 * energy);  // they have met
    CHECK(norm(after[0] - before[0]) < 1e-11);
    const bool soft = std::string_view(method) == "soft";
    CHECK(norm(after[1] - before[1]) < (soft ? 1e-3 : 1e-11));
    CHECK(std::abs(engine->energy().residual()) < (soft ? 1e-3 : 1e-11) * energy);
  }
}

TEST_CASE("the energy account of a ball that runs down a plane of beads closes") {
  for (const char* method : {"soft", "event"}) {
    const auto scene = scene::read_scene(
        scenes + "ball-3d.toml", {"bed.count=408", "bed.size=[0.035575, 0.013756]", "grains.size_ratio=3",
                                  "contact.normal.restitution=0.8", std::string("engine.method=") + method});
    const auto made = make_engine(scene);
    made.engine->advance_to(std::llround(0.5 / made.engine->time_step()));
    const auto account = made.engine->energy();
    CAPTURE(method, account.gravity_work, account.normal_loss, account.shear_loss);
    CHECK(std::abs(account.residual()) < 2e-3 * account.gravity_work);
    CHECK(account.normal_loss > account.shear_loss);  // thesis 4.3.4.1: most dissipation is normal
  }
}

}  // namespace three_dimensions_tests
