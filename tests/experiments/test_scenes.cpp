#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "../runs/folder.hpp"
#include "common/atomic_file.hpp"
#include "common/column_texts.hpp"
#include "common/error.hpp"
#include "experiments/perform.hpp"
#include "experiments/recipe.hpp"
#include "read/table.hpp"

using namespace chute;
using namespace chute::test;
using namespace chute::experiments;

namespace scenes_tests {

namespace {

const std::vector<std::string> names{"impact-normal", "impact-oblique", "column", "brake-failure",
                                     "pushed-cylinder"};

fs::path file_of(const std::string& name) { return fs::path(CHUTE_SOURCE_DIR) / "scenes" / (name + ".toml"); }

Outcome result(const std::string& name, const std::vector<std::string>& settings) {
  return perform(read_experiment(file_of(name), settings));
}

std::string refused(const std::string& name, const std::vector<std::string>& settings) {
  return message<InputError>([&] { read_experiment(file_of(name), settings); });
}

const std::string hertz_linear =
    "contact.normal={law='hertz-linear-damping', stiffness=9e7, damping=0.35, at_velocity=1}";
const std::string kuwabara_kono =
    "contact.normal={law='hertz-kuwabara-kono', stiffness=9e7, damping=190, at_velocity=1}";

}  // namespace

TEST_CASE("Every experiment runs, and what it wrote runs again to the same bytes") {
  for (const auto& name : names) {
    INFO(name);
    Folder folder;
    REQUIRE(is_experiment(file_of(name)));
    const auto experiment = read_experiment(file_of(name));
    CHECK(!facts(experiment).empty());
    run::RunOptions options;
    options.directory = folder / "once";
    run_experiment(experiment, options);
    const auto again = read_experiment(folder / "once/scene.toml");
    CHECK(to_toml(again) == to_toml(experiment));
    options.directory = folder / "again";
    run_experiment(again, options);
    const auto first = results(folder / "once");
    CHECK(first == results(folder / "again"));
    CHECK(first.count("series.csv") + first.count("result.csv") + first.count("scene.toml") == 3);
    CHECK(first.count("frames.pvd") == (name == "brake-failure" ? 1 : 0));
    CHECK(first.at("series.csv").size() > 2000);
    for (const char* file : {"series.csv", "result.csv"}) {
      const auto text = read_file(folder / "once" / file);
      const auto table = read::parse_table(text, file);
      const auto* meanings = find_table_text(file, table.header);
      REQUIRE(meanings);
      for (const auto& column : table.header) {
        CAPTURE(file, column);
        CHECK(column_text(*meanings, column));
        const bool spin = column.starts_with("omega_");
        if (!column.ends_with("_err"))
          CHECK(text.find("\n# column " + (spin ? "omega_*" : column)) != std::string::npos);
      }
    }
    const auto outcome = read::read_table(folder / "once/result.csv");
    for (const auto& result : outcome.text("name"))  // each says what it is
      CHECK(
          std::ranges::any_of(outcome.comments, [&](const auto& c) { return c.starts_with(result + ": "); }));
    options.directory = folder / "once";
    CHECK_THROWS_AS(run_experiment(again, options), InputError);  // a run is there
  }
  CHECK_FALSE(is_experiment(file_of("demo")));
}

TEST_CASE("Results do not depend on how often the series is written") {
  Folder folder;
  std::vector<std::string> results;
  for (const char* every : {"output.series.every=1e-4", "output.series.every=0.02"}) {
    run::RunOptions options;
    options.directory = folder / std::to_string(results.size());
    run_experiment(read_experiment(file_of("pushed-cylinder"), {every}), options);
    results.push_back(read_file(options.directory / "result.csv"));
  }
  CHECK(results[0] == results[1]);
  CHECK(results[0].find(",,\n") == std::string::npos);  // each has a value and an error
}

TEST_CASE("A normal impact has the restitution of its law, whatever the law") {
  const std::string fine = "experiment.steps_per_contact=5000";
  double worst = 0;
  for (const auto& law : {std::string("contact.attraction=true"), hertz_linear, kuwabara_kono,
                          std::string("contact.normal={law='walton-braun', stiffness=7.32e6, hardening=2e5, "
                                      "at_velocity=1}")})
    for (const double v : {0.01, 1.0, 100.0}) {
      const auto outcome = result("impact-normal", {fine, law, fmt::format("experiment.velocity={}", v)});
      worst = std::max(worst, std::abs(outcome["e_n"] - outcome["e_n law"]));
    }
  WARN("largest difference of e_n from the law's: " << worst);
  CHECK(worst < 1e-4);
}

TEST_CASE("1 - e_n goes as v^0, v^(-1/5), v^(1/5) in the elastic limit, and ever closer to it") {
  const auto exponent = [](const std::string& law, double v) {
    return result("impact-normal", {law, fmt::format("experiment.velocity={}", v),
                                    "experiment.steps_per_contact=100"})["exponent"];
  };
  CHECK(exponent("contact.attraction=true", 1) == Approx(0).margin(1e-9));
  double off_linear = 1, off_kono = 1;
  for (const double part : {1.0, 1e-2, 1e-4, 1e-6}) {  // elastic: fast with (3.5), slow with (3.6)
    const double linear = std::abs(exponent(hertz_linear, 100 / part) + 0.2);
    const double kono = std::abs(exponent(kuwabara_kono, 0.01 * part) - 0.2);
    WARN("off -1/5 by " << linear << ", off 1/5 by " << kono);
    CHECK(linear < off_linear);
    CHECK(kono < off_kono);
    off_linear = linear, off_kono = kono;
  }
  CHECK(off_linear < 2e-3);
  CHECK(off_kono < 2e-3);
}

TEST_CASE("An oblique impact keeps momentum and counts its energy, with spins, sizes and a wall") {
  const auto outcome = result(
      "impact-oblique",
      {"experiment.i.spin=3", "experiment.j={radius=2e-3, mass=5e-5, spin=-7}", "experiment.velocity=1"});
  const double m_i = 1.48e-4, m_j = 5e-5, part = std::sqrt(0.125);
  CHECK(m_i * outcome["v_x i"] + m_j * outcome["v_x j"] == Approx((m_i - m_j) * part));
  CHECK(m_i * outcome["v_y i"] + m_j * outcome["v_y j"] == Approx((m_i - m_j) * part));
  CHECK(outcome["e"] * outcome["e"] + outcome["normal_loss"] + outcome["shear_loss"] ==
        Approx(1).epsilon(2e-3));
  // v_s = tan ϑ v_n and R ω of each, with s = −y: ω > 0 at i, on the left, drags its surface along +y
  CHECK(outcome["psi_i"] == Approx((std::sqrt(0.5) + 3e-3 * 3 - 2e-3 * 7) / std::sqrt(0.5)).epsilon(1e-9));
  const auto wall = result("impact-oblique", {"experiment.j={radius=2e-3, mass=5e-5, fixed=true}"});
  CHECK(wall["v_x j"] == 0);
  CHECK(wall["v_x i"] == Approx(-wall["e_n"] * 0.01 * std::sqrt(0.5)).epsilon(1e-3));
  // the same angle, said in three ways
  for (const char* angle : {"experiment.angle=45 deg", "experiment.sin=0.7071067811865476"})
    CHECK(result("impact-oblique", {"experiment.psi=", angle})["psi_f"] ==
          Approx(result("impact-oblique", {})["psi_f"]).epsilon(1e-6));
}

TEST_CASE("A ball that skims a wall is reflected as from one grain while it is slow; brakes fail when fast") {
  const auto kick = [](double v) {
    return result("brake-failure", {fmt::format("experiment.velocity={}", v)})["kick"] / v;
  };
  const auto one =
      result("impact-oblique", {"experiment.psi=", "experiment.sin=0.97", "experiment.velocity=0.01",
                                "contact.normal.stiffness=7.32e4", "contact.normal.damping=0.206",
                                "contact.tangential={law='coulomb', friction=0.25}",
                                "experiment.j={radius=3e-3, mass=1.48e-4, fixed=true}"});
  // from (n, across) to along the wall and away from it: n points down and on
  const double c = std::sqrt(1 - 0.97 * 0.97), s = 0.97;
  const double expected = (-s * one["v_x i"] + c * one["v_y i"]) / 0.01;
  WARN("kick over velocity: slow " << kick(0.01) << ", one hard grain " << expected << ", at 40 m/s "
                                   << kick(40) << ", at 200 m/s " << kick(200));
  CHECK(kick(0.01) == Approx(expected).epsilon(2e-3));
  CHECK(kick(40) < 0.25 * expected);
  CHECK(kick(200) < 0.05 * expected);
  CHECK(result("brake-failure", {"experiment.velocity=200"})["touched"] > 1);
  CHECK(result("brake-failure", {"experiment.velocity=0.01"})["touched"] == 1);
}

TEST_CASE("The pushed cylinder knows every law with friction, and finds the steady forces") {
  for (const char* law : {"contact.tangential={law='coulomb-viscous', friction=0.25, viscosity=1000}",
                          "contact.tangential={law='cundall-strack', friction=0.25, stiffness=2e7}",
                          "contact.tangential={law='walton-braun-mindlin', friction=0.25, stiffness=2e7}"}) {
    const auto outcome = result("pushed-cylinder", {law});
    INFO(law);
    CHECK(outcome["F_s^p 1"] == Approx(1.0 / 3).epsilon(1e-4));
    CHECK(outcome["F_s^b 2"] == Approx(0.1).epsilon(1e-4));
    CHECK(outcome["F_s^p 2"] == Approx(2.0 / 15).epsilon(3e-3));
  }
  const auto mindlin =
      result("pushed-cylinder",
             {"contact.normal={law='hertz-kuwabara-kono', stiffness=1e9, restitution=0.2, at_velocity=0.01}",
              "contact.tangential={law='mindlin', friction=0.25, stiffness=7e8}"});
  CHECK(mindlin["F_s^p 1"] == Approx(1.0 / 3).epsilon(0.02));
}

TEST_CASE("Slips in an experiment are answered with the key") {
  CHECK_THAT(refused("impact-oblique", {"experiment.sin=0.5"}),
             Catch::Contains("experiment.kind: needs one of psi"));
  CHECK_THAT(refused("impact-oblique", {"experiment.psi=", "experiment.angle=95 deg"}),
             Catch::Contains("experiment.angle: \"95 deg\" is not allowed"));
  CHECK_THAT(refused("impact-oblique", {"experiment.velocty=2"}),
             Catch::Contains("experiment.velocty: unknown key, did you mean velocity?"));
  CHECK_THAT(refused("impact-normal", {"experiment.i.density=1000"}),
             Catch::Contains("either mass or density"));
  CHECK_THAT(refused("impact-normal", {"experiment.i.fixed=true"}), Catch::Contains("only j can be fixed"));
  CHECK_THAT(refused("impact-normal", {"experiment.psi=1"}), Catch::Contains("experiment.psi: unknown key"));
  CHECK_THAT(refused("column", {"contact.normal.restitution="}), Catch::Contains("restitution or damping"));
  CHECK_THAT(refused("pushed-cylinder", {"experiment.duration=[0.1]"}),
             Catch::Contains("as many numbers as push"));
  CHECK_THAT(refused("pushed-cylinder", {"contact.tangential={law='viscous', viscosity=1}"}),
             Catch::Contains("law with friction"));
  CHECK_THAT(
      refused("pushed-cylinder", {"contact.normal={law='walton-braun', stiffness=1e6, restitution=0.5}"}),
      Catch::Contains("without a memory"));
  CHECK_THAT(message<InputError>([] { result("impact-normal", {})["e_m"]; }),
             Catch::Contains("did you mean \"e_n\"?"));
}

TEST_CASE("compare-laws draws two laws in each panel") {
  const auto file = file_of("compare-laws");
  const auto table = parse_toml(read_file(file), file.string());
  TomlReader reader(*table["data"].as_table(), file.string(), "data");
  std::vector<ExperimentRecipe> recipes;
  reader.sections("experiment", recipes);
  const auto rows = make_table(recipes, file, {true, 1}).rows;
  std::map<std::string, std::map<std::string, int>> seen;
  for (const auto& row : rows) ++seen[row.panel][row.series];
  CHECK(seen.size() == 2);
  for (const auto& [panel, series] : seen) CHECK(series.size() == 2);
  recipes[0].quantity = "psi";
  CHECK_THAT(message<InputError>([&] {
               make_table(recipes, file, {true, 1});
             }),
             Catch::Contains("did you mean \"psi_i\"?") || Catch::Contains("did you mean \"psi_f\"?"));
}

}  // namespace scenes_tests
