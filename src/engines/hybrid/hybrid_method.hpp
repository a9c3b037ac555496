#pragma once
#include "engines/kind/walton_keys.hpp"

namespace chute::hybrid {

/// `engine.method = "hybrid"`.
class HybridMethod final : public Described<engines::Method, HybridMethod>, public engines::WaltonKeys {
 public:
  static constexpr std::string_view word = "hybrid", text = "hard grains in time steps (2.1.4)";
  /// A further thread pays for so many moving grains.
  static constexpr std::int64_t grains_per_thread = 5000;
  std::optional<double> restitution_velocity;
  double restitution_exponent = 0.2, relaxation = 0.9;
  std::int64_t collisions_per_step = 8;

  template <class Archive>
  void describe(Archive& a) {
    describe_walton(a);
    a.value("restitution_velocity", restitution_velocity, positive,
            "v_0 at which e_n holds: e_n(v) = 1 − (1 − e_n)(v/v_0)^δ");
    if (restitution_velocity) a.value("restitution_exponent", restitution_exponent, positive, "δ");
    a.value("time_step", time_step, positive,
            "default such that the fastest grain of the start moves 0.02 d, and g Δt² ≤ 1e-3 d");
    a.value("collisions_per_step", collisions_per_step, between(1, 1000),
            "of one pair; what is left waits for the next step");
    a.value("relaxation", relaxation, unit_interval,
            "part of an overlap of pressed grains that a step takes away");
    // What only other methods use is understood: a scene changes its method with one key.
    for (const char* other : {"steps_per_contact", "integrator", "deepest_overlap", "contact_time"})
      a.ignored(other);
  }
  Offers offers() const override;
  double step(const engines::Setting& setting) const override;
  std::vector<Fact> facts(const engines::Setting& setting) const override;
  double seconds_per_step(const engines::Setting& setting) const override;
  std::unique_ptr<Engine> make(World<2> world, const engines::Setting& setting, int threads) const override;
  std::unique_ptr<Engine> make(World<3> world, const engines::Setting& setting, int threads) const override;
};

}  // namespace chute::hybrid
