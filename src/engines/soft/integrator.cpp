#include "engines/soft/integrator.hpp"

#include <cstdint>
#include <limits>

namespace chute::soft {
namespace {

/// One degree of freedom of all moving grains: place r, its derivatives, and the force that drives it. Turns in space
/// have no r: their orientation is no sum of turns (see Turner).
struct Column {
  double *r, *v, *a, *b, *c, *force;
  const double* inverse_inertia;
  double gravity;
  double lower, upper;  ///< Periodic: places outside [lower, upper) are told of
  Part range;
  std::int64_t* outside;
};

/// c_0 = 19/90, c_1 = 3/4, c_2 = 1, c_3 = 1/2, c_4 = 1/12 (2.14), turned into weights of Δa for plain
/// derivatives.
struct Weights {
  double r, v, b, c;
  explicit Weights(double dt)
      : r(19.0 / 90 * dt * dt / 2), v(3.0 / 4 * dt / 2), b(1.0 / 2 * 3 / dt), c(1.0 / 12 * 12 / (dt * dt)) {}
};

template <bool Correct, bool Predict, bool Periodic, bool Placed>
struct Gear5 {
  Column column;
  double h, h2, h3, h4;
  Weights weight;

  Gear5(const Column& of, double dt)
      : column(of), h(dt), h2(dt * dt / 2), h3(dt * dt * dt / 6), h4(dt * dt * dt * dt / 24), weight(dt) {}

  void operator()() const {
    const auto [r, v, a, b, c, force, inverse_inertia, g, lower, upper, range, outside] = column;
    const auto [begin, end] = range;
    const auto [to_r, to_v, to_b, to_c] = weight;
    const double t = h, t2 = h2, t3 = h3, t4 = h4;
    std::int64_t any = 0;
    CHUTE_VECTOR_LOOP
    for (std::size_t i = begin; i < end; ++i) {
      double ri = 0, vi = v[i], ai = a[i], bi = b[i], ci = c[i];
      if constexpr (Placed) ri = r[i];
      if constexpr (Correct) {
        const double delta = force[i] * inverse_inertia[i] + g - ai;  // (2.12)
        ri += to_r * delta;
        vi += to_v * delta;
        ai += delta;
        bi += to_b * delta;
        ci += to_c * delta;
        c[i] = ci;
      }
      if constexpr (Predict) {  // (2.11)
        ri = ri + t * vi + t2 * ai + t3 * bi + t4 * ci;
        vi = vi + t * ai + t2 * bi + t3 * ci;
        ai = ai + t * bi + t2 * ci;
        bi = bi + t * ci;
        if constexpr (Periodic) any |= (ri < lower) | (ri >= upper);
        force[i] = 0;
      }
      if constexpr (Placed) r[i] = ri;
      v[i] = vi;
      a[i] = ai;
      b[i] = bi;
    }
    *outside = any;
  }
};

template <bool Correct, bool Predict, bool Periodic, bool Placed>
struct VelocityVerlet {
  Column column;
  double dt;

  void operator()() const {
    const auto [r, v, a, b, c, force, inverse_inertia, g, lower, upper, range, outside] = column;
    const auto [begin, end] = range;
    const double h = dt, half = dt / 2;
    std::int64_t any = 0;
    CHUTE_VECTOR_LOOP
    for (std::size_t i = begin; i < end; ++i) {
      double ri = 0, vi = v[i], ai = a[i];
      if constexpr (Placed) ri = r[i];
      if constexpr (Correct) {
        ai = force[i] * inverse_inertia[i] + g;
        vi += half * ai;
        a[i] = ai;
      }
      if constexpr (Predict) {
        vi += half * ai;
        ri += h * vi;
        if constexpr (Placed) r[i] = ri;
        if constexpr (Periodic) any |= (ri < lower) | (ri >= upper);
        force[i] = 0;
      }
      v[i] = vi;
    }
    *outside = any;
  }
};

template <bool Correct, bool Predict, bool Periodic, bool Placed>
void advance(Isa isa, Scheme scheme, const Column& column, double dt) {
  if (scheme == Scheme::gear5)
    run_kernel(isa, Gear5<Correct, Predict, Periodic, Placed>(column, dt));
  else
    run_kernel(isa, VelocityVerlet<Correct, Predict, Periodic, Placed>{column, dt});
}

/// Turns grains in space by one step with the spin of its middle, from the spin after the step: ω − ½ dt α where the
/// spin is that of the step's end (gear5), ω where it is that of the middle (verlet). The turn about ω is the quaternion
/// (1 − h², 2h)/(1 + h²) with h = ω dt/4, Cayley's, a unit quaternion without roots or sines; its angle is ω dt but for
/// (ω dt)³/48.
struct Turner {
  std::array<double*, 4> q;
  std::array<const double*, 3> spin, angular_acceleration;
  double quarter, back;  // dt/4; how far back the middle is, dt/2 or 0
  Part range;

