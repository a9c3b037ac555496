#include <catch2/catch.hpp>

#include "common/error.hpp"
#include "folder.hpp"
#include "run/flow.hpp"
#include "run/run.hpp"
#include "scene/world.hpp"

using namespace chute;
using namespace chute::test;
using measure::Verdict;

namespace flow_tests {

namespace {

/// The flow of a run of scenes/ball-2d.toml with changes.
measure::Flow ball(std::vector<std::string> settings) {
  const Folder folder;
  run::RunOptions options;
  options.directory = folder / "run";
  settings.push_back("output.impacts=");
  run::run_scene(scene::read_scene(CHUTE_SOURCE_DIR "/scenes/ball-2d.toml", settings), options);
  return run::read_flow(folder / "run");
}

}  // namespace

// Thesis 4.2: R = 2.25 r, e_n = 0.7: the steady range ends between sin θ = 0.1 and 0.13.
TEST_CASE("a ball on a line of balls stops, runs steadily or accelerates, by the slope") {
  const auto flat = ball({"incline.sin=0.005", "run.duration=8"});
  CHECK(flat.verdict == Verdict::stopped);
  CHECK(std::abs(flat.v_x.mean) < 0.01);

  const auto steady = ball({"incline.sin=0.08", "run.duration=15"});
  CHECK(steady.verdict == Verdict::steady);
  CHECK(steady.from < 5);
  REQUIRE(steady.v_x.error);
  CHECK(*steady.v_x.error < 0.01);
  CHECK(steady.v_x.mean == Approx(0.16).margin(0.01));
  // it rolls nearly without slip (thesis fig. 4.15): ω R = v
  CHECK(steady.omega.mean * 0.01125 == Approx(steady.v_x.mean).epsilon(0.1));

  const auto steep = ball({"incline.sin=0.25", "run.duration=15"});
  CHECK(steep.verdict == Verdict::accelerating);
  CHECK(steep.v_x.mean > 5);
}

TEST_CASE("discs on a slope stop or flow, and averages may begin where the flow settled") {
  const Folder folder;
  const auto go = [&](const char* name, std::vector<std::string> settings) {
    settings.insert(settings.begin(), {"grains.count=60", "bed.count=12", "contact.normal.stiffness=1e5",
                                       "contact.tangential.viscosity=150",
                                       "output.frames=", "output.impacts=", "output.contacts=false",
                                       "output.series={every=0.5}"});
    run::RunOptions options;
    options.directory = folder / name;
    run::run_scene(scene::read_scene(CHUTE_SOURCE_DIR "/scenes/demo.toml", settings), options);
    return run::read_flow(folder / name);
  };
  CHECK(go("flat", {"incline.angle=5 deg", "run.duration=60"}).verdict == Verdict::stopped);

  const auto all = "output.profiles={from=\"steady\", every=0.1}";
  const auto flow = go("flow", {"incline.angle=19 deg", "run.duration=160", all});
  INFO("from " << flow.from << ", v_x " << flow.v_x.mean);
  REQUIRE(flow.verdict == Verdict::steady);
  // the averages that begin at that time, asked for as a time: blocks are cut otherwise, the sums are the
  // same
  go("again", {"incline.angle=19 deg", "run.duration=160",
               "output.profiles={from=" + std::to_string(flow.from) + ", every=0.1}"});
  const auto column = [&](const char* name, const char* wanted) {
    std::istringstream in(content(folder / name / "profiles.csv"));
    std::vector<double> values;
    std::size_t at = 0;
    for (std::string line; std::getline(in, line);) {
      if (line.starts_with("#")) continue;
      std::vector<std::string> cells;
      std::istringstream row(line);
      for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
      if (cells[0] == "h")
        at = static_cast<std::size_t>(std::find(cells.begin(), cells.end(), wanted) - cells.begin());
      else
        values.push_back(cells.size() > at && !cells[at].empty() ? std::stod(cells[at]) : 0);
    }
    return values;
  };
  // A steady flow is carried: the stress at the bed is the weight on it, and everywhere the shear stress over
  // the pressure is tan θ.
  double weight = 0;
  const auto shear = column("flow", "contact_xy"), shear_moved = column("flow", "kinetic_xy");
  const auto load = column("flow", "contact_yy"), load_moved = column("flow", "kinetic_yy");
  {
    const auto scene = scene::read_scene(folder / "flow" / "scene.toml");
    const auto start = scene::make_world<2>(scene);
    for (std::size_t i = 0; i < start.grains.moving; ++i) weight += start.grains.mass[i];
    weight *= std::cos(scene.incline.theta()) / start.domain.length[0];
  }
  CHECK(load[0] + load_moved[0] == Approx(weight).epsilon(0.1));
  for (const std::size_t b : {0u, 1u, 2u})
    CHECK(-(shear[b] + shear_moved[b]) / (load[b] + load_moved[b]) ==
          Approx(std::tan(19 * 3.14159265 / 180)).epsilon(0.15));

  const auto eta = column("flow", "eta"), same = column("again", "eta");
  REQUIRE(eta.size() >= same.size());
  for (std::size_t b = 0; b < same.size(); ++b) CHECK(eta[b] == Approx(same[b]).epsilon(0.01).margin(1e-3));
}

TEST_CASE("a run without a flow to tell of is refused") {
  const Folder folder;
  write(folder / "run.json", "{\"end\": \"running\"}");
  CHECK(message<InputError>([&] { run::read_flow(folder / "."); }).find("run.json: does not tell") !=
        std::string::npos);
  CHECK_FALSE(message<InputError>([&] { run::read_flow(folder / "nowhere"); }).empty());
}

}  // namespace flow_tests
