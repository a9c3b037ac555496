#pragma once
#include <array>

#include "engines/kind/method.hpp"

namespace chute::automaton {

/// `engine.method = "automaton"`.
class AutomatonMethod final : public Described<engines::Method, AutomatonMethod> {
 public:
  static constexpr std::string_view word = "automaton",
                                    text = "grains on a lattice (2.3); time counts updates";
  enum class ModelKind { lattice_gas, pile, voids } model = ModelKind::lattice_gas;
  static constexpr std::array<std::string_view, 3> models{"lattice-gas", "pile", "voids"};
  double density = 1, dissipation = 0, gravity = 0, reversal = 0.5;  // lattice-gas
  std::optional<double> fill_low, fill_high;                         // lattice-gas, voids
  std::int64_t threshold_low = 1, threshold_high = 2;                // pile
  double probability_low = 0.5;
  std::int64_t orifice = 1;  // voids
  std::optional<double> orifice_x;
  bool refill = false;
  double small = 0, bias = 1;

  template <class Archive>
  void describe(Archive& a) {
    constexpr bool all = std::same_as<Archive, KeyLister>;
    a.choice("model", model, models,
             "movers that meet and lose energy; a rice pile; or voids that rise through a hopper");
    if (all || model == ModelKind::lattice_gas) {
      a.value("density", density, between(0, 6), "lattice-gas: mean movers of a site at the start");
      a.value("dissipation", dissipation, unit_interval,
              "lattice-gas: p, that a site loses energy if it can");
      a.value("gravity", gravity, unit_interval,
              "lattice-gas: g, that one grain of a site is accelerated; where to, incline.angle says");
      a.value("reversal", reversal, unit_interval,
              "lattice-gas: b, that movers turn back at a wall instead of being mirrored");
      a.value("fill_low", fill_low, "lattice-gas: sites above this height are filled; default all");
    }
    if (all || model != ModelKind::pile)
      a.value("fill_high", fill_high, "lattice-gas, voids: sites below this height are filled; default all");
    if (all || model == ModelKind::pile) {
      a.value("threshold_low", threshold_low, between(1, 1000), "pile: one of two slopes that a site holds");
      a.value("threshold_high", threshold_high, between(1, 1000), "pile: the other, not below");
      a.value("probability_low", probability_low, unit_interval, "pile: of the first");
      a.check(threshold_low <= threshold_high, "threshold_high", "must not be below threshold_low");
    }
    if (all || model == ModelKind::voids) {
      a.value("orifice", orifice, at_least(1), "voids: width of the opening in the lowest row, in sites");
      a.value("orifice_x", orifice_x, "voids: its middle; default that of the domain");
      a.value("refill", refill, "voids: those that reach the highest row are filled from above");
      a.value("small", small, unit_interval, "voids: part of the grains that are small");
      a.value("bias", bias, positive, "voids: how much more readily than a large one a small grain falls");
    }
  }
  bool brings_grains() const override { return true; }
  Offers offers() const override;
  double step(const engines::Setting&) const override { return 1; }
  std::vector<Fact> facts(const engines::Setting& setting) const override;
  double seconds_per_step(const engines::Setting& setting) const override;
  std::unique_ptr<Engine> make(World<2> world, const engines::Setting& setting, int threads) const override;
  std::unique_ptr<Engine> make(World<3> world, const engines::Setting& setting, int threads) const override;
};

}  // namespace chute::automaton