  void operator()() const {
    const auto [w, x, y, z] = q;
    const auto omega = spin, alpha = angular_acceleration;
    const double t = quarter, until = back;
    const auto [begin, end] = range;
    CHUTE_VECTOR_LOOP
    for (std::size_t i = begin; i < end; ++i) {
      double h[3], square = 0;
      for (int k = 0; k < 3; ++k) {
        h[k] = t * (omega[k][i] - until * alpha[k][i]);
        square += h[k] * h[k];
      }
      const double scale = 1 / (1 + square), c = (1 - square) * scale, s = 2 * scale;
      const Vec<4> turn{{c, s * h[0], s * h[1], s * h[2]}};
      const Vec<4> after = quaternion_product(turn, {{w[i], x[i], y[i], z[i]}});
      w[i] = after[0];
      x[i] = after[1];
      y[i] = after[2];
      z[i] = after[3];
    }
  }
};

}  // namespace

template <int D>
Integrator<D>::Integrator(Scheme scheme, double time_step, const Vec<D>& gravity, const Domain<D>& domain,
                          Isa isa, bool turns)
    : scheme_(scheme), dt_(time_step), gravity_(gravity), domain_(domain), isa_(isa), turns_(turns) {}

template <int D>
void Integrator<D>::start(Grains<D>& grains, const GrainSums<D>& sums) {
  const std::size_t orders = scheme_ == Scheme::gear5 ? 3 : 1;
  for (std::size_t order = 0; order < orders; ++order)
    for (auto& column : derivatives_[order]) column.assign(grains.moving, 0.0);
  for (int k = 0; k < degrees; ++k) {
    const bool shift = k < D;
    const auto& drive = shift ? sums.force[k] : sums.torque[k - D];
    const auto& inverse = shift ? grains.inverse_mass : grains.inverse_inertia;
    for (std::size_t i = 0; i < grains.moving; ++i)
      derivatives_[0][k][i] = drive[i] * inverse[i] + (shift ? gravity_[k] : 0);
  }
}

template <int D>
template <bool Correct, bool Predict>
void Integrator<D>::pass(Grains<D>& grains, GrainSums<D>& sums, Part range) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (int k = 0; k < degrees; ++k) {
    const bool shift = k < D, periodic = shift && domain_.periodic(k);
    std::int64_t outside = 0;
    double* placed = nullptr;
    if (shift)
      placed = grains.position[k].data();
    else if constexpr (D == 2)
      placed = grains.orientation[0].data();
    const Column column{placed,
                        shift ? grains.velocity[k].data() : grains.spin[k - D].data(),
                        derivatives_[0][k].data(),
                        derivatives_[1][k].data(),
                        derivatives_[2][k].data(),
                        shift ? sums.force[k].data() : sums.torque[k - D].data(),
                        shift ? grains.inverse_mass.data() : grains.inverse_inertia.data(),
                        shift ? gravity_[k] : 0.0,
                        periodic ? domain_.lower[k] : -infinity,
                        periodic ? domain_.lower[k] + domain_.length[k] : infinity,
                        range,
                        &outside};
    if (periodic)
      advance<Correct, Predict, true, true>(isa_, scheme_, column, dt_);
    else if (placed)
      advance<Correct, Predict, false, true>(isa_, scheme_, column, dt_);
    else
      advance<Correct, Predict, false, false>(isa_, scheme_, column, dt_);
    if (outside) wrap(grains, range, k);
  }
  if constexpr (Predict && D == 3)
    if (turns_) turn(grains, range);
}

template <int D>
void Integrator<D>::turn(Grains<D>& grains, Part range) const {
  if constexpr (D == 3) {
    Turner turner{{}, {}, {}, dt_ / 4, scheme_ == Scheme::gear5 ? dt_ / 2 : 0.0, range};
    for (std::size_t k = 0; k < 4; ++k) turner.q[k] = grains.orientation[k].data();
    for (std::size_t k = 0; k < 3; ++k)
      turner.spin[k] = grains.spin[k].data(), turner.angular_acceleration[k] = derivatives_[0][D + k].data();
    run_kernel(isa_, turner);
  }
}

template <int D>
void Integrator<D>::wrap(Grains<D>& grains, Part range, int k) const {
  const double lower = domain_.lower[k], length = domain_.length[k];
  for (std::size_t i = range.begin; i < range.end; ++i) {
    double& x = grains.position[k][i];
    if (x < lower) x += length, --grains.wraps[k][i];
    if (x >= lower + length) x -= length, ++grains.wraps[k][i];
  }
}

template <int D>
void Integrator<D>::predict(Grains<D>& grains, GrainSums<D>& sums, Team& team) {
  team.split(grains.moving, [&](Part range, std::size_t) { pass<false, true>(grains, sums, range); });
}
template <int D>
void Integrator<D>::correct(Grains<D>& grains, GrainSums<D>& sums, Team& team) {
  team.split(grains.moving, [&](Part range, std::size_t) { pass<true, false>(grains, sums, range); });
}
template <int D>
void Integrator<D>::correct_and_predict(Grains<D>& grains, GrainSums<D>& sums, Team& team) {
  team.split(grains.moving, [&](Part range, std::size_t) { correct_and_predict(grains, sums, range); });
}
template <int D>
void Integrator<D>::correct_and_predict(Grains<D>& grains, GrainSums<D>& sums, Part range) {
  pass<true, true>(grains, sums, range);
}

template class Integrator<2>;
template class Integrator<3>;

}  // namespace chute::soft
