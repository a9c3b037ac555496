#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "beds/bed.hpp"
#include "common/keys.hpp"

/// Starts: where and how fast grains begin. One file a kind, and a line in list.cpp.
namespace chute::starts {

/// What a start may know of its scene.
struct Opening {
  int dimensions = 2;
  std::uint64_t seed = 1;
  double length = 0, width = 0;  ///< of the domain along and across; 0 where it is not bounded
  const beds::Ground& ground;
  double bead_diameter = 1, mean_diameter = 1;
  bool independent = false;   ///< grains do not feel each other
  std::vector<double> radii;  ///< of the grains, in the order of their ids; empty if the start brings them
};

/// One moving grain at the start, in the coordinates of files (in 2D x, y with z = 0; spin about z).
struct Launch {
  std::array<double, 3> place{}, velocity{}, spin{};
  double radius = 0;
  std::optional<std::array<double, 4>> orientation{};  ///< as in files: w x y z; 2D: w is the angle
  std::optional<double> mass{};                        ///< else that of the scene's density
  int material = 0;
};

/// What a scene says of the start.
class Start : public Keys {
 public:
  using Thing = Start;
  virtual std::unique_ptr<Start> clone() const = 0;
  /// Do number and sizes of the grains come with it, and not from [grains]?
  virtual bool brings_grains() const { return false; }
  virtual std::optional<Refusal> misfit(const Opening&) const { return {}; }
  virtual std::vector<Launch> begin(const Opening& opening) const = 0;
};

/// All kinds of starts, the default first.
Catalogue<Start>& list();

/// Which of them a table [grains.start] names: by `from`, by `kind`, or by `lattice`, the older word.
void choose_start(TomlReader& a, Chosen<Start>& start);
void choose_start(TomlWriter& a, Chosen<Start>& start);
inline void choose_start(KeyLister& a, Chosen<Start>& start) { choose_kind(a, "kind", start, list()); }

}  // namespace chute::starts
