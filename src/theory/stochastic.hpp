#pragma once
#include <cstdint>
#include <optional>

#include "core/random.hpp"
#include "core/vec.hpp"

/// The stochastic model of Batrouni et al., thesis 4.1.3: a ball on a line of beads whose contact angles are
/// drawn at random. One consistent system of units, angles in radians, x downhill and z away from the line.
namespace chute::theory {

/// How friction changes the velocity v_t along the bead, (4.7): v_t' = e_t v_t. Either way e_t stays at the
/// sticking value −β where the formula falls below it, and ψ_i counts positive.
enum class Friction {
  published,  ///< (4.8), e_t = 1 − 7/2 (1 + e_n) μ/ψ_i: wrong, for it takes the whole change of slip from v_t
  without_rotation,  ///< (4.9), e_t = 1 − (1 + e_n) μ/ψ_i: right for a ball that cannot turn
};

struct StochasticModel {
  double ball_radius = 4e-3;    ///< R
  double bead_radius = 0.5e-3;  ///< r
  double gap = 0;               ///< ε
  double theta = 0.1;
  double gravity = 9.81;
  double restitution = 0.9;  ///< e_n
  double friction = 0.142;   ///< μ
  double beta = 0.45;        ///< β
  Friction law = Friction::published;
  /// The drawing (4.18) takes every γ up to φ for possible. Above γ_max (4.21) the next bead is in the way,
  /// though, and the ball descends far more steeply than γ_max most of the time. True: such a ball hits that
  /// next bead instead, at the angle that the geometry gives; published: false.
  bool shadowed = false;

  /// Velocity just after an impact at γ, (4.10), (4.11), of one just before it.
  Vec<2> after_impact(const Vec<2>& v, double gamma) const;

  /// Time of flight after an impact at γ that left the ball with `v`, v[0] > 0: (4.14) with v_z(k+1) =
  /// −v_z'(k) for γ < 0; (4.15) with 2r(1 + ε) for γ ≥ 0. A ball that would still be rising at the next bead
  /// flies past it: its time is (4.14) too. The thesis does not say what happens then; without this the next
  /// impact would come from below.
  double flight_time(const Vec<2>& v, double gamma) const;

  /// The contact angle of a ball that comes down with `v`; u even in [0, 1]. (4.18) with (4.19) corrected to
  /// r/sin φ, and φ (4.17) the angle of descent: then γ = φ − arccos(1 − 2u (1+ε)/(1+Φ) sin φ), the impact
  /// offset is uniform, and its bounds are (4.16) and φ; less if `shadowed`.
  double contact_angle(const Vec<2>& v, double u) const;
};

/// One impact and the flight after it.
struct Hop {
  double gamma, v_n, v_t;  ///< angle, and velocities just before
  Vec<2> before, after;    ///< velocities
  double time;             ///< of the flight
  Vec<2> way;  ///< flown; a flight need not end at the height where it began: the model has no bed
};

/// The ball on its way: v(k+1) = K(γ) v(k) + g τ, (4.13).
class StochasticWalk {
 public:
  /// `velocity` just before the first impact: v_x > 0, v_z < 0.
  StochasticWalk(const StochasticModel& model, const Vec<2>& velocity) : model_(model), velocity_(velocity) {}

  /// The next impact; nothing, now and from now on, if the ball is trapped: the impact leaves v_x' ≤ 0.
  std::optional<Hop> hop(Random& random);

  const Vec<2>& velocity() const { return velocity_; }  ///< just before the next impact
  void restore(const Vec<2>& velocity, bool trapped) { velocity_ = velocity, trapped_ = trapped; }
  bool trapped() const { return trapped_; }

 private:
  StochasticModel model_;
  Vec<2> velocity_;
  bool trapped_ = false;
};

/// Mean velocity along the line, per time.
struct StochasticMean {
  double velocity = 0, error = 0;  ///< the error is that of block averages
  bool trapped = false;            ///< before the hops were done
  bool accelerates = false;        ///< no steady state: it goes on getting faster
};
StochasticMean mean_velocity(const StochasticModel& model, std::uint64_t seed, std::int64_t hops);

}  // namespace chute::theory
