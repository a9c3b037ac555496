#pragma once
#include <optional>

/// The steady motion of a ball that rolls down a line of fixed beads without bouncing or slipping,
/// thesis 4.2.5: the limit e_n = 0, μ → ∞. Angles in radians, γ from the incline's normal, positive on a
/// bead's downhill side; everything else in one consistent system of units.
namespace chute::theory {

/// The line and the ball. WorkError from every function below if Φ or r is not positive, ε or g is negative,
/// or the ball falls through the gap (1 + ε > 1 + Φ).
struct Line {
  double size_ratio = 1;  ///< Φ = R/r
  double gap = 0;         ///< ε: neighbouring beads are 2εr apart. Of a disordered line the mean, (4.52)
  double radius = 5e-3;   ///< r, of the beads
  double gravity = 9.81;  ///< g
  double inertia = 0.4;   ///< I/(mR²): 2/5 for a solid sphere, 1/2 for a disc

  double effective_mass() const { return 1 + inertia; }         ///< m_eff/m, below (4.29)
  double centres() const { return radius * (1 + size_ratio); }  ///< R + r
};

/// The closed form as the thesis prints it, and as it should be:
/// - printed: energy is kept while the spin adjusts in an impact, e_t from (4.44), and the way per bead is
///   the arc 2(R+r)γ_max of (4.47);
/// - corrected: the sticking impulse dissipates, what is kept is the angular momentum about the contact,
///   e_t = (m cos 2γ_max + I/R²)/m_eff; and the way along the line is 2r(1+ε) = 2(R+r) sin γ_max.
enum class Version { printed, corrected };

/// γ_max, (4.21): where the ball leaves one bead and meets the next.
double largest_angle(const Line& line);

/// e_t: tangential velocity after over before the impact at −γ_max, (4.44) or corrected. Not positive, when
/// corrected and γ_max is so large that the impact throws the ball back.
double impact_ratio(const Line& line, Version version);

/// One passage over a bead in the steady state.
struct Passage {
  double gamma_max;
  double v_before;       ///< of the ball's centre, at γ_max, just before the impact with the next bead
  double v_after;        ///< just after it, e_t v_before
  double duration;       ///< T, (4.48)
  double mean_velocity;  ///< v̄_x, (4.47)
  double
      least_contact;  ///< normal force at γ_max in units of mg. Negative: a real ball would lift off before
};

/// Nothing if there is no steady state: the ball stops below θ_AB. 0 < θ < π/2.
std::optional<Passage> steady_passage(const Line& line, double theta, Version version);

/// v̄_x to leading order, (4.55) with rg → rg(1+ε). Corrected, the bracket is 1/sin²γ_max − 1/3 − m/m_eff: the
/// same expansion of the corrected e_t and way. Both are right to O(sin²γ_max) for θ ≫ θ_AB.
double linear_velocity(const Line& line, double theta, Version version);

/// θ_AB, (4.62) with (4.60), (4.61): the mean gap sets the speed, the largest gap `gap_max` must be overcome.
/// An ordered line has gap_max = line.gap, which gives (4.63). WorkError if gap_max < line.gap.
double boundary_ab(const Line& line, double gap_max, Version version);
inline double boundary_ab(const Line& line, Version version) { return boundary_ab(line, line.gap, version); }

/// Inclination at which the ball lifts off at γ_max, where the theory ends: least_contact = 0.
double lift_off_angle(const Line& line, Version version);

}  // namespace chute::theory
