#pragma once
#include "beds/bed.hpp"
#include "beds/tessellation.hpp"

namespace chute::beds {

/// What can be measured of a plane of beads of radius r.
struct PlaneShape {
  double beads, coverage;  ///< π r² N over the area, overlaps counted twice
  double overlapping;      ///< part of the neighbouring pairs that overlap by more than a hundredth of r
  double widest_hole;      ///< largest distance of a Voronoi vertex from its beads, in r
  double deep_holes;       ///< part of the vertices beyond 1.77 r
  double hexatic;          ///< |<psi_6>| over the bonds of all beads: 1 on a triangular lattice
  double hexatic_of_neighbours;  ///< <|psi_6|>, the same for each bead alone
};
PlaneShape shape_of(const Sheet& sheet, double radius);
std::vector<Fact> plane_facts(const Sheet& sheet, double radius);

/// A rough plane of glued beads of one size, at height 0, periodic in both directions (thesis 4.3.1): how many there are
/// and how large it is. Recipes say where they lie.
class Plane : public Bed {
 public:
  std::optional<std::vector<double>> size;
  std::int64_t count = 4085;

  std::optional<Refusal> misfit(const Site& site) const override;
  Ground lay(const Site& site) const override;
  std::vector<Fact> facts(const Site& site) const override;
  const char* length_key() const override { return "bed.size"; }

  /// The places of the beads. Planes that were made lately are remembered: a scene asks for its bed several times.
  Sheet sheet(const Site& site) const;

  /// What is remembered of a plane.
  struct Arranged {
    Sheet sheet;
    double widest_hole;  ///< largest distance of a Voronoi vertex from its beads
  };

 protected:
  template <class Archive>
  void describe_plane(Archive& a) {
    describe_diameter(a);
    constexpr double most = 1e5;  // which take minutes to be arranged
    a.value("count", count, between(30, most), "beads; default those of thesis 4.3.1");
    a.value("size", size, positive, "[along, across]; default [112.5, 43.5] diameters, as in thesis 4.3.1");
    a.check(!size || size->size() == 2, "size", "must be [along, across]");
  }
  double radius() const { return diameter / 2; }
  double length() const { return size ? (*size)[0] : 112.5 * diameter; }
  double width() const { return size ? (*size)[1] : 43.5 * diameter; }
  std::size_t beads() const { return static_cast<std::size_t>(count); }
  virtual Sheet arrange(const Site& site) const = 0;
  /// Whether what the recipe names has lengths of its own, that do not follow the beads'.
  virtual bool has_own_lengths() const { return false; }
  /// No point may be farther than this from every bead, in r: another bead would fit there.
  static constexpr double widest_hole = 2;

 private:
  Arranged arranged(const Site& site) const;
};

}  // namespace chute::beds
