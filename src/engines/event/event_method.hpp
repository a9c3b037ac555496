#pragma once
#include "engines/kind/walton_keys.hpp"

namespace chute::event {

/// `engine.method = "event"`.
class EventMethod final : public Described<engines::Method, EventMethod>, public engines::WaltonKeys {
 public:
  static constexpr std::string_view word = "event",
                                    text = "event-driven molecular dynamics of hard grains (2.1.3)";
  std::optional<double> contact_time, restitution_velocity;
  double restitution_exponent = 0.2;

  template <class Archive>
  void describe(Archive& a) {
    describe_walton(a);
    a.value(
        "contact_time", contact_time, non_negative,
        "t_c below which collisions of a pair are elastic, against collapse; 0: none; default t_n of [contact]");
    a.value("restitution_velocity", restitution_velocity, positive,
            "v_0 at which e_n holds: e_n(v) = 1 − (1 − e_n)(v/v_0)^δ");
    if (restitution_velocity) a.value("restitution_exponent", restitution_exponent, positive, "δ");
    describe_tick(a);
  }
  Offers offers() const override;
  double step(const engines::Setting& setting) const override { return tick(setting); }
  std::vector<Fact> facts(const engines::Setting& setting) const override;
  std::unique_ptr<Engine> make(World<2> world, const engines::Setting& setting, int threads) const override;
  std::unique_ptr<Engine> make(World<3> world, const engines::Setting& setting, int threads) const override;
};

}  // namespace chute::event
