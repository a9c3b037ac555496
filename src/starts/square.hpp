#pragma once
#include "starts/launch_keys.hpp"

namespace chute::starts {

/// A height that is said below the bed: the grain would fall for ever.
std::optional<Refusal> below_the_bed(const Opening& opening, const std::optional<double>& height);

/// Grains on a square lattice (cubic in 3D), layer by layer from the bed up.
class Square final : public Described<MadeStart, Square> {
 public:
  static constexpr std::string_view word = "square", text = "a square lattice (cubic in 3D), layer by layer";
  std::optional<double> spacing, height;

  template <class Archive>
  void describe(Archive& a) {
    a.value("spacing", spacing, positive, "distance of neighbours; default 1.25 mean diameters");
    a.value("height", height, "of the lowest centres; default one diameter of free space above the bed");
    describe_velocities(a);
  }
  std::optional<Refusal> misfit(const Opening& opening) const override;
  std::vector<Launch> begin(const Opening& opening) const override;

 private:
  double step(const Opening& opening) const { return spacing.value_or(1.25 * opening.mean_diameter); }
  std::int64_t columns(double length, double step) const;
};

/// One grain at a place, or many that do not feel each other.
class Alone final : public Described<MadeStart, Alone> {
 public:
  static constexpr std::string_view word = "none",
                                    text = "one grain at a place, or independent ones along the line";
  std::optional<double> x, y, height;

  template <class Archive>
  void describe(Archive& a) {
    a.value("x", x,
            "place along the line; default above the first gap, or, of independent grains, evenly along it");
    a.value("y", y, "3D: place across; default as x, or 0 above a line");
    a.value("height", height, "of the centre; default a twentieth of a bead's radius above touching");
    describe_velocities(a);
  }
  std::optional<Refusal> misfit(const Opening& opening) const override;
  std::vector<Launch> begin(const Opening& opening) const override;
};

}  // namespace chute::starts
