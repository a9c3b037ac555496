#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/keys.hpp"
#include "core/fact.hpp"

/// Beds: what grains run down. One file a kind, and a line in list.cpp.
namespace chute::beds {

/// A fixed grain of the bed. Beds know the frame of the incline and no coordinates: in 2D nothing is `across`.
struct Bead {
  double along, across, above, radius;
};

/// A bed as it lies.
struct Ground {
  std::vector<Bead> beads;
  std::optional<double> length, width;  ///< after which it repeats along and across; empty: it does not say
  bool smooth = false;                  ///< a plane wall at height 0
  double spacing = 0;                   ///< nominal way from bead to bead; 0: there are none
  double widest_spacing = 0;            ///< the largest that there can be
};

/// What a bed may know of its scene.
struct Site {
  int dimensions = 2;
  std::uint64_t seed = 1;
};

/// What a scene says of its bed.
class Bed : public Keys {
 public:
  using Thing = Bed;
  virtual std::unique_ptr<Bed> clone() const = 0;
  virtual std::optional<Refusal> misfit(const Site&) const { return {}; }
  virtual Ground lay(const Site& site) const = 0;
  /// What can be said of it as it lies, for `chute check`.
  virtual std::vector<Fact> facts(const Site&) const { return {}; }
  /// The key that says how long it is.
  virtual const char* length_key() const { return "bed.count"; }

  double diameter = 1;  ///< of a bead; the unit of length of outputs, where there are none

 protected:
  template <class Archive>
  void describe_diameter(Archive& a) {
    a.value("diameter", diameter, positive, "of a bead");
  }
};

/// Diameter of the largest bead; 0 where there are none.
double widest(const Ground& ground);

/// All kinds of beds, the default first.
Catalogue<Bed>& list();

}  // namespace chute::beds
