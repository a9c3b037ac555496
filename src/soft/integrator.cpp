#include "soft/integrator.hpp"

#include <cstdint>

namespace chute::soft {
namespace {

/// One degree of freedom of all moving grains: place r, its derivatives, and the force that drives it.
struct Column {
  double *r, *v, *a, *b, *c;
  const double *force, *inverse_inertia;
  double gravity;
  Part range;
};

/// c_0 = 19/90, c_1 = 3/4, c_2 = 1, c_3 = 1/2, c_4 = 1/12 (2.14), turned into weights of Δa for plain
/// derivatives.
struct Weights {
  double r, v, b, c;
  explicit Weights(double dt)
      : r(19.0 / 90 * dt * dt / 2), v(3.0 / 4 * dt / 2), b(1.0 / 2 * 3 / dt), c(1.0 / 12 * 12 / (dt * dt)) {}
};

template <bool Correct, bool Predict>
struct Gear5 {
  Column column;
  double dt;

  void operator()() const {
    const auto [r, v, a, b, c, force, inverse_inertia, g, range] = column;
    const auto [begin, end] = range;
    const Weights weight(dt);
    const double h = dt, h2 = dt * dt / 2, h3 = dt * dt * dt / 6, h4 = dt * dt * dt * dt / 24;
    CHUTE_VECTOR_LOOP
    for (std::size_t i = begin; i < end; ++i) {
      double ri = r[i], vi = v[i], ai = a[i], bi = b[i], ci = c[i];
      if constexpr (Correct) {
        const double delta = force[i] * inverse_inertia[i] + g - ai;  // (2.12)
        ri += weight.r * delta;
        vi += weight.v * delta;
        ai += delta;
        bi += weight.b * delta;
        ci += weight.c * delta;
        c[i] = ci;
      }
      if constexpr (Predict) {  // (2.11)
        ri = ri + h * vi + h2 * ai + h3 * bi + h4 * ci;
        vi = vi + h * ai + h2 * bi + h3 * ci;
        ai = ai + h * bi + h2 * ci;
        bi = bi + h * ci;
      }
      r[i] = ri;
      v[i] = vi;
      a[i] = ai;
      b[i] = bi;
    }
  }
};

template <bool Correct, bool Predict>
struct VelocityVerlet {
  Column column;
  double dt;

  void operator()() const {
    const auto [r, v, a, b, c, force, inverse_inertia, g, range] = column;
    const auto [begin, end] = range;
    const double h = dt, half = dt / 2;
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
      }
      v[i] = vi;
    }
  }
};

/// Is any place outside [lower, upper)?
struct Outside {
  const double* place;
  double lower, upper;
  Part range;
  std::int64_t* any;
  void operator()() const {
    const auto x = place;
    const double low = lower, high = upper;
    const auto [begin, end] = range;
    std::int64_t found = 0;
    CHUTE_VECTOR_LOOP
    for (std::size_t i = begin; i < end; ++i) found |= (x[i] < low) | (x[i] >= high);
    *any = found;
  }
};

}  // namespace

template <int D>
Integrator<D>::Integrator(Scheme scheme, double time_step, const Vec<D>& gravity, const Domain<D>& domain,
                          Isa isa)
    : scheme_(scheme), dt_(time_step), gravity_(gravity), domain_(domain), isa_(isa) {}

template <int D>
void Integrator<D>::start(Grains<D>& grains, const std::array<Array, D>& force,
                          const std::array<Array, turns<D>>& torque) {
  const std::size_t orders = scheme_ == Scheme::gear5 ? 3 : 1;
  for (std::size_t order = 0; order < orders; ++order)
    for (auto& column : derivatives_[order]) column.assign(grains.moving, 0.0);
  for (int k = 0; k < degrees; ++k) {
    const bool shift = k < D;
    const auto& drive = shift ? force[k] : torque[k - D];
    const auto& inverse = shift ? grains.inverse_mass : grains.inverse_inertia;
    for (std::size_t i = 0; i < grains.moving; ++i)
      derivatives_[0][k][i] = drive[i] * inverse[i] + (shift ? gravity_[k] : 0);
  }
}

template <int D>
template <bool Correct, bool Predict>
void Integrator<D>::pass(Grains<D>& grains, const std::array<Array, D>* force,
                         const std::array<Array, turns<D>>* torque, Team& team) {
  team.split(grains.moving, [&](Part range, std::size_t) {
    for (int k = 0; k < degrees; ++k) {
      const bool shift = k < D;
      const Column column{shift ? grains.position[k].data() : grains.angle[k - D].data(),
                          shift ? grains.velocity[k].data() : grains.spin[k - D].data(),
                          derivatives_[0][k].data(),
                          derivatives_[1][k].data(),
                          derivatives_[2][k].data(),
                          !Correct ? nullptr
                          : shift  ? (*force)[k].data()
                                   : (*torque)[k - D].data(),
                          shift ? grains.inverse_mass.data() : grains.inverse_inertia.data(),
                          shift ? gravity_[k] : 0.0,
                          range};
      if (scheme_ == Scheme::gear5)
        run_kernel(isa_, Gear5<Correct, Predict>{column, dt_});
      else
        run_kernel(isa_, VelocityVerlet<Correct, Predict>{column, dt_});
    }
    if constexpr (Predict) wrap(grains, range);
  });
}

template <int D>
void Integrator<D>::wrap(Grains<D>& grains, Part range) const {
  for (int k = 0; k < D; ++k) {
    if (!domain_.periodic(k)) continue;
    const double lower = domain_.lower[k], length = domain_.length[k];
    std::int64_t any = 0;
    run_kernel(isa_, Outside{grains.position[k].data(), lower, lower + length, range, &any});
    if (!any) continue;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      double& x = grains.position[k][i];
      if (x < lower) x += length, --grains.wraps[k][i];
      if (x >= lower + length) x -= length, ++grains.wraps[k][i];
    }
  }
}

template <int D>
void Integrator<D>::predict(Grains<D>& grains, Team& team) {
  pass<false, true>(grains, nullptr, nullptr, team);
}
template <int D>
void Integrator<D>::correct(Grains<D>& grains, const std::array<Array, D>& force,
                            const std::array<Array, turns<D>>& torque, Team& team) {
  pass<true, false>(grains, &force, &torque, team);
}
template <int D>
void Integrator<D>::correct_and_predict(Grains<D>& grains, const std::array<Array, D>& force,
                                        const std::array<Array, turns<D>>& torque, Team& team) {
  pass<true, true>(grains, &force, &torque, team);
}

template class Integrator<2>;
template class Integrator<3>;

}  // namespace chute::soft
