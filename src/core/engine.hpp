#pragma once
#include <cstdint>
#include <iosfwd>
#include <vector>

#include "core/grains.hpp"

namespace chute {

/// Where the energy is and where it went, since the start of the run. What gravity put in is what is stored
/// plus what was dissipated; `residual` is what the integration got wrong.
struct EnergyAccount {
  double translation = 0;   ///< ½ Σ m v²
  double rotation = 0;      ///< ½ Σ I ω²
  double elastic = 0;       ///< stored in contacts
  double gravity_work = 0;  ///< Σ m g·(way since the start)
  double normal_loss = 0;   ///< taken by normal contact forces
  double shear_loss = 0;    ///< taken by tangential contact forces
  double start = 0;         ///< translation + rotation + elastic at the start

  double stored() const { return translation + rotation + elastic; }
  double residual() const { return gravity_work - (stored() - start) - normal_loss - shear_loss; }
};

/// The begin of a contact, as it was just before any force acted. `bead` is the grain that was hit: the fixed
/// one, or of two moving grains the one with the lower id.
struct Impact {
  double time;
  std::int64_t grain, bead;
  std::array<double, 3> place;  ///< where the surfaces met
  double gamma;  ///< angle between the incline's normal and the line from bead to grain; > 0 downhill
  double phi;    ///< azimuth of that line about the incline's normal; 0 or ±π side in 3D, 0 in 2D
  double v_n;    ///< relative normal velocity (1.13), < 0 on approach
  double v_t;    ///< relative translational velocity along the surface, downhill positive in 2D
};

/// A contact at one instant.
struct ContactRecord {
  std::int64_t i, j;
  double overlap, normal_force, shear_force;
};

/// Anything that moves grains through time.
class Engine {
 public:
  virtual ~Engine() = default;

  /// Moves on to the given number of steps since the start. WorkError if the run leaves physics (NaN, a grain
  /// lost, too deep an overlap): it says which grain and when.
  virtual void advance_to(std::int64_t step) = 0;

  virtual std::int64_t step() const = 0;
  virtual double time_step() const = 0;
  double time() const { return static_cast<double>(step()) * time_step(); }

  virtual GrainsView grains() const = 0;
  virtual EnergyAccount energy() const = 0;
  virtual std::vector<ContactRecord> contacts() const = 0;

  /// Collecting impacts costs a little; it is off until asked for. Taking them empties the engine's list.
  virtual void collect_impacts(bool on) = 0;
  virtual std::vector<Impact> take_impacts() = 0;

  /// The complete state, such that a restored engine goes on to the same bytes.
  virtual void save(std::ostream& out) const = 0;
  virtual void restore(std::istream& in) = 0;
};

}  // namespace chute
