#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/fact.hpp"
#include "experiments/binary_impact.hpp"
#include "experiments/brake_failure.hpp"
#include "experiments/column.hpp"
#include "experiments/pushed_cylinder.hpp"
#include "laws/contact_spec.hpp"
#include "measure/outputs.hpp"
#include "scene/scene.hpp"

/// Experiments as scenes: a table [experiment] in place of incline, bed, grains and run, with the contact
/// laws and their keys as in every scene.
namespace chute::experiments {

/// A grain: a solid sphere of a mass or a density.
struct GrainSpec {
  double radius = 1;
  std::optional<double> mass, density;
  double spin = 0;  ///< anticlockwise
  bool fixed = false;
};

struct Experiment {
  enum class Kind { normal_impact, oblique_impact, column, brake_failure, pushed_cylinder };

  std::string title;
  scene::Units units = scene::Units::reduced;
  Kind kind = Kind::normal_impact;
  GrainSpec i;                 ///< impacts: the first grain; column: each grain; brake-failure: the ball
  std::optional<GrainSpec> j;  ///< impacts: the second, if it differs; brake-failure: a grain of the wall
  double velocity = 1;         ///< relative, before the impact
  // oblique-impact, brake-failure: one of them says the impact angle ϑ (1.15)
  std::optional<double> psi;  ///< tan ϑ, which is ψ_i of grains without spin
  std::optional<double> sine;
  std::optional<std::string> angle;  ///< "87.4 deg"
  std::int64_t count = 10;           ///< grains of the column, or of the wall
  double gap_time = 1;               ///< column: t_0/t_n
  // pushed-cylinder; the tangential law's own friction is μ_p
  std::vector<double> push, duration;
  double block_friction = 0;  ///< μ_b
  double time_step = 1e-6;
  double steps_per_contact = 500;

  laws::ContactSpec contact;
  measure::Every series;                 ///< default: a hundred rows per contact time, or a thousand
  std::optional<measure::Every> frames;  ///< not of the cylinder

  double theta() const;  ///< ϑ, radians; 0 of normal impacts
  laws::ContactLaws laws() const { return contact.laws(pair()); }
  /// The pair that contact times and restitutions are given for: i and j, two of the column, ball and wall,
  /// cylinder and plane.
  laws::Pair pair() const;
  double reach() const;  ///< R_i + R_j

  BinaryImpact<2> impact() const;
  Column column_set_up() const;
  BrakeFailure brake_failure() const;
  PushedCylinder cylinder() const;
  std::vector<Push> pushes() const;
  double step() const;  ///< the time step
};

/// Does this file have a table [experiment]? InputError if it cannot be read or is not TOML.
bool is_experiment(const std::filesystem::path& file);
bool is_experiment(std::string_view text, const std::string& name);

/// Reads an experiment; `settings` are `key.path=value`. InputError `FILE:LINE: key: …` on anything unknown,
/// missing or out of range.
Experiment read_experiment(const std::filesystem::path& file, const std::vector<std::string>& settings = {});
Experiment parse_experiment(std::string_view text, const std::string& name,
                            const std::vector<std::string>& settings = {});

/// The complete experiment as TOML: reading it gives the same.
std::string to_toml(const Experiment& experiment);

/// What follows from it, for `chute check`.
std::vector<Fact> facts(const Experiment& experiment);

}  // namespace chute::experiments
