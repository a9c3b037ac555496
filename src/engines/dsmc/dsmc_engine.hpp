#pragma once
#include <memory>

#include "core/engine.hpp"
#include "core/team.hpp"
#include "engines/dsmc/cell_collisions.hpp"
#include "engines/dsmc/gas_cells.hpp"
#include "engines/dsmc/obstacles.hpp"

namespace chute::dsmc {

/// Direct simulation Monte Carlo, thesis 2.3 (Bird 1994; Müller & Herrmann 1998): grains fly freely for a step, hitting bed and
/// walls where they are (obstacles.hpp), and then collide with partners drawn by chance from their cell
/// (cell_collisions.hpp), by Walton's operator. That is right where a grain's partners know nothing of each other: in gases,
/// not in packings.
///
/// A step: fly → sort into cells → collide → heat. It works on the grains' arrays alone, so that a grain takes about 200
/// bytes in 3D. Random numbers belong to step and cell, or step and grain; sums are of chunks of fixed size.
template <int D>
class DsmcEngine final : public Engine {
 public:
  DsmcEngine(Grains<D> grains, const DsmcSetup<D>& setup);
  DsmcEngine(const DsmcEngine&) = delete;  // its parts refer to each other
  DsmcEngine& operator=(const DsmcEngine&) = delete;

  std::int64_t step() const override { return step_; }
  double time_step() const override { return setup_.time_step; }
  GrainsView grains() const override { return view_of(grains_, no_force_, setup_.domain, time()); }
  EnergyAccount energy() const override;
  std::vector<Contact> contacts() const override { return {}; }
  void collect_impacts(bool on) override { collecting_ = on; }
  std::vector<Impact> take_impacts() override { return std::exchange(impacts_, {}); }
  void collect_collisions(bool on) override { collisions_.collect(on); }
  std::vector<Collision> take_collisions() override { return collisions_.take(); }
  std::vector<std::pair<std::string, double>> tells() const override;
  void save(std::ostream& out) const override;
  void restore(std::istream& in) override;

  const Grains<D>& state() const { return grains_; }
  const GasCells<D>& cells() const { return cells_; }
  std::int64_t collisions() const { return tally_.collisions; }

 private:
  void advance(std::int64_t step) override;
  void take_step();
  void fly();
  void fly_freely(Part part);
  void fly_among_obstacles(Part part, double end, std::size_t chunk);
  void heat();
  void check_physics();
  double gravity_potential() const;

  DsmcSetup<D> setup_;
  Grains<D> grains_;
  Obstacles<D> obstacles_;
  GasCells<D> cells_;
  CellCollisions<D> collisions_;
  std::array<Array, D> no_force_;
  Tally tally_;
  double start_energy_ = 0, start_potential_ = 0;
  std::int64_t step_ = 0, stopped_ = 0;
  bool collecting_ = false;
  std::vector<Impact> impacts_;
  struct Chunk {
    Tally tally;
    std::int64_t stopped = 0;
    std::vector<Impact> impacts;
  };
  std::vector<Chunk> chunks_;
  std::unique_ptr<Team> team_;
};

}  // namespace chute::dsmc
