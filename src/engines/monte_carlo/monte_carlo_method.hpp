#pragma once
#include <array>

#include "engines/kind/method.hpp"

namespace chute::monte_carlo {

/// Refused: trial moves of this length in a domain of this size, whose unknown lengths are 0.
std::optional<Refusal> too_long(double move, const std::array<double, 3>& size);

/// `engine.method = "monte-carlo"`.
class MonteCarloMethod final : public Described<engines::Method, MonteCarloMethod> {
 public:
  static constexpr std::string_view word = "monte-carlo", text = "hard grains moved by chance (2.3)";
  /// A further thread pays for so many moving grains.
  static constexpr std::int64_t grains_per_thread = 4000;
  double temperature = 0, trial_length = 0.1;
  std::int64_t equilibrate = 0;
  enum class Order { checkerboard, serial } order = Order::checkerboard;
  static constexpr std::array<std::string_view, 2> orders{"checkerboard", "serial"};
  double lift = 0, expand = 0, settled = 1e-4;
  std::int64_t sweeps = 10000;

  template <class Archive>
  void describe(Archive& a) {
    a.value("temperature", temperature, non_negative, "T, an energy; 0: only moves that do not go up");
    a.value("step", trial_length, positive, "δ, the longest trial move, in mean diameters");
    a.value("equilibrate", equilibrate, non_negative,
            "sweeps at the begin in which δ adapts to an acceptance of 40 %");
    a.choice("order", order, orders,
             "block by block, for threads; or one grain after the other, drawn from all");
    a.value("lift", lift, between(0, 1000),
            "shakes: height by which all grains are lifted, in mean diameters");
    a.value("expand", expand, between(0, 10), "shakes: part by which heights are stretched");
    a.value("sweeps", sweeps, at_least(1), "most sweeps in a shake");
    a.value("settled", settled, non_negative,
            "a shake ends when the mean height falls by less than this in 100 sweeps, in mean diameters");
  }
  /// With `lift` or `expand` a step is a shake, else a sweep.
  bool shakes() const { return lift > 0 || expand > 0; }
  Offers offers() const override;
  std::optional<Refusal> refusal(const engines::Setting& setting) const override;
  double step(const engines::Setting&) const override { return 1; }
  std::vector<Fact> facts(const engines::Setting& setting) const override;
  double seconds_per_step(const engines::Setting& setting) const override;
  std::unique_ptr<Engine> make(World<2> world, const engines::Setting& setting, int threads) const override;
  std::unique_ptr<Engine> make(World<3> world, const engines::Setting& setting, int threads) const override;
};

}  // namespace chute::monte_carlo
