#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/contact_spec.hpp"

/// A scene: what a physicist writes down to define a run. Lengths, times and masses are in SI or in reduced
/// units (m = g = d = 1, with d the diameter of a bed grain). Reading fills every default in, so that the
/// written-back scene is complete.
namespace chute::scene {

enum class Units { reduced, si };
inline constexpr std::array<std::string_view, 2> units_words{"reduced", "SI"};

/// Inclination θ: `angle = "18 deg"` (or `"0.3 rad"`), or `sin = 0.094`. Kept as it was written, so that the
/// resolved scene gives the same bytes.
struct Incline {
  std::optional<std::string> angle;
  std::optional<double> sine;
  double gravity = 0;  ///< g; default 9.81 m/s² in SI, 1 in reduced units
  double theta() const;
};

/// A periodic line of fixed grains along x, at height 0.
struct Bed {
  enum class Kind { row, disordered_row, none } kind = Kind::row;
  double diameter = 1;
  std::int64_t count = 30;
  double gap = 0;                ///< row: ε; neighbours' surfaces are 2εr apart
  double gap_max = 0;            ///< disordered-row: ε_max; ε is drawn evenly from [0, ε_max]
  std::optional<double> length;  ///< none: length of the periodic domain
};

struct Diameter {
  double mean = 1, std = 0;  ///< gaussian, cut off at three standard deviations
};

/// Where and how fast the grains start.
struct Start {
  enum class Lattice { square, none } lattice = Lattice::square;
  std::optional<double> spacing;  ///< square: distance between neighbours; default 1.25 mean diameters
  std::optional<double> x;  ///< none: place along the line; default above the first gap, or, of independent
                            ///< grains, evenly along the line
  std::optional<double>
      height;              ///< of the lowest centres above the bed's; default: one diameter of free space
  double velocity = 0;     ///< mean v_x
  double velocity_up = 0;  ///< mean v_y
  double spread = 0;       ///< standard deviation of both components
};

struct GrainsSpec {
  std::int64_t count = 1;
  std::optional<Diameter> diameter;
  std::optional<double> size_ratio;  ///< Φ = R/r instead of a diameter
  double density = 0;  ///< grains are spheres, in 2D too; default 6/π in reduced units (m = d³)
  bool independent =
      false;             ///< grains do not feel each other: `count` starts of a single grain, side by side
  bool rotation = true;  ///< false: grains never spin, as if friction acted at their centres (thesis 4.2.4.2)
  Start start;
};

struct EngineSpec {
  enum class Method { soft, event, stochastic } method = Method::soft;
  enum class Integrator { gear5, verlet } integrator = Integrator::gear5;
  double steps_per_contact =
      50;  ///< t_n of two mean grains (of grain and bed, if there is one grain) over the step
  std::optional<double> time_step;  ///< instead
  double deepest_overlap = 0.25;    ///< of the smaller radius; beyond it the run stops
  // event, stochastic: Walton's collisions. What is not given is that of [contact], for the reference pair
  std::optional<double> restitution, friction;
  double tangential_restitution = 0;  ///< β
  // event
  std::optional<double> contact_time;          ///< t_c of the cut-off, 0: none; default t_n of [contact]
  std::optional<double> restitution_velocity;  ///< v_0 at which e_n holds: e_n(v) = 1 − (1 − e_n)(v/v_0)^δ
  double restitution_exponent = 0.2;           ///< δ
  // stochastic
  enum class Friction {
    published,
    without_rotation
  } impact_friction = Friction::published;  ///< (4.8) or (4.9)
  bool shadowed = false;                    ///< only angles that a ball can reach
};

/// When one kind of output is written, in the scene's time.
struct Every {
  double every = 0, from = 0;
};
struct ProfileSpec {
  std::optional<double> from =
      0;           ///< empty, written "steady": from when the flow settled, found from the run itself
  double bin = 0;  ///< height of a bin; default one bed diameter
  std::optional<double> fine;   ///< height of the bins of a second profile, in profiles_fine.csv
  std::optional<double> every;  ///< time between samples; default 0.02 √(d/g)
};
/// Coarse-grained fields over the height.
struct FieldSpec {
  std::optional<double> from = 0;  ///< as in ProfileSpec
  double width = 0;                ///< of the smoothing kernel; default one bed diameter
  std::optional<double> every;     ///< as in ProfileSpec
};
struct ImpactSpec {
  double from = 0;
};
/// Statistics of impacts, gathered in the run.
struct ImpactHistogramSpec {
  std::optional<double> from = 0;  ///< as in ProfileSpec
  std::int64_t angles = 90;        ///< bins of γ mod π
  std::int64_t velocities = 100;   ///< bins of |v_n|
  double fastest = 0;              ///< end of the last of them; default 2 √(gd)
};
struct OutputSpec {
  std::optional<Every> frames;
  Every series;  ///< default: 400 rows over the run
  std::optional<ProfileSpec> profiles;
  std::optional<FieldSpec> fields;
  std::optional<ImpactSpec> impacts;
  std::optional<ImpactHistogramSpec> impact_histograms;
  bool contacts = false;  ///< the contact network beside every frame
  double checkpoint = 0;  ///< time between checkpoints; default a tenth of the run
};

struct Scene {
  std::string title;
  Units units = Units::reduced;
  std::int64_t seed = 1;
  Incline incline;
  Bed bed;
  GrainsSpec grains;
  ContactSpec contact;
  EngineSpec engine;
  double duration = 0;
  OutputSpec output;

  bool interacting() const { return grains.count > 1 && !grains.independent; }  ///< moving grains may collide
  double mean_diameter() const;                                                 ///< of the moving grains
  double mean_mass() const;
  /// Reduced mass of the contact that sets the time step: two mean grains, or the only grain with the bed.
  double reference_mass() const { return reference_pair().m_eff; }
  laws::Pair reference_pair() const;
};

/// Reads a scene file; `settings` are `key.path=value` from the command line. InputError `FILE:LINE: key: …`
/// on anything unknown, missing or out of range.
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& settings = {});
Scene parse_scene(std::string_view text, const std::string& name,
                  const std::vector<std::string>& settings = {});

/// The complete scene as TOML: reading it gives the same scene.
std::string to_toml(const Scene& scene);

}  // namespace chute::scene
