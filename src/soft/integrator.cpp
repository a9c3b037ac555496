#include "soft/integrator.hpp"

#include <cstdint>
#include <limits>

namespace chute::soft {
namespace {

/// One degree of freedom of all moving grains: place r, its derivatives, and the force that drives it.
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

template <bool Correct, bool Predict, bool Periodic>
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
      double ri = r[i], vi = v[i], ai = a[i], bi = b[i], ci = c[i];
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
      r[i] = ri;
      v[i] = vi;
      a[i] = ai;
      b[i] = bi;
    }
    *outside = any;
  }
};

template <bool Correct, bool Predict, bool Periodic>
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
      double ri = r[i], vi = v[i], ai = a[i];
      if constexpr (Correct) {
        ai = force[i] * inverse_inertia[i] + g;
        vi += half * ai;
        a[i] = ai;
      }
      if constexpr (Predict) {
        vi += half * ai;
        ri += h * vi;
        r[i] = ri;
        if constexpr (Periodic) any |= (ri < lower) | (ri >= upper);
        force[i] = 0;
      }
      v[i] = vi;
    }
    *outside = any;
  }
};

template <bool Correct, bool Predict, bool Periodic>
void advance(Isa isa, Scheme scheme, const Column& column, double dt) {
  if (scheme == Scheme::gear5)
    run_kernel(isa, Gear5<Correct, Predict, Periodic>(column, dt));
  else
    run_kernel(isa, VelocityVerlet<Correct, Predict, Periodic>{column, dt});
}

}  // namespace

template <int D>
Integrator<D>::Integrator(Scheme scheme, double time_step, const Vec<D>& gravity, const Domain<D>& domain,
                          Isa isa)
    : scheme_(scheme), dt_(time_step), gravity_(gravity), domain_(domain), isa_(isa) {}

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
    const Column column{shift ? grains.position[k].data() : grains.angle[k - D].data(),
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
      advance<Correct, Predict, true>(isa_, scheme_, column, dt_);
    else
      advance<Correct, Predict, false>(isa_, scheme_, column, dt_);
    if (outside) wrap(grains, range, k);
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
