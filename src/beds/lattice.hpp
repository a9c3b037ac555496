#pragma once
#include <array>
#include <cmath>

#include "beds/bed.hpp"

namespace chute::beds {

/// Beads glued to a plane on a square or triangular lattice, at height 0.
class Lattice final : public Described<Bed, Lattice> {
 public:
  static constexpr std::string_view word = "lattice", text = "a plane of beads on a lattice (3D)";
  enum class Arrangement { square, triangular } arrangement = Arrangement::square;
  static constexpr std::array<std::string_view, 2> arrangements{"square", "triangular"};
  std::int64_t count = 20, count_across = 10;
  double gap = 0;  ///< ε, as in Row

  template <class Archive>
  void describe(Archive& a) {
    describe_diameter(a);
    a.choice("arrangement", arrangement, arrangements, "rows of beads behind each other, or shifted by half");
    a.required("count", count, between(3, 1e5), "beads in a row, along x");
    a.required("count_across", count_across, between(2, 1e5), "rows, along y; even where they are shifted");
    a.value("gap", gap, between(0, 10), "ε: neighbours' surfaces are 2εr apart");
    a.check(arrangement == Arrangement::square || count_across % 2 == 0, "count_across",
            "must be even, so that shifted rows repeat");
  }
  std::optional<Refusal> misfit(const Site& site) const override {
    if (site.dimensions == 3) return {};
    return Refusal{"bed.kind", "\"lattice\" is a plane of beads: it needs dimensions = 3"};
  }
  Ground lay(const Site&) const override {
    const bool shifted = arrangement == Arrangement::triangular;
    const double step = diameter * (1 + gap), across = shifted ? step * std::sqrt(0.75) : step;
    Ground ground;
    for (std::int64_t row = 0; row < count_across; ++row)
      for (std::int64_t i = 0; i < count; ++i) {
        const double shift = shifted && row % 2 == 1 ? 0.75 : 0.25;
        ground.beads.push_back({(static_cast<double>(i) + (shifted ? shift : 0.5)) * step,
                                (static_cast<double>(row) + 0.5) * across, 0, diameter / 2});
      }
    ground.length = static_cast<double>(count) * step;
    ground.width = static_cast<double>(count_across) * across;
    ground.spacing = ground.widest_spacing = step;
    return ground;
  }
};

}  // namespace chute::beds
