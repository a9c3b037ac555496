#pragma once
#include "starts/launch_keys.hpp"

namespace chute::starts {

/// Grains that fill the space between two heights densely and at random: thrown in without regard to each other, then pushed apart
/// until none overlap. For flows that are sheared without gravity, or between walls, which settle nowhere.
class Pressed final : public Described<MadeStart, Pressed> {
 public:
  static constexpr std::string_view
      word = "pressed",
      text = "random places between two heights, pushed apart: dense without gravity";
  double low = 0, high = 0;

  template <class Archive>
  void describe(Archive& a) {
    a.required("low", low, "height above which grains lie, all of them");
    a.required("high", high, "and below which");
    a.check(!Archive::reading || high > low, "high", "must be above low");
    describe_velocities(a);
  }
  std::optional<Refusal> misfit(const Opening& opening) const override;
  std::vector<Launch> begin(const Opening& opening) const override;
};

}  // namespace chute::starts
