#include "scene/scene.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/toml_reader.hpp"
#include "scene/angle.hpp"
#include "scene/contact.hpp"
#include "scene/start.hpp"

namespace chute::scene {
namespace {

using namespace std::string_view_literals;
constexpr std::array bed_words{"row"sv, "disordered-row"sv, "none"sv};
constexpr std::array lattice_words{"square"sv, "none"sv};
constexpr std::array method_words{"soft"sv, "event"sv, "stochastic"sv};
constexpr std::array impact_friction_words{"published"sv, "without-rotation"sv};
constexpr std::array integrator_words{"gear5"sv, "verlet"sv};

}  // namespace

// Outside the unnamed namespace: the archives find these by the type that they describe.

template <class Archive>
static void describe(Archive& a, Incline& incline) {
  a.value("angle", incline.angle);
  a.value("sin", incline.sine, between(-1, 1));
  a.value("gravity", incline.gravity, non_negative);
  if constexpr (Archive::reading) {
    a.check(incline.angle.has_value() != incline.sine.has_value(), incline.angle ? "sin" : "angle",
            "give either angle = \"18 deg\" or sin = 0.31");
    if (incline.angle) {
      const auto theta = parse_angle(*incline.angle);
      a.check(theta.has_value(), "angle",
              fmt::format("\"{}\" is not an angle, write \"18 deg\" or \"0.3 rad\"", *incline.angle));
      a.check(std::abs(*theta) <= std::numbers::pi / 2, "angle",
              fmt::format("\"{}\" is not allowed, must be between -90 deg and 90 deg", *incline.angle));
    }
  }
}

template <class Archive>
static void describe(Archive& a, Bed& bed) {
  a.choice("kind", bed.kind, bed_words);
  a.value("diameter", bed.diameter, positive);
  if (bed.kind == Bed::Kind::none) {
    a.required("length", bed.length, positive);
    return;
  }
  a.required("count", bed.count, between(3, 1e7));
  if (bed.kind == Bed::Kind::row) a.value("gap", bed.gap, between(0, 10));
  if (bed.kind == Bed::Kind::disordered_row) a.required("gap_max", bed.gap_max, between(0, 10));
}

template <class Archive>
static void describe(Archive& a, Diameter& diameter) {
  a.required("mean", diameter.mean, positive);
  a.value("std", diameter.std, non_negative);
  a.check(3 * diameter.std < diameter.mean, "std",
          "must be less than a third of the mean: sizes are cut off at three standard deviations");
}

template <class Archive>
static void describe(Archive& a, Start& start) {
  a.choice("lattice", start.lattice, lattice_words);
  if (start.lattice == Start::Lattice::square) a.value("spacing", start.spacing, positive);
  if (start.lattice == Start::Lattice::none) a.value("x", start.x);
  a.value("height", start.height);
  a.value("velocity", start.velocity);
  a.value("velocity_up", start.velocity_up);
  a.value("spread", start.spread, non_negative);
}

template <class Archive>
static void describe(Archive& a, GrainsSpec& grains) {
  a.required("count", grains.count, between(1, 1e7));
  a.section("diameter", grains.diameter);
  a.value("size_ratio", grains.size_ratio, positive);
  a.value("density", grains.density, positive);
  a.value("independent", grains.independent);
  a.value("rotation", grains.rotation);
  a.section("start", grains.start);
  if constexpr (Archive::reading) {
    a.check(grains.diameter.has_value() != grains.size_ratio.has_value(),
            grains.diameter ? "size_ratio" : "diameter",
            "give either diameter = { mean = …, std = … } or size_ratio = R/r");
    a.check(
        grains.count == 1 || grains.independent || grains.start.lattice == Start::Lattice::square, "start",
        "lattice = \"none\" starts a single grain, or independent ones; use lattice = \"square\" for more");
  }
}

template <class Archive>
static void describe(Archive& a, EngineSpec& engine) {
  using Method = EngineSpec::Method;
  a.choice("method", engine.method, method_words);
  const bool soft = engine.method == Method::soft;
  // What only the soft method uses is understood with all: a scene changes its method with one key.
  if (soft || Archive::reading) a.choice("integrator", engine.integrator, integrator_words);
  a.value("steps_per_contact", engine.steps_per_contact, at_least(5));
  a.value("time_step", engine.time_step, positive);
  if (soft || Archive::reading) a.value("deepest_overlap", engine.deepest_overlap, Range{0, 1, true, false});
  if (soft) return;
  a.value("restitution", engine.restitution, unit_interval);
  a.value("friction", engine.friction, non_negative);
  a.value("tangential_restitution", engine.tangential_restitution, between(-1, 1));
  if (engine.method == Method::event) {
    a.value("contact_time", engine.contact_time, non_negative);
    a.value("restitution_velocity", engine.restitution_velocity, positive);
    if (engine.restitution_velocity) a.value("restitution_exponent", engine.restitution_exponent, positive);
  } else {
    a.choice("impact_friction", engine.impact_friction, impact_friction_words);
    a.value("shadowed", engine.shadowed);
  }
}

template <class Archive>
static void describe(Archive& a, Every& every) {
  a.required("every", every.every, positive);
  a.value("from", every.from, non_negative);
}

template <class Archive>
static void describe(Archive& a, ProfileSpec& profiles) {
  a.number_or_word("from", profiles.from, "steady", non_negative);
  a.value("bin", profiles.bin, non_negative);
  a.value("fine", profiles.fine, positive);
  a.value("every", profiles.every, positive);
}

template <class Archive>
static void describe(Archive& a, ImpactSpec& impacts) {
  a.value("from", impacts.from, non_negative);
}

template <class Archive>
static void describe(Archive& a, FieldSpec& fields) {
  a.number_or_word("from", fields.from, "steady", non_negative);
  a.value("width", fields.width, non_negative);
  a.value("every", fields.every, positive);
}

template <class Archive>
static void describe(Archive& a, ImpactHistogramSpec& histograms) {
  a.number_or_word("from", histograms.from, "steady", non_negative);
  a.value("angles", histograms.angles, between(1, 10000));
  a.value("velocities", histograms.velocities, between(1, 10000));
  a.value("fastest", histograms.fastest, non_negative);
}

template <class Archive>
static void describe(Archive& a, OutputSpec& output) {
  a.section("frames", output.frames);
  a.section("series", output.series);
  a.section("profiles", output.profiles);
  a.section("fields", output.fields);
  a.section("impacts", output.impacts);
  a.section("impact_histograms", output.impact_histograms);
  a.value("contacts", output.contacts);
  a.value("checkpoint", output.checkpoint, positive);
  a.check(!output.contacts || output.frames, "contacts",
          "the contact network is written beside frames; ask for frames = { every = … }");
}

/// What lengths, times between samples and velocities of outputs are if they are not given.
static void fill_defaults(OutputSpec& output, double length, double between_samples, double velocity) {
  const auto fill = [&](auto& spec, double& size) {
    if (size == 0) size = length;
    if (!spec.every) spec.every = between_samples;
  };
  if (output.profiles) fill(*output.profiles, output.profiles->bin);
  if (output.fields) fill(*output.fields, output.fields->width);
  if (output.impact_histograms && output.impact_histograms->fastest == 0)
    output.impact_histograms->fastest = 2 * (velocity > 0 ? velocity : 1);
}

struct Run {
  double& duration;
};
template <class Archive>
static void describe(Archive& a, Run& run) {
  a.required("duration", run.duration, positive);
}

template <class Archive>
static void describe(Archive& a, Scene& scene) {
  a.value("title", scene.title);
  a.choice("units", scene.units, units_words);
  a.value("seed", scene.seed, non_negative);
  const bool reduced = scene.units == Units::reduced;
  if constexpr (Archive::reading) {
    if (a.has("sweep")) a.fail("sweep", "this file describes many runs: use chute sweep");
    scene.incline.gravity = reduced ? 1 : 9.81;
    if (reduced) scene.grains.density = 6 / std::numbers::pi;
  }
  a.required_section("incline", scene.incline);
  a.required_section("bed", scene.bed);
  a.required_section("grains", scene.grains);
  a.required_section("contact", scene.contact);
  a.section("engine", scene.engine);
  Run run{scene.duration};
  a.required_section("run", run);
  if constexpr (Archive::reading) {
    a.check(scene.grains.density > 0, "grains", "density is missing; SI scenes need it (kg/m³)");
    a.check(!scene.grains.independent || scene.engine.method == EngineSpec::Method::soft, "engine",
            "independent grains need method = \"soft\"");
    if (scene.engine.method == EngineSpec::Method::stochastic) {
      a.check(scene.grains.count == 1 && scene.bed.kind != Bed::Kind::none, "engine",
              "method = \"stochastic\" moves a single ball along a bed");
      a.check(scene.grains.start.velocity > 0, "grains",
              "the stochastic ball must start downhill: velocity > 0");
    }
    const double d = scene.bed.diameter, g = scene.incline.gravity;
    scene.output.series.every = scene.duration / 400;
    scene.output.checkpoint = scene.duration / 10;
    a.section("output", scene.output);
    fill_defaults(scene.output, d, g > 0 ? 0.02 * std::sqrt(d / g) : scene.duration / 1e4, std::sqrt(g * d));
  } else {
    a.section("output", scene.output);
  }
}

double Incline::theta() const { return sine ? std::asin(*sine) : parse_angle(*angle).value(); }

double Scene::mean_diameter() const {
  return grains.diameter ? grains.diameter->mean : *grains.size_ratio * bed.diameter;
}
double Scene::mean_mass() const {
  return grains.density * std::numbers::pi / 6 * std::pow(mean_diameter(), 3);
}
laws::Pair Scene::reference_pair() const {
  const double R = mean_diameter() / 2, r = bed.diameter / 2;
  return interacting() ? laws::Pair(mean_mass() / 2, R / 2) : laws::Pair(mean_mass(), R * r / (R + r));
}

/// Refuses runs of more steps than can be counted.
static void check_step_count(const Scene& scene, const TomlReader& reader) {
  // 2^53 is where times of steps would no longer be told apart; no machine gets there.
  constexpr double most = 1e15;
  const double contact_time = reference_impact(scene.contact, scene.reference_pair()).contact_time;
  const double step = scene.engine.time_step.value_or(contact_time / scene.engine.steps_per_contact);
  if (scene.duration / step > most)
    reader.fail("run.duration",
                fmt::format("{:.6g} takes {:.2g} steps of {:.3g}, more than {:.0e} that can be counted",
                            scene.duration, scene.duration / step, step, most));
}

Scene parse_scene(std::string_view text, const std::string& name, const std::vector<std::string>& settings) {
  toml::table table = parse_toml(text, name);
  for (const auto& setting : settings) set_by_path(table, setting);
  TomlReader reader(table, name);
  if (table.contains("experiment"))
    reader.fail("experiment",
                "an experiment is no flow down an incline; chute run, check and figure take it");
  Scene scene;
  describe(reader, scene);
  reader.finish();
  check_contact_time(scene.contact, scene.reference_pair(), reader);
  check_step_count(scene, reader);
  if (const auto wrong = misfit(scene)) reader.fail(wrong->key, wrong->message);
  return scene;
}

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& settings) {
  return parse_scene(read_file(file), file.string(), settings);
}

std::string to_toml(const Scene& scene) {
  TomlWriter writer;
  Scene copy = scene;
  describe(writer, copy);
  return writer.text();
}

}  // namespace chute::scene
