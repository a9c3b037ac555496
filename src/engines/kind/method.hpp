#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/keys.hpp"
#include "core/by_pair.hpp"
#include "core/engine.hpp"
#include "core/fact.hpp"
#include "core/offers.hpp"
#include "core/world.hpp"
#include "laws/contact_spec.hpp"

/// What a method of simulation tells of itself. Each has a folder beside this one, and a line in engines/list.cpp.
namespace chute::engines {

/// A species of grains, of the bed or of walls: [[material]].
struct Material {
  std::string name;
  bool grains = false;  ///< are there moving grains of it?
  /// Of a mean grain and of the smallest; of what is only bed or wall its radius is that of a bead, or 0 of a plane.
  double radius = 0, mass = 0, smallest_radius = 0, smallest_mass = 0;
};

/// Two materials that can meet, and how.
struct MeetingMaterials {
  int a, b;
  std::string name;                 ///< "glass-steel"
  laws::ContactSpec contact;        ///< [contact] with what is their own
  laws::Pair reference;             ///< that contact times and restitutions are given for
  laws::Pair mean, stiffest;        ///< two mean grains, two of the smallest
  const laws::ContactBetween* own;  ///< null: nothing is
  std::size_t place;                ///< of their own in [[contact.between]]
};

/// What a method may know of a scene besides its world.
struct Setting {
  bool si = false;  ///< units' names: SI, or m = g = d = 1
  std::uint64_t seed = 1;
  int dimensions = 2;
  double theta = 0, gravity = 0;
  double duration = 0;
  std::array<double, 3> size{};  ///< of the domain along x, y, z; 0 where nothing says it
  double spread = 0;             ///< standard deviation of a velocity component at the start
  double between_outputs = 0;    ///< shortest time between two rows of the series or two frames
  laws::ContactSpec contact;
  std::vector<Material>
      materials;  ///< [[material]], as grains, bed and walls number them; empty: all are of one
  /// Contacts of interest; the first is the one that contact times and restitutions of the scene are given for: two mean
  /// grains, or the only grain with the bed.
  std::vector<laws::NamedPair> pairs;
  /// The contact that is over first: the smallest grains with each other or with the bed.
  std::optional<laws::NamedPair> stiffest;
  double mean_diameter = 1, mean_mass = 1, bead_diameter = 1;
  double bead_spacing = 1;  ///< nominal way from bead to bead; 0: no bed of beads
  double widest_spacing = 1;
  std::int64_t grains = 1;
  bool independent = false, rotation = true;
  double launch_velocity = 0;              ///< mean v_x at the start
  double fastest = 0;                      ///< how fast the fastest grain is at the start, about
  double drum = 0;                         ///< radius of the cylinder among [[wall]]; 0: there is none
  std::vector<WallSurface> wall_surfaces;  ///< of [[wall]], in order: what is their own

  /// What a step resolves: the smaller of a mean grain and a bead of the bed.
  double resolved_diameter() const {
    return bead_spacing > 0 ? std::min(mean_diameter, bead_diameter) : mean_diameter;
  }
  /// How many of the threads pay, where each needs so many moving grains.
  int useful_threads(int threads, std::int64_t grains_each) const {
    return static_cast<int>(std::clamp<std::int64_t>(grains / grains_each, 1, threads));
  }
  laws::Pair reference() const { return pairs.front().pair; }
  const laws::NamedPair& shortest() const { return stiffest ? *stiffest : pairs.front(); }
  /// Which of the materials can meet: all pairs but those of bed and walls.
  std::vector<MeetingMaterials> meetings() const;
  /// Do contacts depend on who meets? Else the contact of the scene is that of all.
  bool by_pair() const { return !contact.between.empty(); }
  /// `value(meeting)` of all that can meet; of bed and walls with each other `rest`.
  template <class Value, class Make>
  ByPair<Value> for_pairs(const Value& rest, const Make& value) const {
    ByPair<Value> all(materials.size(), rest);
    for (const auto& meeting : meetings()) all.set(meeting.a, meeting.b, value(meeting));
    return all;
  }
  /// Names of units.
  std::string in(const char* si_unit, const char* reduced_unit) const { return si ? si_unit : reduced_unit; }
};

/// What a scene says of its method.
class Method : public Keys {
 public:
  using Thing = Method;
  virtual std::unique_ptr<Method> clone() const = 0;
  virtual Offers offers() const = 0;
  /// Does it lay its grains itself? Then a scene has neither [grains] nor [contact].
  virtual bool brings_grains() const { return false; }
  /// Why it cannot do this scene.
  virtual std::optional<Refusal> refusal(const Setting&) const { return {}; }
  /// The time between the instants at which a run can stop.
  virtual double step(const Setting& setting) const = 0;
  /// What follows from the scene, for `chute check`.
  virtual std::vector<Fact> facts(const Setting& setting) const = 0;
  /// What a physicist should know before trusting a run, one sentence each.
  virtual std::vector<std::string> warnings(const Setting&) const { return {}; }
  /// Seconds that a step takes, roughly, on one core.
  virtual double seconds_per_step(const Setting&) const { return 0; }
  virtual std::unique_ptr<Engine> make(World<2> world, const Setting& setting, int threads) const = 0;
  virtual std::unique_ptr<Engine> make(World<3> world, const Setting& setting, int threads) const = 0;
};

/// All methods, the default first.
Catalogue<Method>& list();

/// The longest step not above `longest` of which a whole number lies between two outputs, so that frames are at t =
/// 12.5 and not at 12.49999.
double step_dividing(double between_outputs, double longest);

}  // namespace chute::engines
