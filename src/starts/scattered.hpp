#pragma once
#include "starts/launch_keys.hpp"

namespace chute::starts {

/// Grains at random places above the bed, thinly enough that they find room without overlap; for methods that lay or
/// settle them. One of them may be an intruder, which lies on the bed, in the middle, below all others.
class Scattered final : public Described<MadeStart, Scattered> {
 public:
  static constexpr std::string_view word = "scattered", text = "random places above the bed, without overlap";
  double fraction = 0.2;
  std::optional<double> intruder;

  template <class Archive>
  void describe(Archive& a) {
    a.value("fraction", fraction, Range{0, 0.4, true, false},
            "packing fraction that they fill their space to");
    a.value("intruder", intruder, positive,
            "grain 0 is so many mean diameters large, material 1, and begins at the bottom");
    describe_velocities(a);
  }
  std::optional<Refusal> misfit(const Opening& opening) const override;
  std::vector<Launch> begin(const Opening& opening) const override;
};

}  // namespace chute::starts
