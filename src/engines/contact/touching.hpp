#pragma once
#include <cstdint>
#include <vector>

#include "core/contact.hpp"
#include "core/world.hpp"
#include "engines/hard/hard_contact.hpp"

namespace chute::contact {

/// How grains that come in fast bounce off each other.
enum class Impacts {
  walton,  ///< one collision after the other, in the order of their times (thesis 2.2, footnote 4)
  moreau   ///< all at once: v_n⁺ + e_n v_n⁻ ≥ 0 inside the complementarity (Moreau 1994)
};

enum class SolverKind { nsgs, exact };

/// What a run of contact dynamics needs besides its grains.
template <int D>
struct ContactSetup : Surroundings<D> {
  hard::HardContact contact{};          ///< e_n and β of impacts; μ_d of all contacts
  double static_friction = 0;           ///< μ_s ≥ μ_d, of contacts that stick
  ByPair<hard::HardContact> between{};  ///< by materials; empty: these for all
  ByPair<double> static_between{};
  double time_step = 0;           ///< h
  double diameter = 1;            ///< d: what lengths are measured by
  double reference_impulse = 0;   ///< h m g of a mean grain: what residuals are measured by; 0: no gravity
  double impact_velocity = 0;     ///< approaches that are faster bounce
  double stick_velocity = 1e-12;  ///< slips that are slower are none
  double tolerance = 1e-6;
  std::int64_t iterations = 1000;
  double relaxation = 0.2;  ///< part of an overlap that a step takes away
  Impacts impacts = Impacts::walton;
  SolverKind solver = SolverKind::nsgs;
  int threads = 1;  ///< results do not depend on it
};

/// Two grains, or a grain and a wall, that touch or may do so within a step. The normal points from the partner into i,
/// as the solver has it; impulses act on i.
template <int D>
struct Touching {
  std::uint32_t i = 0, j = 0;  ///< i < j; from the number of grains on, j is a wall
  Vec<D> normal{};
  double gap = 0;       ///< at the middle of the step; overlaps are negative
  Vec<D> impulse{};     ///< of the solver, in this step
  Vec<D> hit{};         ///< of Walton's impacts, in this step
  double friction = 0;  ///< the bound |J_s| ≤ b J_n that held: μ_s or μ_d
  ContactState state = ContactState::unknown;
  bool stuck = false;        ///< at the end of the step before, and was not hit since
  bool was_pressed = false;  ///< in the step before

  double pressure() const { return dot(impulse + hit, normal); }
  bool pressed() const { return pressure() > 0; }
  bool before(const Touching& other) const { return i != other.i ? i < other.i : j < other.j; }

  template <class Archive>
  void serialize(Archive& a) {
    a(i, j, normal.c, gap, impulse.c, hit.c, friction, state, stuck);
  }
};

/// The grains in a step: where they are in its middle, and how they move.
template <int D>
struct Bodies {
  std::vector<Vec<D>> middle, velocity;
  std::vector<Vec<turns<D>>> spin;
};

/// What two that touch do at a time of the step, seen from the partner.
template <int D>
struct Relative {
  Vec<D> velocity;  ///< of i's surface less that of the partner, at the contact
  Vec<D> wall;      ///< velocity of the wall's surface there; 0 between grains
};

}  // namespace chute::contact
