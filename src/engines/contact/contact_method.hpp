#pragma once
#include <array>

#include "engines/contact/touching.hpp"
#include "engines/kind/walton_keys.hpp"

namespace chute::contact {

/// `engine.method = "contact"`.
class ContactMethod final : public Described<engines::Method, ContactMethod>, public engines::WaltonKeys {
 public:
  static constexpr std::string_view word = "contact", text = "contact dynamics of rigid grains (2.2)";
  static constexpr std::array<std::string_view, 2> impacts_words{"walton", "moreau"},
      solver_words{"nsgs", "exact"};
  std::optional<double> static_friction, impact_velocity, stick_velocity;
  Impacts impacts = Impacts::walton;
  SolverKind solver = SolverKind::nsgs;
  double tolerance = 1e-6, relaxation = 0.2;
  std::int64_t iterations = 1000;

  template <class Archive>
  void describe(Archive& a) {
    describe_walton(a);
    a.value("static_friction", static_friction, non_negative,
            "μ_s ≥ μ of contacts that stick; default the same as μ");
    a.choice("impacts", impacts, impacts_words,
             "fast approaches: one collision after the other (2.22)-(2.31), or all in one problem");
    a.value("impact_velocity", impact_velocity, non_negative,
            "approaches that are faster bounce; default 4 g times the time step");
    a.value("stick_velocity", stick_velocity, non_negative,
            "slips that are slower are none; default 1e-6 √(g d)");
    a.value("time_step", time_step, positive, "h; default 0.01 √(d/g)");
    a.choice("solver", solver, solver_words,
             "projected Gauss-Seidel; or the thesis's iteration over states, up to 200 contacts");
    a.value("tolerance", tolerance, positive, "of the residual of all contacts, in h m g √N");
    a.value("iterations", iterations, between(1, 1e9),
            "sweeps in a step at most; what is left is told, not hidden");
    a.value("relaxation", relaxation, unit_interval, "part of an overlap that a step takes away");
    // What only other methods use is understood: a scene changes its method with one key.
    for (const char* other : {"steps_per_contact", "integrator", "deepest_overlap", "contact_time"})
      a.ignored(other);
  }
  Offers offers() const override;
  std::optional<Refusal> refusal(const engines::Setting& setting) const override;
  double step(const engines::Setting& setting) const override;
  std::vector<Fact> facts(const engines::Setting& setting) const override;
  double seconds_per_step(const engines::Setting& setting) const override;
  std::unique_ptr<Engine> make(World<2> world, const engines::Setting& setting, int threads) const override;
  std::unique_ptr<Engine> make(World<3> world, const engines::Setting& setting, int threads) const override;
};

}  // namespace chute::contact
