#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "beds/bed.hpp"
#include "engines/kind/method.hpp"
#include "laws/contact_spec.hpp"
#include "measure/observer.hpp"
#include "scene/diameter.hpp"
#include "scene/material_spec.hpp"
#include "scene/open_ends_spec.hpp"
#include "scene/shape_spec.hpp"
#include "scene/wall_spec.hpp"
#include "starts/start.hpp"

/// A scene: what a physicist writes down to define a run. Lengths, times and masses are in SI or in reduced
/// units (m = g = d = 1, with d the diameter of a bed grain). Reading fills every default in, so that the
/// written-back scene is complete. This room knows no single bed, start, method or observer: their lists say what there
/// is, and each describes its own keys.
namespace chute::scene {

enum class Units { reduced, si };
inline constexpr std::array<std::string_view, 2> units_words{"reduced", "SI"};

/// An angle that changes steadily, `angle = { from = "0 deg", to = "30 deg", rate = "0.1 deg" }`, rate per time; and then,
/// where there is a third, to that.
struct Tilting {
  std::string from, to, rate;
  std::optional<std::string> then;
  Tilt tilt(double gravity) const;
};

/// Inclination θ: `angle = "18 deg"` (or `"0.3 rad"`), or `sin = 0.094`. Kept as it was written, so that the
/// resolved scene gives the same bytes.
struct Incline {
  std::optional<std::string> angle;
  std::optional<Tilting> tilting;  ///< the same key as a table
  std::optional<double> sine, tangent;
  double gravity = 0;    ///< g; default 9.81 m/s² in SI, 1 in reduced units
  double theta() const;  ///< at the start
};

/// [domain]: which directions repeat, and after which length. The bed says the rest.
struct DomainSpec {
  std::optional<std::vector<std::string>>
      periodic;                             ///< of "x", "y", "z"; default "x" in 2D, "x" and "y" in 3D
  std::optional<std::vector<double>> size;  ///< lengths along x, y, z
};

struct GrainsSpec {
  std::int64_t count = 1;
  std::optional<Diameter> diameter;
  std::optional<double> size_ratio;  ///< Φ = R/r instead of a diameter
  bool sizes_of_materials = false;   ///< every species has a diameter of its own, so that there is no other
  double density = 0;  ///< grains are spheres, in 2D too; default 6/π in reduced units (m = d³)
  bool independent =
      false;             ///< grains do not feel each other: `count` starts of a single grain, side by side
  bool rotation = true;  ///< false: grains never spin, as if friction acted at their centres (thesis 4.2.4.2)
  std::vector<ShapeSpec> shapes;  ///< [[grains.shape]]; none: grains are round
  Chosen<starts::Start> start;
};

struct Scene {
  std::string title;
  Units units = Units::reduced;
  int dimensions = 2;
  std::int64_t seed = 1;
  Incline incline;
  DomainSpec domain;
  Chosen<beds::Bed> bed;
  std::optional<std::string> bed_material;  ///< its name; else the first
  std::vector<MaterialSpec> materials;      ///< [[material]]
  std::vector<WallSpec> walls;              ///< [[wall]]
  std::optional<InflowSpec> inflow;         ///< [inflow]
  std::optional<OutflowSpec> outflow;       ///< [outflow]
  GrainsSpec grains;
  laws::ContactSpec contact;
  Chosen<engines::Method> engine;
  double duration = 0;
  std::vector<Chosen<measure::Output>> output;  ///< one of each kind, wanted or not
  /// What was chosen where the scene says nothing, for people; no part of the scene.
  std::vector<std::string> chosen;
  double checkpoint = 0;  ///< time between checkpoints; default a tenth of the run

  Scene();
  bool si() const { return units == Units::si; }
  /// Do grains come in or leave meanwhile?
  bool open() const { return inflow || outflow; }
  /// The output of that type.
  template <class Output>
  Output* wants() {
    for (auto& o : output)
      if (auto* found = o.as<Output>()) return found;
    return nullptr;
  }
  /// Leaves out all outputs but the series.
  void drop_outputs();
  /// Leaves out the output that is called so.
  void drop_output(std::string_view word);
};

/// Reads a scene file; `settings` are `key.path=value` from the command line. InputError `FILE:LINE: key: …`
/// on anything unknown, missing, out of range, or that a run would refuse.
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& settings = {});
Scene parse_scene(std::string_view text, const std::string& name,
                  const std::vector<std::string>& settings = {});

/// The complete scene as TOML: reading it gives the same scene.
std::string to_toml(const Scene& scene);

/// The keys that all scenes have, whatever their beds, starts, methods and observers.
std::vector<KeyText> plain_keys();

/// Every key that a scene can have, table by table, with what it means: `chute check --keys` and the README.
std::string keys_table();

}  // namespace chute::scene
