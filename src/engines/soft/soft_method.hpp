#pragma once
#include <array>

#include "engines/kind/method.hpp"
#include "engines/soft/contact_ends.hpp"
#include "engines/soft/integrator.hpp"

namespace chute::soft {

/// `engine.method = "soft"`.
class SoftMethod final : public Described<engines::Method, SoftMethod> {
 public:
  static constexpr std::string_view word = "soft",
                                    text = "time-step driven molecular dynamics of soft grains (2.1.1)";
  /// A further thread pays for so many moving grains.
  static constexpr std::int64_t grains_per_thread = 2000;
  Scheme integrator = Scheme::gear5;
  static constexpr std::array<std::string_view, 2> integrators{"gear5", "verlet"};
  ContactEnds contact_ends = ContactEnds::sampled;
  double steps_per_contact = 50;
  std::optional<double> time_step;
  double deepest_overlap = 0.25;

  template <class Archive>
  void describe(Archive& a) {
    a.choice("integrator", integrator, integrators, "(2.11) to (2.14), or velocity Verlet");
    a.choice(
        "contact_ends", contact_ends, contact_ends_words,
        "how contacts count in the steps in which they begin or end: whole (as in LAMMPS), or by the part that they last");
    a.value("steps_per_contact", steps_per_contact, at_least(5),
            "time steps in the shortest contact time t_n");
    a.value("time_step", time_step, positive, "instead of steps_per_contact");
    a.value("deepest_overlap", deepest_overlap, Range{0, 1, true, false},
            "of the smaller radius; beyond it the run has left physics and stops");
  }
  Offers offers() const override;
  std::optional<Refusal> refusal(const engines::Setting& setting) const override;
  double step(const engines::Setting& setting) const override;
  std::vector<std::string> warnings(const engines::Setting& setting) const override;
  std::vector<Fact> facts(const engines::Setting& setting) const override;
  /// Part of gravity's work by which the energy account of a dense flow is off, for a decay of slip in one step; measured.
  double expected_residual(double decay) const;
  double seconds_per_step(const engines::Setting& setting) const override;
  std::unique_ptr<Engine> make(World<2> world, const engines::Setting& setting, int threads) const override;
  std::unique_ptr<Engine> make(World<3> world, const engines::Setting& setting, int threads) const override;
};

}  // namespace chute::soft
