// A new bed, method or observer is one file and one line in a list. These toys prove it: nothing else in the tree knows
// them, and a scene that names them is read, checked, run, written back and observed.
#include <catch2/catch.hpp>
#include <sstream>

#include "../runs/folder.hpp"
#include "common/error.hpp"
#include "engines/kind/method.hpp"
#include "measure/observer.hpp"
#include "run/run.hpp"
#include "scene/world.hpp"

using namespace chute;

namespace {

// ---- a bed ------------------------------------------------------------------------------------------------------------
/// A row whose beads alternate between two heights.
class Stairs final : public Described<beds::Bed, Stairs> {
 public:
  static constexpr std::string_view word = "stairs", text = "beads that alternate between two heights";
  std::int64_t count = 10;
  double step = 0.2;
  template <class Archive>
  void describe(Archive& a) {
    describe_diameter(a);
    a.required("count", count, between(4, 1000), "beads");
    a.value("step", step, "height of every other bead");
  }
  beds::Ground lay(const beds::Site&) const override {
    beds::Ground ground;
    for (std::int64_t i = 0; i < count; ++i)
      ground.beads.push_back({(static_cast<double>(i) + 0.5) * diameter, 0, i % 2 ? step : 0, diameter / 2});
    ground.length = static_cast<double>(count) * diameter;
    ground.spacing = ground.widest_spacing = diameter;
    return ground;
  }
};
const bool bed_is_listed = (beds::list().push_back(kind_of<beds::Bed, Stairs>()), true);

// ---- a method ---------------------------------------------------------------------------------------------------------
/// Grains that go on for ever with the velocity of the start, whatever is in their way.
template <int D>
class Drift final : public Engine {
 public:
  Drift(World<D> world, double step) : world_(std::move(world)), dt_(step) {
    for (auto& f : force_) f.assign(world_.grains.size(), 0);
  }
  std::int64_t step() const override { return step_; }
  double time_step() const override { return dt_; }
  GrainsView grains() const override { return view_of(world_.grains, force_, world_.domain, time()); }
  EnergyAccount energy() const override { return {}; }
  std::vector<Contact> contacts() const override { return {}; }
  std::vector<std::pair<std::string, double>> tells() const override {
    return {{"drifted", dt_ * static_cast<double>(step_)}};
  }
  void save(std::ostream& out) const override {
    StateOutput archive(out);
    archive(step_, world_.grains);
  }
  void restore(std::istream& in) override {
    StateInput archive(in);
    archive(step_, world_.grains);
  }

 private:
  void advance(std::int64_t step) override {
    for (; step_ < step; ++step_)
      for (std::size_t i = 0; i < world_.grains.moving; ++i)
        for (int k = 0; k < D; ++k) world_.grains.position[k][i] += dt_ * world_.grains.velocity[k][i];
  }
  World<D> world_;
  double dt_;
  std::int64_t step_ = 0;
  std::array<Array, D> force_;
};
class DriftMethod final : public Described<engines::Method, DriftMethod> {
 public:
  static constexpr std::string_view word = "drift", text = "grains that nothing stops";
  double time_step = 0.1;
  template <class Archive>
  void describe(Archive& a) {
    a.value("time_step", time_step, positive, "time between instants");
  }
  Offers offers() const override { return {.independent = true}; }
  std::optional<Refusal> refusal(const engines::Setting& s) const override {
    if (s.grains < 100) return {};
    return Refusal{"grains.count", "drift moves fewer than 100 grains"};
  }
  double step(const engines::Setting&) const override { return time_step; }
  std::vector<Fact> facts(const engines::Setting&) const override { return {{"drift", 1, "", "it drifts"}}; }
  std::unique_ptr<Engine> make(World<2> w, const engines::Setting&, int) const override {
    return std::make_unique<Drift<2>>(std::move(w), time_step);
  }
  std::unique_ptr<Engine> make(World<3> w, const engines::Setting&, int) const override {
    return std::make_unique<Drift<3>>(std::move(w), time_step);
  }
};
const bool method_is_listed = (engines::list().push_back(kind_of<engines::Method, DriftMethod>()), true);

// ---- an observer ------------------------------------------------------------------------------------------------------
/// The highest grain, now and then.
class Summit final : public measure::Remembering<Summit> {
 public:
  Summit(const measure::RunContext& run, double every) : run_(run), due_(run.schedule(0, every)) {}
  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }
  void look(const measure::Look& look) override {
    if (due_.index_at(look.engine.step()) < 0) return;
    const auto grains = look.engine.grains();
    const auto& height = grains.position[run_.frame.normal()];
    highest_.push_back(
        *std::max_element(height.begin(), height.begin() + static_cast<std::ptrdiff_t>(grains.moving)));
  }
  void write(const measure::Flow&) const override {
    io::Csv csv(run_.comments("the highest grain"), {"height"});
    for (const double h : highest_) csv.row({h});
    run_.write("summit.csv", csv.text());
  }
  template <class Archive>
  void serialize(Archive& a) {
    a(highest_);
  }

