#pragma once
#include <array>
#include <cmath>

#include "beds/heights.hpp"

namespace chute::beds {

/// Beads glued to a plane on a square or triangular lattice; its roughness is a parameter as that of Rough.
class Lattice final : public Described<Bed, Lattice> {
 public:
  static constexpr std::string_view
      word = "lattice",
      text = "a plane of beads on a lattice, with random heights or a second layer (3D)";
  enum class Arrangement { square, triangular } arrangement = Arrangement::square;
  static constexpr std::array<std::string_view, 2> arrangements{"square", "triangular"};
  std::int64_t count = 20, count_across = 10;
  double gap = 0;  ///< ε, as in Row
  double height_std = 0;
  std::int64_t layers = 1;

  template <class Archive>
  void describe(Archive& a) {
    describe_diameter(a);
    a.choice("arrangement", arrangement, arrangements, "rows of beads behind each other, or shifted by half");
    a.required("count", count, between(3, 1e5), "beads in a row, along x");
    a.required("count_across", count_across, between(2, 1e5), "rows, along y; even where they are shifted");
    a.value("gap", gap, between(0, 10), "ε: neighbours' surfaces are 2εr apart");
    a.value("height_std", height_std, non_negative,
            "standard deviation of the beads' heights; gaussian, cut off at three of them");
    a.value("layers", layers, between(1, 2),
            "2: a lattice of beads below the gaps, as deep as these let them rise");
    a.check(arrangement == Arrangement::square || count_across % 2 == 0, "count_across",
            "must be even, so that shifted rows repeat");
  }
  std::optional<Refusal> misfit(const Site& site) const override {
    if (site.dimensions == 3) return too_uneven(height_std, diameter);
    return Refusal{"bed.kind", "\"lattice\" is a plane of beads: it needs dimensions = 3"};
  }
  Ground lay(const Site& site) const override {
    const bool shifted = arrangement == Arrangement::triangular;
    const double step = diameter * (1 + gap), across = shifted ? step * std::sqrt(0.75) : step;
    // A gap is in the middle of four beads or of three.
    const double behind = shifted ? across / 3 : across / 2;
    const double depth =
        depth_of_second_layer(diameter, shifted ? step / std::sqrt(3.0) : step * std::sqrt(0.5));
    Ground ground;
    const double length = static_cast<double>(count) * step,
                 width = static_cast<double>(count_across) * across;
    const auto bead = [&](double x, double y, double height) {
      ground.beads.push_back({x < length ? x : x - length, y < width ? y : y - width, height, diameter / 2});
    };
    for (std::int64_t layer = 0; layer < layers; ++layer)
      for (std::int64_t row = 0; row < count_across; ++row)
        for (std::int64_t i = 0; i < count; ++i) {
          const double shift = !shifted ? 0.5 : row % 2 == 1 ? 0.75 : 0.25;
          const double x = (static_cast<double>(i) + shift) * step,
                       y = (static_cast<double>(row) + 0.5) * across;
          if (layer == 0)
            bead(x, y, height_of(site.seed, row * count + i, height_std));
          else
            bead(x + step / 2, y + behind, -depth);
        }
    ground.length = length;
    ground.width = width;
    ground.spacing = ground.widest_spacing = step;
    return ground;
  }
};

}  // namespace chute::beds
