#pragma once
#include <array>

#include "engines/kind/walton_keys.hpp"
#include "theory/stochastic.hpp"

namespace chute::stochastic {

/// `engine.method = "stochastic"`.
class StochasticMethod final : public Described<engines::Method, StochasticMethod>,
                               public engines::WaltonKeys {
 public:
  static constexpr std::string_view word = "stochastic", text = "the stochastic model of one ball (4.1.3)";
  theory::Friction impact_friction = theory::Friction::published;
  static constexpr std::array<std::string_view, 2> impact_frictions{"published", "without-rotation"};
  bool shadowed = false;

  template <class Archive>
  void describe(Archive& a) {
    describe_walton(a);
    a.choice("impact_friction", impact_friction, impact_frictions, "(4.8) or (4.9)");
    a.value("shadowed", shadowed, "only angles that a ball can reach");
    describe_tick(a);
  }
  Offers offers() const override;
  std::optional<Refusal> refusal(const engines::Setting& setting) const override;
  double step(const engines::Setting& setting) const override { return tick(setting); }
  std::vector<Fact> facts(const engines::Setting& setting) const override { return walton_facts(setting); }
  std::unique_ptr<Engine> make(World<2> world, const engines::Setting& setting, int threads) const override;
  std::unique_ptr<Engine> make(World<3> world, const engines::Setting& setting, int threads) const override;
};

}  // namespace chute::stochastic
