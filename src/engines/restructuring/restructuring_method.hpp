#pragma once
#include <array>
#include <cmath>
#include <numbers>

#include "common/angle.hpp"
#include "engines/kind/method.hpp"
#include "engines/restructuring/restructuring_engine.hpp"

namespace chute::restructuring {

/// `engine.method = "restructuring"`.
class RestructuringMethod final : public Described<engines::Method, RestructuringMethod> {
 public:
  static constexpr std::string_view word = "restructuring",
                                    text = "grains laid one by one, bottom to top, without dynamics (2.3)";
  Rain rain = Rain::none;
  static constexpr std::array<std::string_view, 3> rains{"none", "line", "point"};
  double jolt = 0;
  std::optional<std::string> turn;  ///< as it is written
  Stabilise stabilise = Stabilise::sequential;
  static constexpr std::array<std::string_view, 2> stabilises{"sequential", "cooperative"};
  Loosening loosening;  ///< its step in mean diameters

  template <class Archive>
  void describe(Archive& a) {
    a.choice(
        "rain", rain, rains,
        "where grains come from in the first shake, in the order of their ids: from where they are, in the order of "
        "their heights; from random places; from one point");
    a.value("jolt", jolt, between(0, 10),
            "largest random shift sideways before a grain falls, in mean diameters");
    a.value("turn", turn,
            "angle, \"2 deg\" or \"0.03 rad\", by which a drum turns before every shake but the first; "
            "anticlockwise if positive");
    if (turn) {
      const auto angle = parse_angle(*turn);
      a.check(angle.has_value(), "turn", "must be an angle, \"2 deg\" or \"0.03 rad\"");
      a.check(!angle || std::abs(*angle) <= 2 * std::numbers::pi, "turn",
              "must not be more than a whole turn");
    }
    a.choice(
        "stabilise", stabilise, stabilises,
        "from the second shake on: a grain is laid on those that lie already; or among all, where they are now");
    a.value(
        "expand", loosening.expand, between(0, 10),
        "before every shake but the first heights are stretched by this part, and grains moved at random (Mehta and "
        "Barker)");
    a.value("density", loosening.density, between(0, 1), "these moves end at this packing fraction");
    a.value("sweeps", loosening.sweeps, non_negative, "and after so many trials a grain");
    a.value("step", loosening.step, positive, "longest of these moves, in mean diameters");
  }
  Offers offers() const override {
    return {.by_contact = false,
            .contacts = true,
            .walls = true,
            .only_floor = true,
            .drum = true,
            .clock = "shakes"};
  }
  std::optional<Refusal> refusal(const engines::Setting& setting) const override;
  double step(const engines::Setting&) const override { return 1; }
  std::vector<Fact> facts(const engines::Setting& setting) const override;
  double seconds_per_step(const engines::Setting& setting) const override;
  std::unique_ptr<Engine> make(World<2> world, const engines::Setting& setting, int threads) const override;
  std::unique_ptr<Engine> make(World<3> world, const engines::Setting& setting, int threads) const override;
};

}  // namespace chute::restructuring
