#pragma once
#include <array>
#include <string>

#include "engines/kind/method.hpp"
#include "engines/lammps/deck.hpp"

namespace chute::lammps {

/// `engine.method = "lammps"`.
class LammpsMethod final : public Described<engines::Method, LammpsMethod> {
 public:
  static constexpr std::string_view
      word = "lammps",
      text = "soft grains, by the program LAMMPS (Debian's package lammps), on several processes";
  enum class Integrator { verlet } integrator = Integrator::verlet;
  static constexpr std::array<std::string_view, 1> integrators{"verlet"};
  double steps_per_contact = 50;
  std::optional<double> time_step;
  std::optional<std::string> dumps;

  template <class Archive>
  void describe(Archive& a) {
    a.choice("integrator", integrator, integrators, "velocity Verlet; LAMMPS has no gear5");
    a.value("steps_per_contact", steps_per_contact, at_least(5),
            "time steps in the shortest contact time t_n");
    a.value("time_step", time_step, positive, "instead of steps_per_contact");
    a.value("dumps", dumps, "folder of dumps that LAMMPS left: it is played back, as chute import does");
    a.ignored("deepest_overlap");
  }
  Offers offers() const override;
  std::optional<Refusal> refusal(const engines::Setting& setting) const override;
  double step(const engines::Setting& setting) const override;
  std::vector<Fact> facts(const engines::Setting& setting) const override;
  double seconds_per_step(const engines::Setting& setting) const override;
  std::unique_ptr<Engine> make(World<2> world, const engines::Setting& setting, int ranks) const override;
  std::unique_ptr<Engine> make(World<3> world, const engines::Setting& setting, int ranks) const override;
};

}  // namespace chute::lammps
