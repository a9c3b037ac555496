#pragma once
#include <cmath>
#include <optional>

#include "beds/bed.hpp"

namespace chute::beds {

/// A line whose roughness is a parameter: beads of any size at gaps of any width over a given length, at random heights if asked,
/// and in two layers, so that what falls into a gap does not fall through the bed.
class Rough final : public Described<Bed, Rough> {
 public:
  static constexpr std::string_view word = "rough",
                                    text = "a line of given length, with random heights or a second layer";
  double length = 30;
  double gap = 0;  ///< ε, as in Row: the least one at which a whole number of beads fits the length
  double height_std = 0;
  std::int64_t layers = 1;

  template <class Archive>
  void describe(Archive& a) {
    describe_diameter(a);
    a.required("length", length, positive, "of the line; the beads are spread evenly over it");
    a.value("gap", gap, between(0, 10),
            "ε: neighbours' surfaces are 2εr apart, or a little more, to fit the length");
    a.value("height_std", height_std, non_negative,
            "standard deviation of the beads' heights; gaussian, cut off at three of them");
    a.value("layers", layers, between(1, 2),
            "2: more beads below the gaps, as deep as these let them rise, so that none is open");
  }
  std::optional<Refusal> misfit(const Site&) const override;
  Ground lay(const Site& site) const override;
  std::vector<Fact> facts(const Site& site) const override;
  const char* length_key() const override { return "bed.length"; }

 private:
  std::int64_t count() const {
    return static_cast<std::int64_t>(std::floor(length / (diameter * (1 + gap)) * (1 + 1e-12)));
  }
};

}  // namespace chute::beds
