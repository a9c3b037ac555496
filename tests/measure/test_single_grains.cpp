// What observers of single grains write: mean heights, rates of trapping, and angles at which grains at rest begin to move.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "measure/ball_outputs.hpp"
#include "measure/outputs.hpp"

namespace single_grains_tests {
using namespace chute;
using namespace chute::measure;

namespace {

/// An engine that does nothing but show grains where the test puts them.
class Shown final : public Engine {
 public:
  std::vector<double> x, y, z;
  std::vector<int> wraps;
  explicit Shown(std::size_t n) : x(n), y(n), z(n), wraps(n) {}
  std::int64_t step() const override { return step_; }
  double time_step() const override { return 0.01; }
  GrainsView grains() const override {
    GrainsView view;
    view.dimensions = 3, view.time = time(), view.moving = x.size();
    view.position = {x, y, z};
    view.wraps = {wraps, wraps, wraps};
    return view;
  }
  EnergyAccount energy() const override { return {}; }
  std::vector<Contact> contacts() const override { return {}; }
  void save(std::ostream&) const override {}
  void restore(std::istream&) override {}

 private:
  std::int64_t step_ = 0;
  void advance(std::int64_t step) override { step_ = step; }
};

/// Runs an output's observer over what `place(engine, t)` shows, and gives back its file without comments.
template <class MakeOutput, class Place>
std::string file_of(const MakeOutput& output, const RunContext& given, std::size_t grains,
                    const std::string& name, const Place& place) {
  RunContext run = given;
  const auto directory = std::filesystem::temp_directory_path() / ("chute-single-grains-" + name);
  std::filesystem::create_directories(directory);
  run.files = std::make_shared<io::RunFiles>(directory);
  const auto observers = output.make(run);
  Shown engine(grains);
  const auto steps = static_cast<std::int64_t>(run.duration / 0.01 + 0.5);
  for (std::int64_t s = 0; s <= steps; s = observers[0]->next_after(s)) {
    engine.advance_to(s);
    place(engine, engine.time());
    observers[0]->look({engine, {}, {}});
  }
  observers[0]->write({});
  run.files->commit();
  std::ifstream in(directory / name);
  std::string text, line;
  while (std::getline(in, line))
    if (!line.starts_with("#")) text += line + "\n";
  std::filesystem::remove_all(directory);
  return text;
}

RunContext context(double duration) {
  RunContext run;
  run.frame.dimensions = 3, run.frame.bead_spacing = 1e-3;
  run.gravity = 9.81, run.time_step = 0.01, run.duration = duration;
  return run;
}
std::vector<double> row_of(const std::string& text, std::size_t row) {
  std::istringstream lines(text);
  std::string line, cell;
  for (std::size_t k = 0; k <= row + 1; ++k) std::getline(lines, line);
  std::vector<double> cells;
  std::istringstream in(line);
  while (std::getline(in, cell, ',')) cells.push_back(cell.empty() ? NAN : std::stod(cell));
  return cells;
}

}  // namespace

TEST_CASE("mean heights are those of each grain, with errors of their scatter") {
  HeightsOutput output;
  output.spec = HeightSpec{1, 0.01};
  const auto text = file_of(output, context(11), 2, "heights.csv", [](Shown& engine, double t) {
    engine.z[0] = t < 1 ? 100 : 2;
    engine.z[1] = 0.5 + 0.1 * std::floor(t);
  });
  CHECK(row_of(text, 0)[1] == Approx(2));
  CHECK(row_of(text, 0)[2] == Approx(0).margin(1e-12));
  CHECK(row_of(text, 1)[1] == Approx(0.5 + 0.1 * 5.5).epsilon(0.01));
  CHECK(row_of(text, 1)[2] == Approx(0.1 * std::sqrt(82.5 / 9 / 10)).epsilon(0.05));
}

TEST_CASE("the rate of trapping counts those that got going, with the way of all of them") {
  // Grain 0 runs on, grain 1 stops after 0.3 m, grain 2 never got going.
  TrappingOutput output;
  output.spec = TrappingSpec{0.02, 1};
  const auto text = file_of(output, context(10), 3, "trapping_rate.csv", [](Shown& engine, double t) {
    engine.x[0] = 0.05 * t, engine.x[1] = 0.05 * std::min(t, 6.0), engine.x[2] = 0.05 * std::min(t, 0.3);
  });
  const auto row = row_of(text, 0);
  CHECK(row[0] == 2);
  CHECK(row[1] == 1);
  CHECK(row[2] == Approx(0.45 + 0.25).margin(3e-3));
  CHECK(row[3] == Approx(1 / 0.7).epsilon(0.01));
  CHECK(row[4] == Approx(row[3]));
}

TEST_CASE("a grain starts at the angle at which it leaves the place where it rested") {
  StartingOutput output;
  output.spec = StartingSpec{0.01};
  auto run = context(10);
  constexpr double degree = 3.14159265358979 / 180;
  run.tilt = Tilt{0, 30 * degree, 3 * degree, 9.81};
  const auto text = file_of(output, run, 3, "starting.csv", [](Shown& engine, double t) {
    engine.x[0] = t < 4 ? 1e-4 * std::sin(t) : 0.1 * (t - 4);  // rests, then rolls
    engine.x[1] = 0.05 * t;                                    // never rests
    engine.x[2] = 0;                                           // never moves
  });
  CHECK(row_of(text, 0)[2] == 1);
  CHECK(row_of(text, 0)[4] == Approx(12).margin(0.1));
  CHECK(row_of(text, 1)[1] == 0);
  CHECK(row_of(text, 1)[2] == 0);
  CHECK(row_of(text, 2)[1] == 1);
  CHECK(row_of(text, 2)[2] == 0);
}

}  // namespace single_grains_tests
