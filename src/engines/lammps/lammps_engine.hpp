#pragma once
#include <filesystem>
#include <memory>
#include <optional>

#include "core/engine.hpp"
#include "core/world.hpp"
#include "engines/lammps/deck.hpp"
#include "engines/lammps/lammps_process.hpp"

namespace chute::lammps {

/// What the engine is made of besides its world.
struct LammpsSetup {
  Deck deck;
  double time_step = 0;
  int ranks = 1;
  std::filesystem::path dumps;  ///< of a run of LAMMPS's that is to be played back; empty: LAMMPS runs
};

/// Grains that LAMMPS moves: a process that is told to go on step by step of who looks, or dumps that it left (`chute export`). Places,
/// velocities, spins and forces are its own, radii and masses those of the scene. LAMMPS tells neither the energy in contacts nor what they
/// take: these are not a number. Its spheres have no orientation.
template <int D>
class LammpsEngine final : public Engine {
 public:
  LammpsEngine(World<D> world, LammpsSetup setup);

  std::int64_t step() const override { return step_; }
  double time_step() const override { return setup_.time_step; }
  GrainsView grains() const override;
  std::vector<Contact> contacts() const override;
  EnergyAccount energy() const override;
  /// With LAMMPS's restart file, so that contacts go on; not to the same bytes, for LAMMPS sums in an order of its own.
  void save(std::ostream& out) const override;
  void restore(std::istream& in) override;

 private:
  Surroundings<D> around_;
  LammpsSetup setup_;
  std::int64_t step_ = 0;
  std::array<Array, D> start_;
  std::vector<std::int64_t> steps_;  // of the dumps, when played back
  std::unique_ptr<LammpsProcess> process_;
  mutable bool began_ = false;  // has it been given the deck?
  std::string restart_;         // where it goes on from, if it does

  // As of `known_`, fetched when somebody looks.
  mutable std::int64_t known_ = -1;
  mutable Grains<D> grains_;
  mutable std::array<Array, D> force_;
  mutable std::vector<Contact> contacts_;

  void advance(std::int64_t step) override;
  void begin() const;
  void know() const;
  void take_grains(const std::filesystem::path& file) const;
  void take_contacts(const std::filesystem::path& file) const;
  std::filesystem::path frame_file(const char* stem) const;
};

}  // namespace chute::lammps
