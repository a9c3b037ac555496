#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "figures/extract.hpp"
#include "figures/extract_flow.hpp"

namespace extract_flow_tests {
using namespace chute::figures;
namespace fs = std::filesystem;

namespace {

struct RunFolder {
  fs::path path;
  explicit RunFolder(const std::string& name) : path(fs::temp_directory_path() / ("chute_state_" + name)) {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~RunFolder() { fs::remove_all(path); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path / name) << text; }
};

/// Ten full layers and one that is a quarter full; μ = 0.4, v_x = 0.3 h, P falls with height, so that I grows.
std::string layers(const char* normal, const char* shear) {
  std::string text = std::string("h,eta_exact,v_x,half_shear,kinetic_") + shear + ",kinetic_" + normal +
                     ",contact_" + shear + ",contact_" + normal + "\n";
  for (int k = 0; k < 11; ++k) {
    const double h = k + 0.5, P = 4 * (10 - std::min(k, 9));
    text += std::to_string(h) + "," + (k < 10 ? "0.6" : "0.15") + "," + std::to_string(0.3 * h) + ",0.15," +
            std::to_string(-0.1 * P) + "," + std::to_string(0.25 * P) + "," + std::to_string(-0.3 * P) + "," +
            std::to_string(0.75 * P) + "\n";
  }
  return text;
}
constexpr const char* scene = R"(
[incline]
angle = '30 deg'
[grains]
count = 40
density = 2.0
[grains.diameter]
mean = 0.5
[[wall]]
from = [0.0, 1.0]
to = [2.0, 0.0]
[[wall]]
from = [6.5, 0.0]
to = [9.0, 1.0]
)";

}  // namespace

TEST_CASE("numbers that a dense flow is known by come back from tables that are made of them") {
  const RunFolder run("space"), plane("plane");
  run.write("profiles.csv", layers("zz", "xz"));
  run.write("scene.toml", scene);
  plane.write("profiles.csv", layers("yy", "xy"));
  plane.write("scene.toml", scene);
  Curve curve;
  curve.bulk = {0.2, 0.8};
  CHECK(number_of_run("phi", curve, run.path) == Approx(0.6));
  CHECK(number_of_run("mu", curve, run.path) == Approx(0.4));
  CHECK(number_of_run("shear_rate", curve, run.path) == Approx(0.3));
  // Half of 0.6 is reached two thirds of the way from the tenth to the eleventh layer.
  CHECK(number_of_run("height", curve, run.path) == Approx(9.5 + 2.0 / 3));
  CHECK(number_of_run("surface_speed", curve, run.path) == Approx(0.3 * 9.5));
  CHECK(number_of_run("tan_theta", curve, run.path) == Approx(1 / std::sqrt(3)));
  CHECK(number_of_run("grains.count", curve, run.path) == 40);
  CHECK(number_of_run("wall[1].from[0] - wall[0].to[0]", curve, run.path) == Approx(4.5));
  CHECK_THROWS_WITH(number_of_run("grains.number", curve, run.path), Catch::Contains("grains.number"));
  // I of one layer: γ̇ d √(ρ_s/P); in the plane γ̇ √(m/P). A window that holds the layer at 4.5 alone, where P = 4·6.
  curve.bulk = {4.4 / (9.5 + 2.0 / 3), 4.6 / (9.5 + 2.0 / 3)};
  CHECK(number_of_run("inertial_number", curve, run.path) == Approx(0.3 * 0.5 * std::sqrt(2.0 / 24)));
  const double mass = 2.0 * M_PI / 6 * 0.125;
  CHECK(number_of_run("inertial_number", curve, plane.path) == Approx(0.3 * std::sqrt(mass / 24)));
}

TEST_CASE("rates in time are slopes, of outflow between a fifth and four fifths of what ran out") {
  const RunFolder run("rates");
  std::string out = "time,out,out_mass\n", series = "time,x,v_x\n";
  // It begins late, runs steadily with 5 a unit of time from 100 to 900, and slowly ends at 1000.
  for (int t = 0; t <= 400; ++t) {
    const double n = t < 50 ? 2 * t : t < 210 ? 100 + 5 * (t - 50) : std::min(1000.0, 900 + 1.0 * (t - 210));
    out += std::to_string(t) + "," + std::to_string(n) + ",0\n";
    series += std::to_string(t) + ",0," + std::to_string(3 - 0.02 * t) + "\n";
  }
  run.write("discharge.csv", out);
  run.write("series.csv", series);
  run.write("run.json",
            R"({"seconds": 6, "duration": 4, "tilting": {"start_angle": 25, "stop_angle": null}})");
  const Curve curve;
  CHECK(number_of_run("discharge", curve, run.path) == Approx(5));
  CHECK(number_of_run("acceleration", curve, run.path) == Approx(-0.02));
  CHECK(number_of_run("speed", curve, run.path) == Approx(3 - 0.02 * 300));
  CHECK(number_of_run("seconds", curve, run.path) == Approx(1.5));
  CHECK(number_of_run("start_angle", curve, run.path) == 25);
  CHECK(std::isnan(number_of_run("stop_angle", curve, run.path)));
}

