#pragma once
#include <array>
#include <cmath>
#include <string_view>

namespace chute::soft {

/// What a contact counts in the time step in which it begins or ends.
enum class ContactEnds {
  sampled,  ///< whole: the forces are those at the end of the step, as in LAMMPS
  weighted  ///< by the part of the step that it lasted
};
inline constexpr std::array<std::string_view, 2> contact_ends_words{"sampled", "weighted"};

/// Weights for the first and the last steps of a contact.
///
/// The damping of (3.1) is there at once when grains meet, and pulls until they part. An integrator that sees the force at
/// the ends of steps only takes it to act from half a step before the first of them that lies in the contact to half a step
/// after the last: the impulse is wrong by up to half a step's at either end, and e_n scatters by γ_n δt e_n/(2 m_eff) with the
/// moment at which contacts begin. Here the forces of steps near an end have weights, which follow from the place in the
/// contact alone, so that nothing has to be remembered. All is pure arithmetic and selections, for vector loops.
///
/// With s = ξ/(|dξ/dt| δt), the steps since the contact began or until it ends, two ways:
///
/// `mean` is for laws without a memory. A step counts with the mean of its force from half a step before to half a step after,
/// of grains that move uniformly meanwhile: min(1, s + ½) of what is there at once, and the spring of the mean overlap, ½ (s + ½)²
/// |dξ/dt| δt. That holds for −½ < s < 0 too, where the grains have parted already, or not met yet: pairs so close must be among
/// those that are looked at (`apart`). It matters where a contact at rest is torn open by another impact within a step or
/// two. The damping must take γ_n times its overlap from the motion, and did not see it move before it was open.
///
/// `inside` is for laws with a memory, which begins with the contact. Instants near an end have s, s + 1, s + 2, … with 0 < s ≤ 1. What
/// the sum over them lacks of the impulse is by Euler and Maclaurin's formula −ζ(−p, s) steps' for a force ∝ s^p, with Hurwitz's
/// zeta function: s − ½ for one that is there at once (p = 0), and (s² − s + 1/6)/2 for a linear spring (p = 1). The lack is made good
/// by the two nearest instants, such that the weights are continuous functions of s, 0 at s = 0, and 1 from s = 2 on: an s
/// that is a little wrong, for the grains do not move uniformly, then does little.
class EndWeights {
 public:
  /// Off: all steps count whole.
  EndWeights() = default;
  /// With `lag` the velocities seen are that much older than the places; they are carried on by the force.
  EndWeights(double step, double lag, double apart)
      : step_(step), per_step_(1 / step), lag_(lag), apart_(apart) {}

  bool on() const { return step_ > 0; }
  /// Pairs with a smaller gap than that between their surfaces have a force too, with the weights `mean`; 0: `inside`.
  double apart() const { return apart_; }
  EndWeights inside_only() const { return {step_, lag_, 0}; }

  struct Parts {
    double at_once;  ///< weight of forces that are there at once
    double overlap;  ///< what a spring is pressed by
  };
  Parts mean(double xi, double dxi) const {
    const double way = step_ * std::abs(dxi), part = xi / way + 0.5;  // infinite at rest: whole or not at all
    const double begun = 0.5 * part * part * way, weight = part < 0 ? 0 : part;
    const double overlap = part < 0 ? 0 : begun;
    return {part < 1 ? weight : 1, part < 1 ? overlap : xi};
  }
  Parts inside(double xi, double dxi, bool linear_spring) const {
    const double speed = std::abs(dxi), s = xi * per_step_ / speed;  // infinite at rest: whole
    const double first = 1.5 * s, second = 2 - 0.5 * s, later = s < 2 ? second : 1;
    const double rise = s * (0.5 * s - 5.0 / 12), fall = (2 - s) / 12, rest = s < 2 ? fall : 0;
    const double shift = s < 1 ? rise : rest;
    return {s < 1 ? first : later, linear_spring ? xi + shift * step_ * speed : xi};
  }
  /// dξ/dt at the instant of the places, from that a lag before and the force that acts on a reduced mass.
  double closing(double dxi, double force, double m_eff) const { return dxi - lag_ * force / m_eff; }

 private:
  double step_ = 0, per_step_ = 0, lag_ = 0, apart_ = 0;
};

}  // namespace chute::soft
