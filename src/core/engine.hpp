#pragma once
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "core/avalanche.hpp"
#include "core/contact.hpp"
#include "core/flush_subnormals.hpp"
#include "core/grains.hpp"
#include "core/impact.hpp"

namespace chute {

/// Where the energy is and where it went, since the start of the run. What gravity put in is what is stored
/// plus what was dissipated; `residual` is what the integration got wrong.
struct EnergyAccount {
  double translation = 0;      ///< ½ Σ m v²
  double rotation = 0;         ///< ½ Σ I ω²
  double elastic = 0;          ///< stored in contacts
  double gravity_work = 0;     ///< Σ m g·(way since the start)
  double normal_loss = 0;      ///< taken by normal contact forces
  double shear_loss = 0;       ///< taken by tangential contact forces
  double wall_work = 0;        ///< done on the grains by walls that move
  double projection_work = 0;  ///< potential energy that moving rigid grains out of each other put in
  double inflow = 0;           ///< that grains brought which came in
  double outflow = 0;          ///< that grains took away which left
  double start = 0;            ///< translation + rotation + elastic at the start

  double stored() const { return translation + rotation + elastic; }
  double residual() const {
    return gravity_work + wall_work + projection_work + inflow - outflow - (stored() - start) - normal_loss -
           shear_loss;
  }

  /// Adds what places and velocities tell: the energies of motion, and gravity's work since the moving grains
  /// were at `start_place` (counted on through the periods).
  template <int D>
  void add_motion(const GrainsView& now, const Vec<D>& gravity, std::span<const Array> start_place) {
    for (std::size_t i = 0; i < now.moving; ++i) {
      for (int k = 0; k < D; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        const double v = now.velocity[axis][i];
        translation += 0.5 * now.mass[i] * v * v;
        gravity_work += now.mass[i] * gravity[k] * (now.unwrapped(i, axis) - start_place[axis][i]);
      }
      for (std::size_t k = 0; k < turns<D>; ++k)
        rotation += 0.5 * now.inertia[i] * now.spin[k][i] * now.spin[k][i];
    }
  }

  template <class Archive>
  void serialize(Archive& a) {
    a(translation, rotation, elastic, gravity_work, normal_loss, shear_loss, wall_work, projection_work,
      inflow, outflow, start);
  }
};

/// Anything that moves grains.
class Engine {
 public:
  virtual ~Engine() = default;

  /// Moves on to the given number of steps since the start. WorkError if the run leaves physics (NaN, a grain
  /// lost, too deep an overlap): it says which grain and when.
  void advance_to(std::int64_t step) {
    const FlushSubnormals while_stepping;
    advance(step);
  }

  virtual std::int64_t step() const = 0;
  virtual double time_step() const = 0;
  double time() const { return static_cast<double>(step()) * time_step(); }

  virtual GrainsView grains() const = 0;
  /// What pictures show: the grains, or the spheres that each of them is made of, with the array `body` that tells of which.
  virtual GrainsView drawn() const { return grains(); }
  virtual EnergyAccount energy() const = 0;
  /// What touches now. Of hard grains those that touch for a while, with their mean forces.
  virtual std::vector<Contact> contacts() const = 0;

  /// Collecting costs a little; it is off until asked for. Taking empties the engine's list.
  virtual void collect_impacts(bool) {}
  virtual std::vector<Impact> take_impacts() { return {}; }
  /// The ends of contacts, collected with their begins.
  virtual std::vector<Parting> take_partings() { return {}; }
  /// Of hard grains: every collision, in order of time, as stresses and networks need them.
  virtual void collect_collisions(bool) {}
  virtual std::vector<Collision> take_collisions() { return {}; }

  /// Of piles: every avalanche since it was last taken.
  virtual void collect_avalanches(bool) {}
  virtual std::vector<Avalanche> take_avalanches() { return {}; }

  /// Numbers of its own that the method tells with every row of the series (iterations, acceptance …): always the
  /// same names.
  virtual std::vector<std::pair<std::string, double>> tells() const { return {}; }

  /// The complete state, such that a restored engine goes on to the same bytes.
  virtual void save(std::ostream& out) const = 0;
  virtual void restore(std::istream& in) = 0;

 protected:
  [[noreturn]] void leave_physics(const std::string& what) const {  ///< WorkError; `what`: the likely cause
    throw WorkError(fmt::format("the run left physics at t = {:.6g} (step {}): {}", now(), step(), what));
  }
  [[noreturn]] void leave_physics(std::size_t grain, const std::string& what) const {
    leave_physics(fmt::format("grain {}: {}", grain, what));
  }
  /// A method that moves in steps may pass over what lies between: a grain that goes `way` in one, and may go `safe`, in
  /// mean diameters.
  [[noreturn]] void moved_too_far(std::size_t grain, double way, double safe) const {
    leave_physics(grain, std::isnan(way)
                             ? "its place is not a number"
                             : fmt::format("it moves {:.3g} diameters in a step, more than {} that are safe: "
                                           "give a shorter engine.time_step",
                                           way, safe));
  }

 private:
  /// The time of what is being done: an engine that goes from event to event is ahead of its last step.
  virtual double now() const { return time(); }
  virtual void advance(std::int64_t step) = 0;
};

}  // namespace chute
