#include "scene/scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/angle.hpp"
#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/toml_reader.hpp"
#include "scene/choose_contact.hpp"
#include "scene/species.hpp"
#include "scene/world.hpp"

namespace chute::scene {

// Outside unnamed namespaces: the archives find these by the type that they describe.

template <class Archive>
static void check_angle(Archive& a, const char* key, const std::string& angle) {
  a.check(parse_angle(angle).has_value(), key,
          fmt::format("\"{}\" is not an angle, write \"18 deg\" or \"0.3 rad\"", angle));
}

template <class Archive>
static void describe_angle(Archive& a, const char* key, std::string& angle, const char* text) {
  a.required(key, angle, text);
  if constexpr (Archive::reading) check_angle(a, key, angle);
}

template <class Archive>
static void describe(Archive& a, Tilting& tilting) {
  describe_angle(a, "from", tilting.from, "where the incline starts");
  describe_angle(a, "to", tilting.to, "where it stays in the end, or turns");
  describe_angle(a, "rate", tilting.rate, "how far it is tilted per time, > 0");
  a.value("then", tilting.then, "where it goes from there, at the same rate");
  if constexpr (Archive::reading) {
    if (tilting.then) check_angle(a, "then", *tilting.then);
    for (const auto& [key, angle] : {std::pair("from", &tilting.from), std::pair("to", &tilting.to),
                                     std::pair("then", tilting.then ? &*tilting.then : &tilting.to)})
      a.check(std::abs(*parse_angle(*angle)) <= std::numbers::pi / 2, key,
              fmt::format("\"{}\" is not allowed, must be between -90 deg and 90 deg", *angle));
    a.check(*parse_angle(tilting.rate) > 0, "rate",
            fmt::format("\"{}\" is not allowed, must be > 0", tilting.rate));
  }
}

template <class Archive>
static void describe(Archive& a, Incline& incline) {
  bool table = incline.tilting.has_value();
  if constexpr (Archive::reading) table = a.has_table("angle");
  if (table)
    a.section("angle", incline.tilting);
  else
    a.value("angle", incline.angle,
            "inclination, \"18 deg\" or \"0.3 rad\"; or { from, to, rate, then } of one that is tilted");
  a.value("sin", incline.sine, between(-1, 1), "its sine instead");
  a.value("tan", incline.tangent, "its tangent instead");
  a.value("gravity", incline.gravity, non_negative, "g; default 9.81 m/s² in SI, 1 in reduced units");
  if constexpr (Archive::reading) {
    const int given =
        (incline.angle || incline.tilting) + incline.sine.has_value() + incline.tangent.has_value();
    a.check(given == 1,
            incline.sine      ? "sin"
            : incline.tangent ? "tan"
                              : "angle",
            "give either angle = \"18 deg\" or sin = 0.31, or tan = 0.32");
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
static void describe(Archive& a, DomainSpec& domain) {
  a.value("periodic", domain.periodic,
          "directions that repeat, of \"x\", \"y\", \"z\"; default all along the bed");
  a.value("size", domain.size, positive, "lengths along x, y, z, where the bed does not say them");
}

struct BedTable {
  Chosen<beds::Bed>& bed;
  std::optional<std::string>& material;
};
template <class Archive>
static void describe(Archive& a, BedTable& table) {
  choose_kind(a, "kind", table.bed, beds::list());
  a.value("material", table.material, "its name in [[material]]; default the first");
  chute::describe(a, *table.bed);
}

struct StartTable {
  Chosen<starts::Start>& start;
};
template <class Archive>
static void describe(Archive& a, StartTable& table) {
  starts::choose_start(a, table.start);
  chute::describe(a, *table.start);
}

template <class Archive>
static void describe(Archive& a, GrainsSpec& grains) {
  StartTable start{grains.start};
  a.section("start", start);
  const bool brought = grains.start->brings_grains();
  if (!brought) {
    a.required("count", grains.count, between(1, 1e7), "moving grains");
    a.section("diameter", grains.diameter);
    a.value("size_ratio", grains.size_ratio, positive, "R/r, instead of a diameter");
  }
  a.value("density", grains.density, positive,
          "of the grains, spheres in 2D too; default 6/π in reduced units: m = d³");
  a.value("independent", grains.independent,
          "grains do not feel each other: many starts of one, side by side");
  a.value("rotation", grains.rotation, "false: grains never spin, as if friction acted at their centres");
  a.sections("shape", grains.shapes);
  if constexpr (Archive::reading) {
    const int given = grains.diameter.has_value() + grains.size_ratio.has_value();
    if (grains.sizes_of_materials)
      a.check(given == 0, grains.diameter ? "diameter" : "size_ratio",
              "each [[material]] of the grains has a diameter of its own: leave this out");
    else
      a.check(brought || given == 1, grains.diameter ? "size_ratio" : "diameter",
              "give either diameter = { mean = …, std = … } or size_ratio = R/r");
  }
}

struct EngineTable {
  Chosen<engines::Method>& method;
};
template <class Archive>
static void describe(Archive& a, EngineTable& table) {
  choose_kind(a, "method", table.method, engines::list());
  chute::describe(a, *table.method);
}

/// [output]: each kind describes its own keys.
struct Outputs {
  std::vector<Chosen<measure::Output>>& kinds;
  double& checkpoint;
};
template <class Archive>
static void describe(Archive& a, Outputs& outputs) {
  for (auto& kind : outputs.kinds) chute::describe(a, *kind);
  a.value(
      "checkpoint", outputs.checkpoint, positive,
      "time between checkpoints, or longer where they would take more than a twentieth of the work; default a tenth of the run");
}

struct Run {
  double& duration;
};
template <class Archive>
static void describe(Archive& a, Run& run) {
  a.required("duration", run.duration, positive, "time to simulate");
}

static measure::Scales scales_of(const Scene& scene) {
  const double d = scene.bed->diameter, g = scene.incline.gravity;
  return {scene.duration, d, g > 0 ? std::sqrt(g * d) : 1,
          g > 0 ? 0.02 * std::sqrt(d / g) : scene.duration / 1e4};
}

Scene::Scene() : bed(beds::list().front()), engine(engines::list().front()) {
  grains.start = Chosen<starts::Start>(starts::list().front());
  for (const auto& kind : measure::list()) output.emplace_back(kind);
}

void Scene::drop_outputs() {
  for (auto& o : output) o->drop();
}
void Scene::drop_output(std::string_view word) {
  for (auto& o : output)
    if (o.word() == word) o->drop();
}

template <class Archive>
static void describe(Archive& a, Scene& scene) {
  a.value("title", scene.title, "for people");
  a.choice("units", scene.units, units_words, "SI, or m = g = d = 1 with d the diameter of a bead");
  std::int64_t dimensions = scene.dimensions;
  a.value("dimensions", dimensions, between(2, 3), "2: discs on a line; 3: spheres on a plane");
  scene.dimensions = static_cast<int>(dimensions);
  a.value("seed", scene.seed, non_negative, "of all random numbers");
  if constexpr (Archive::reading) {
    if (a.has("sweep")) a.fail("sweep", "this file describes many runs: use chute sweep");
    scene.incline.gravity = scene.si() ? 9.81 : 1;
    if (!scene.si()) scene.grains.density = 6 / std::numbers::pi;
  }
  EngineTable engine{scene.engine};
  // A method that lays its grains itself leaves out what others need, so it is read before them.
  if constexpr (Archive::reading) {
    a.section("engine", engine);
    if (scene.engine->brings_grains())
      for (const char* table : {"grains", "contact"})
        if (a.has(table))
          a.fail(table, fmt::format("engine.method = \"{}\" lays its grains itself", scene.engine.word()));
  }
  a.required_section("incline", scene.incline);
  if (!std::same_as<Archive, TomlWriter> || scene.domain.periodic || scene.domain.size)
    a.section("domain", scene.domain);
  BedTable bed{scene.bed, scene.bed_material};
  a.required_section("bed", bed);
  a.sections("material", scene.materials);
  a.sections("wall", scene.walls);
  a.section("inflow", scene.inflow);
  a.section("outflow", scene.outflow);
  if (!scene.engine->brings_grains()) {
    if constexpr (Archive::reading) scene.grains.sizes_of_materials = all_have_diameters(scene.materials);
    a.required_section("grains", scene.grains);
    a.required_section("contact", scene.contact);
  }
  if constexpr (!Archive::reading) a.section("engine", engine);
  Run run{scene.duration};
  a.required_section("run", run);
  Outputs outputs{scene.output, scene.checkpoint};
  if constexpr (Archive::reading) {
    const bool dense = !scene.materials.empty() && std::ranges::all_of(scene.materials, [](const auto& m) {
      return m.density.has_value();
    });
    a.check(scene.grains.density > 0 || dense, "grains", "density is missing; SI scenes need it (kg/m³)");
    const auto scales = scales_of(scene);
    const double usually = 0.1 * scales.length / scales.velocity;  // 0.1 √(d/g)
    if (scene.inflow && !scene.inflow->every) scene.inflow->every = usually;
    if (scene.outflow && !scene.outflow->every) scene.outflow->every = usually;
    for (auto& kind : scene.output) kind->before_reading(scales);
    scene.checkpoint = scene.duration / 10;
    a.section("output", outputs);
    for (auto& kind : scene.output) kind->fill(scales);
  } else {
    a.section("output", outputs);
  }
}

Tilt Tilting::tilt(double gravity) const {
  Tilt tilt{parse_angle(from).value(), parse_angle(to).value(), parse_angle(rate).value(), gravity};
  if (then) tilt.then = parse_angle(*then);
  return tilt;
}

double Incline::theta() const {
  if (tilting) return tilting->tilt(gravity).from;
  return sine ? std::asin(*sine) : tangent ? std::atan(*tangent) : parse_angle(*angle).value();
}

/// Refuses runs of more steps than can be counted.
static void check_step_count(const Scene& scene, const engines::Setting& setting, const TomlReader& reader) {
  // 2^53 is where times of steps would no longer be told apart; no machine gets there.
  constexpr double most = 1e15;
  const double step = scene.engine->step(setting);
  if (step > 2 * scene.duration)
    reader.fail("run.duration",
                fmt::format("{:.6g} is less than half a step of {:.3g}", scene.duration, step));
  if (!(scene.duration / step <= most))
    reader.fail("run.duration",
                fmt::format("{:.6g} takes {:.2g} steps of {:.3g}, more than {:.0e} that can be counted",
                            scene.duration, scene.duration / step, step, most));
}

/// Refuses outputs of which there would be more than a disk or a reader can take.
static void check_output_count(const Scene& scene, const TomlReader& reader) {
  constexpr double most = 1e7;
  for (const auto& output : scene.output) {
    const double every = output->rhythm();
    if (output->wanted() && scene.duration / every > most)
      reader.fail(fmt::format("output.{}.every", output.word()),
                  fmt::format("{:.3g} makes {:.2g} of them in run.duration = {:.6g}, more than {:.0e}", every,
                              scene.duration / every, scene.duration, most));
  }
}

/// Refuses names of materials that are not there, and contacts that never end.
static void check_contacts(const Scene& scene, const engines::Setting& setting, const TomlReader& reader) {
  laws::check_contact_time(scene.contact, setting.reference(), reader);
  for (const auto& meeting : setting.meetings()) {
    if (!meeting.own || meeting.own->restitution == 0) continue;  // which only hard grains can have
    const auto impact = meeting.contact.impact(meeting.reference);
    if (!(impact.restitution > 0 && std::isfinite(impact.contact_time)))
      reader.fail(fmt::format("contact.between[{}]", meeting.place),
                  fmt::format("the damping is too strong: {} would never part where they meet",
                              fmt::join(meeting.own->materials, " and ")));
  }
}

static Scene scene_of(const toml::table& table, const std::string& name) {
  TomlReader reader(table, name);
  if (table.contains("experiment"))
    reader.fail("experiment",
                "an experiment is no flow down an incline; chute run, check and figure take it");
  Scene scene;
  reader.collect();
  reader.expect_physics();
  reader.know_elsewhere([] {
    std::vector<std::string> names;
    for (const auto& key : plain_keys()) names.push_back(key.key);
    return names;
  });
  try {
    describe(reader, scene);
    reader.finish();
  } catch (const SlipTold&) {
    // told with the others
  }
  reader.throw_slips();
  if (const auto wrong = refusal_of_materials(scene)) reader.fail(wrong->key, wrong->message);
  // Before anything is laid: a bed too full for its beads is looked for places in for hours.
  if (const auto wrong = refusal_of_bed(scene)) reader.fail(wrong->key, wrong->message);
  const auto setting = setting_of(scene);
  if (!scene.engine->brings_grains()) check_contacts(scene, setting, reader);
  if (const auto wrong = refusal_of(scene)) reader.fail(wrong->key, wrong->message);
  check_step_count(scene, setting, reader);
  check_output_count(scene, reader);
  return scene;
}

Scene parse_scene(std::string_view text, const std::string& name, const std::vector<std::string>& settings) {
  toml::table table = parse_toml(text, name);
  for (const auto& setting : settings) set_by_path(table, setting);
  auto chosen = choose_contact(table, [&](const toml::table& with) { return scene_of(with, name); });
  auto scene = scene_of(table, name);
  if (!table.contains("seed")) chosen.push_back(fmt::format("seed = {}", scene.seed));
  if (!table.contains("units"))
    chosen.push_back("units = \"reduced\": m = g = d = 1, d the diameter of a bead");
  scene.chosen = std::move(chosen);
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

std::vector<KeyText> plain_keys() {
  KeyLister lister;
  Scene scene;
  scene.incline.angle = "18 deg";
  describe(lister, scene);
  std::vector<KeyText> keys;
  for (const auto& key : lister.keys()) {
    const auto in = [&](const char* table) { return key.key.starts_with(table); };
    const bool told_elsewhere = (in("bed.") && key.key != "bed.material") || in("grains.start.") ||
                                in("engine.") || in("contact.") ||
                                (in("output.") && key.key != "output.checkpoint");
    if (!told_elsewhere) keys.push_back(key);
  }
  return keys;
}

}  // namespace chute::scene
