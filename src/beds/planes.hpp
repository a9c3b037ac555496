#pragma once
#include "beds/plane.hpp"

/// The recipes for rough planes, each in a file of its own.
namespace chute::beds {

/// Discs of different sizes at random places that were pushed apart; then all get the same size, and those around holes
/// that are too wide are drawn in until there are none, without overlaps. `hole` = 2 is the least that thesis 4.3.1 asks for
/// (no hole in which another bead would fit), but then a tenth of the Voronoi vertices lie beyond 1.77 r, the deepest hole
/// that the thesis tells of (fig. 4.33c: 6 r sin 0.3).
class RelaxedPlane final : public Described<Plane, RelaxedPlane> {
 public:
  static constexpr std::string_view word = "plane",
                                    text =
                                        "a rough plane: random beads pushed apart, wide holes drawn in (3D)";
  double disorder = 0.05, hole = 1.77;

  template <class Archive>
  void describe(Archive& a) {
    describe_plane(a);
    a.value("disorder", disorder, between(0, 0.3),
            "σ: beads are first pushed apart as if their radii were r(1 + σ g), g gaussian");
    a.value("hole", hole, between(1.6, 3), "in r: no Voronoi vertex is farther than this from its beads");
  }

 protected:
  Sheet arrange(const Site& site) const override;
};

/// Beads that fell at random wherever there was room, and the others into the largest holes. Of the recipes the one with the
/// fewest overlaps and deep holes: scenes/ball-3d.toml takes it.
class RandomPlane final : public Described<Plane, RandomPlane> {
 public:
  static constexpr std::string_view
      word = "plane-random",
      text = "a rough plane: random sequential adsorption, then beads into the largest holes (3D)";
  template <class Archive>
  void describe(Archive& a) {
    describe_plane(a);
  }

 protected:
  Sheet arrange(const Site& site) const override;
};

/// Beads that were rolled in from one edge, each into the next gap; how closely they lie varies from bead to bead.
class SpreadPlane final : public Described<Plane, SpreadPlane> {
 public:
  static constexpr std::string_view
      word = "plane-spread",
      text = "a rough plane: beads rolled in from one edge, each into the next gap (3D)";
  template <class Archive>
  void describe(Archive& a) {
    describe_plane(a);
  }

 protected:
  Sheet arrange(const Site& site) const override;
};

/// Rows of a triangular lattice, with noise: the ordered plane that the thesis warns of.
class LatticePlane final : public Described<Plane, LatticePlane> {
 public:
  static constexpr std::string_view
      word = "plane-lattice",
      text = "an ordered plane: a triangular lattice whose beads are moved a little (3D)";
  double noise = 0.1;

  template <class Archive>
  void describe(Archive& a) {
    describe_plane(a);
    a.value("noise", noise, between(0, 1), "standard deviation of a bead's place, in bead radii");
  }

 protected:
  Sheet arrange(const Site& site) const override;
};

/// Beads where a file says: a scanned plane, or one that others made.
class PlaneFromFile final : public Described<Plane, PlaneFromFile> {
 public:
  static constexpr std::string_view word = "plane-file",
                                    text = "a rough plane whose beads lie where a file says (3D)";
  std::string file;

  template <class Archive>
  void describe(Archive& a) {
    describe_diameter(a);
    a.required("file", file, "CSV with columns x and y, or VTK points; in the scene's unit of length");
    a.required("size", size, positive, "[along, across]: after which it repeats");
    a.check(size->size() == 2, "size", "must be [along, across]");
  }
  std::optional<Refusal> misfit(const Site& site) const override;

 protected:
  Sheet arrange(const Site& site) const override;
  bool has_own_lengths() const override { return true; }
};

}  // namespace chute::beds