TEST_CASE(
    "a state is a point with the errors over runs, none where nothing scatters; histories are a series a height") {
  const RunFolder a("a"), b("b"), c("c");
  const std::vector<fs::path> runs{a.path, b.path, c.path};
  double v = 1;
  for (const auto* run : {&a, &b, &c}) {
    run->write("series.csv", "time,v_x\n0," + std::to_string(v) + "\n1," + std::to_string(v) + "\n");
    run->write("scene.toml", scene);
    run->write("history.csv", "time,h,grains,v_x,sigma_x\n0,0.5,3," + std::to_string(v) +
                                  ",0\n1,0.5,3,7,0\n1,1.5,1," + std::to_string(2 * v) + ",0\n2,1.5,0,,\n");
    v += 1;
  }
  Curve curve;
  curve.series = "s", curve.column = "speed", curve.against = "grains.count", curve.x_scale = 0.5;
  const auto point = state(curve, runs);
  REQUIRE(point.size() == 1);
  CHECK(point[0].x == 20);
  CHECK_FALSE(point[0].x_err);
  CHECK(point[0].y == Approx(2));
  CHECK(*point[0].y_err == Approx(1 / std::sqrt(3)));
  curve.column = "v_x";
  const auto map = history(curve, runs);
  REQUIRE(map.size() == 3);
  CHECK(map[0].series == "s h=0.5");
  CHECK(map[0].y == Approx(2));
  CHECK(map[1].y == Approx(7));
  CHECK(map[2].series == "s h=1.5");
  CHECK(map[2].x == 1);
  CHECK(map[2].y == Approx(4));
}

TEST_CASE(
    "an instant is the same at all heights, whichever run was the first there, so that maps have no empty columns") {
  const RunFolder a("first"), b("second");
  a.write("history.csv",
          "time,h,grains,v_x\n0,0.5,3,1\n27.000000000000004,0.5,3,1\n27.000000000000004,1.5,0,\n");
  b.write("history.csv", "time,h,grains,v_x\n0,0.5,3,3\n27,0.5,3,3\n27,1.5,1,5\n");
  Curve curve;
  curve.series = "s", curve.column = "v_x";
  const std::vector<fs::path> runs{a.path, b.path};
  const auto map = history(curve, runs);
  REQUIRE(map.size() == 3);
  CHECK(map[0].x == 0);
  CHECK(map[1].y == 2);
  CHECK(map[2].y == 5);
  CHECK(map[2].x == map[1].x);
}

TEST_CASE("an instant of several runs is one, whatever their steps make of its last digits") {
  const RunFolder a("step_a"), b("step_b"), c("step_c");
  a.write("series.csv", "time,v_x\n0,1\n2.9999999999999996,1\n4,1\n");
  b.write("series.csv", "time,v_x\n0,2\n3.0000000000000004,2\n4,2\n");
  c.write("series.csv", "time,v_x\n0,6\n3,6\n4.1,6\n");
  Curve curve;
  curve.extract = Extract::series, curve.column = "v_x";
  const std::vector<fs::path> runs{a.path, b.path, c.path};
  const auto rows = extract(curve, runs);
  REQUIRE(rows.size() == 4);
  CHECK(rows[1].x == Approx(3));
  CHECK(rows[1].y == Approx(3));
  CHECK(rows[2].y == Approx(1.5));
  CHECK(rows[3].y == 6);
}

TEST_CASE("rows of a table that a curve asks for: each run's mean at equal x counts once") {
  const RunFolder a("rows_a"), b("rows_b"), c("rows_c");
  a.write("history.csv", "time,h,grains,v_x\n1,0.5,3,100\n2,0.5,3,1\n3,0.5,3,3\n4,0.5,3,100\n");
  b.write("history.csv", "time,h,grains,v_x\n2,0.5,3,5\n2,1.5,3,9\n");
  c.write("history.csv", "time,h,grains,v_x\n2,0.5,3,8\n3,0.5,0.1,50\n");
  Curve curve;
  curve.extract = Extract::table, curve.file = "history.csv", curve.column = "v_x", curve.against = "h";
  curve.where = {{.column = "time", .low = 2, .high = 4}};
  const std::vector<fs::path> runs{a.path, b.path, c.path};
  const auto rows = extract(curve, runs);
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].y == Approx((2 + 5 + 8) / 3.0));
  CHECK(*rows[0].y_err == Approx(std::sqrt((9 + 0 + 9) / 2.0 / 3)));
  CHECK(rows[1].x == 1.5);
  CHECK(rows[1].y == 9);
}

}  // namespace extract_flow_tests