 private:
  const measure::RunContext& run_;
  measure::Schedule due_;
  std::vector<double> highest_;
};
struct SummitSpec {
  double every = 0;
};
template <class Archive>
void describe(Archive& a, SummitSpec& spec) {
  a.required("every", spec.every, positive, "time from one look to the next");
}
class SummitOutput final : public measure::TableOutput<SummitOutput, SummitSpec> {
 public:
  static constexpr std::string_view word = "summit", text = "height of the highest grain";
  std::vector<std::string> files() const override { return {"summit.csv"}; }
  std::vector<std::unique_ptr<measure::Observer>> make(const measure::RunContext& run) const override {
    std::vector<std::unique_ptr<measure::Observer>> observers;
    observers.push_back(std::make_unique<Summit>(run, spec->every));
    return observers;
  }
};
const bool observer_is_listed = (measure::list().push_back(kind_of<measure::Output, SummitOutput>()), true);

// ---- a scene that names all three ---------------------------------------------------------------------------------------
std::string scene_text(int dimensions = 2) {
  return "dimensions = " + std::to_string(dimensions) + R"(
[incline]
angle = "10 deg"
[domain]
size = [10, 10]
[bed]
kind = "stairs"
count = 10
[grains]
count = 4
diameter = { mean = 1 }
start = { lattice = "square", velocity = 1 }
[contact.normal]
stiffness = 1e5
restitution = 0.5
[contact.tangential]
law = "frictionless"
[engine]
method = "drift"
[run]
duration = 2
[output]
summit = { every = 0.5 }
)";
}
std::string refused(const std::vector<std::string>& settings) {
  try {
    scene::parse_scene(scene_text(), "toy.toml", settings);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE(
    "a toy bed, method and observer are read, written back, run and observed, in the plane and in space") {
  REQUIRE((bed_is_listed && method_is_listed && observer_is_listed));
  for (const int dimensions : {2, 3}) {
    const test::Folder folder;
    const auto scene = scene::parse_scene(scene_text(dimensions), "toy.toml");
    const auto text = scene::to_toml(scene);
    CHECK_THAT(text, Catch::Contains("kind = 'stairs'") && Catch::Contains("method = 'drift'") &&
                         Catch::Contains("[output.summit]"));
    CHECK(scene::to_toml(scene::parse_scene(text, "again.toml")) == text);
    run::RunOptions options;
    options.directory = folder / "run";
    CHECK(run::run_scene(scene, options).steps == 20);
    CHECK_THAT(test::content(folder / "run" / "summit.csv"), Catch::Contains("height\n"));
    CHECK_THAT(test::content(folder / "run" / "series.csv"), Catch::Contains(",drifted\n"));
    // and its file goes with the run that is replaced
    options.existing = run::Existing::replace;
    CHECK(run::run_scene(scene, options).finished);
  }
}

TEST_CASE("what a toy method cannot do is refused in one line, at the key that asks for it") {
  CHECK(refused({"grains.count=100"}) ==
        "--set grains.count: grains.count: drift moves fewer than 100 grains");
  CHECK_THAT(refused({"output.profiles={from=0}"}),
             Catch::EndsWith("output.profiles: engine.method = \"drift\" tells of no contacts"));
  CHECK_THAT(refused({"output.impacts={from=0}"}),
             Catch::EndsWith("output.impacts: engine.method = \"drift\" tells of no impacts"));
  CHECK_THAT(refused({"bed={kind=\"flat\",length=10}"}),
             Catch::EndsWith("engine.method = \"drift\" knows no walls"));
  CHECK_THAT(refused({"bed.stepp=1"}), Catch::EndsWith("bed.stepp: unknown key, did you mean step?"));
}

TEST_CASE("the table of keys tells of the toys, too") {
  const auto table = scene::keys_table();
  for (const char* part :
       {"kind = \"stairs\": beads that alternate", "| `step` | height of every other bead | 0.2 |",
        "method = \"drift\": grains that nothing stops", "summit: height of the highest grain"})
    CHECK_THAT(table, Catch::Contains(part));
}
