#include "theory/stochastic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/estimate.hpp"
#include "core/frame.hpp"

namespace chute::theory {

Vec<2> StochasticModel::after_impact(const Vec<2>& v, double gamma) const {
  const double s = std::sin(gamma), c = std::cos(gamma);
  const double v_n = v[0] * s + v[1] * c, v_t = v[0] * c - v[1] * s;  // (4.4), (4.5)
  const double psi = std::abs(v_t / v_n);
  const double weight = law == Friction::published ? 3.5 : 1;
  const double e_t = std::max(-beta, 1 - weight * (1 + restitution) * friction / psi);  // (4.8), (4.9)
  const double n = -restitution * v_n, t = psi > 0 ? e_t * v_t : 0;                     // (4.6), (4.7)
  return {{n * s + t * c, n * c - t * s}};
}

double StochasticModel::flight_time(const Vec<2>& v, double gamma) const {
  const double pull = gravity * std::cos(theta), fall = 2 * v[1] / pull;
  if (gamma < 0) return fall;
  const double passage = 2 * bead_radius * (1 + gap) / v[0];
  return v[1] > pull * passage ? fall : passage;
}

double StochasticModel::contact_angle(const Vec<2>& v, double u) const {
  const double sin_phi = std::abs(v[1]) / norm(v), phi = std::asin(sin_phi);
  const double ratio = (1 + gap) * bead_radius / (bead_radius + ball_radius);  // sin γ_max
  double offset =
      1 - 2 * u * ratio * sin_phi;  // of the ball's line of flight from the bead's centre, over R + r
  double gamma = phi - std::acos(offset);
  while (shadowed && gamma > std::asin(ratio)) {  // seen from the next bead, the line passes that much closer
    offset -= 2 * ratio * sin_phi;
    gamma = phi - std::acos(offset);
  }
  return gamma;
}

std::optional<Hop> StochasticWalk::hop(Random& random) {
  if (trapped_) return {};
  Hop hop{};
  hop.before = velocity_;
  hop.gamma = model_.contact_angle(velocity_, random.uniform());
  hop.v_n = velocity_[0] * std::sin(hop.gamma) + velocity_[1] * std::cos(hop.gamma);
  hop.v_t = velocity_[0] * std::cos(hop.gamma) - velocity_[1] * std::sin(hop.gamma);
  hop.after = model_.after_impact(velocity_, hop.gamma);
  if (hop.after[0] <= 0) {
    trapped_ = true;
    return {};
  }
  hop.time = model_.flight_time(hop.after, hop.gamma);
  const auto g = gravity_on_incline<2>(model_.gravity, model_.theta);
  hop.way = hop.time * (hop.after + (hop.time / 2) * g);
  velocity_ = hop.after + hop.time * g;
  return hop;
}

StochasticMean mean_velocity(const StochasticModel& model, std::uint64_t seed, std::int64_t hops) {
  constexpr std::size_t blocks = 20, transient = 5;
  constexpr double runaway = 100;  // times the start: no steady state of this model comes near
  Random random(seed, Purpose::stochastic);
  const double scale = std::sqrt(model.gravity * model.ball_radius);
  StochasticWalk walk(model, {{2 * scale, -0.3 * scale}});
  StochasticMean mean;
  std::array<double, blocks> velocity{};
  double time = 0, way = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    double block_time = 0, block_way = 0;
    for (std::int64_t k = 0; k < hops / static_cast<std::int64_t>(blocks); ++k) {
      const auto hop = walk.hop(random);
      mean.trapped = !hop;
      mean.accelerates = walk.velocity()[0] > runaway * scale;
      if (mean.trapped || mean.accelerates) return mean;
      block_time += hop->time, block_way += hop->way[0];
    }
    velocity[b] = block_way / block_time;
    if (b >= transient) time += block_time, way += block_way;
  }
  mean.velocity = way / time;
  mean.error = estimate_of(std::span(velocity).subspan(transient)).error.value();
  return mean;
}

}  // namespace chute::theory
