#include "engines/soft/rigid_motion.hpp"

#include <cmath>

namespace chute::soft {
namespace {

Vec<4> unit(const Vec<4>& q) { return (1 / std::sqrt(dot(q, q))) * q; }

/// dq/dt = ½ (0, ω) q = ½ q (0, Aᵀω)
Vec<4> rate(const Vec<3>& half_ease, const Vec<4>& q, const Vec<3>& momentum) {
  const Vec<3> own = turned_by(-q[0], {{q[1], q[2], q[3]}}, momentum, 1 / dot(q, q));
  return quaternion_product(q, {{0, half_ease[0] * own[0], half_ease[1] * own[1], half_ease[2] * own[2]}});
}

/// As Integrator turns round grains: by the spin of the step's middle.
Vec<4> cayley(const Vec<4>& q, const Vec<3>& spin, const Vec<3>& acceleration, double quarter, double back) {
  Vec<3> h;
  double square = 0;
  for (int k = 0; k < 3; ++k) {
    h[k] = quarter * (spin[k] - back * acceleration[k]);
    square += h[k] * h[k];
  }
  const double scale = 1 / (1 + square), c = (1 - square) * scale, s = 2 * scale;
  return quaternion_product({{c, s * h[0], s * h[1], s * h[2]}}, q);
}

/// What the bodies' columns are, for the loops below.
struct Columns {
  std::array<double*, 4> q;
  std::array<const double*, 3> momentum, first, second, third;  // λ as it was predicted, and its derivatives
  std::array<const double*, 3> ease, torque;
  const double *inverse_inertia, *round;
  Part range;
};

Vec<3> at(const std::array<const double*, 3>& columns, std::size_t i) {
  return {{columns[0][i], columns[1][i], columns[2][i]}};
}

/// One Runge-Kutta step, and for what spins like a sphere Cayley's turn; both are computed and one is chosen, for branches
/// would keep the loop from vectors.
template <bool Polynomial>
struct TurnKernel {
  Columns columns;
  double dt;

  void operator()() const {
    const auto own = columns;
    const auto [w, x, y, z] = own.q;
    const auto* is_round = own.round;
    const auto [begin, end] = own.range;
    const double h = dt, half = dt / 2, quarter = dt / 4, sixth = dt / 6, third = dt / 3;
    CHUTE_VECTOR_LOOP
    for (std::size_t i = begin; i < end; ++i) {
      const Vec<4> q{{w[i], x[i], y[i], z[i]}};
      const Vec<3> after = at(own.momentum, i);
      Vec<3> before = after, middle = after, acceleration{};
      if constexpr (Polynomial) {
        const Vec<3> b = at(own.second, i), c = at(own.third, i);
        acceleration = at(own.first, i);
        before = after - h * (acceleration - half * (b - third * c));
        middle = after - half * (acceleration - quarter * (b - sixth * c));
      }
      const Vec<3> ease = 0.5 * at(own.ease, i);
      const Vec<4> k1 = rate(ease, q, before), k2 = rate(ease, q + half * k1, middle),
                   k3 = rate(ease, q + half * k2, middle), k4 = rate(ease, q + h * k3, after);
      const Vec<4> body = unit(q + sixth * (k1 + 2.0 * k2 + 2.0 * k3 + k4));
      const Vec<4> ball = cayley(q, after, acceleration, quarter, Polynomial ? half : 0.0);
      const bool round = is_round[i] > 0;
      w[i] = round ? ball[0] : body[0];
      x[i] = round ? ball[1] : body[1];
      y[i] = round ? ball[2] : body[2];
      z[i] = round ? ball[3] : body[3];
    }
  }
};

/// The small turn that gear5's correction of the angular acceleration comes to.
struct CorrectKernel {
  Columns columns;
  double weight;

  void operator()() const {
    const auto own = columns;
    const auto [w, x, y, z] = own.q;
    const auto *is_round = own.round, *inverse = own.inverse_inertia;
    const auto [begin, end] = own.range;
    const double to_q = weight;
    CHUTE_VECTOR_LOOP
    for (std::size_t i = begin; i < end; ++i) {
      const Vec<4> q{{w[i], x[i], y[i], z[i]}};
      const Vec<3> off = to_q * (inverse[i] * at(own.torque, i) - at(own.first, i)),
                   ease = 0.5 * at(own.ease, i);
      const Vec<4> body = unit(q + rate(ease, q, off));
      const bool round = is_round[i] > 0;
      w[i] = round ? q[0] : body[0];
      x[i] = round ? q[1] : body[1];
      y[i] = round ? q[2] : body[2];
      z[i] = round ? q[3] : body[3];
    }
  }
};

}  // namespace

RigidMotion::RigidMotion(Scheme scheme, double time_step, const Clumps<3>& clumps, Isa isa)
    : scheme_(scheme), dt_(time_step), isa_(isa) {
  for (std::size_t i = 0; i < clumps.form.size(); ++i) {
    const auto& clump = clumps.of(i);
    round_.push_back(clump.spins_like_a_sphere() ? 1 : 0);
    for (int k = 0; k < 3; ++k) ease_[static_cast<std::size_t>(k)].push_back(clump.ease[k]);
  }
}

namespace {

Columns columns_of(Grains<3>& bodies, const Integrator<3>& integrator, Part range) {
  Columns columns{};
  columns.inverse_inertia = bodies.inverse_inertia.data(), columns.range = range;
  for (std::size_t k = 0; k < 4; ++k) columns.q[k] = bodies.orientation[k].data();
  const auto& d = integrator.derivatives();
  for (std::size_t k = 0; k < 3; ++k) {
    columns.momentum[k] = bodies.spin[k].data();
    columns.first[k] = d[0][3 + k].data(), columns.second[k] = d[1][3 + k].data();
    columns.third[k] = d[2][3 + k].data();
  }
  return columns;
}

}  // namespace

void RigidMotion::turn(Grains<3>& bodies, const Integrator<3>& integrator, Part range) const {
  auto columns = columns_of(bodies, integrator, range);
  columns.round = round_.data();
  for (std::size_t k = 0; k < 3; ++k) columns.ease[k] = ease_[k].data();
  if (scheme_ == Scheme::gear5)
    run_kernel(isa_, TurnKernel<true>{columns, dt_});
  else
    run_kernel(isa_, TurnKernel<false>{columns, dt_});
}

void RigidMotion::correct(Grains<3>& bodies, const GrainSums<3>& sums, const Integrator<3>& integrator,
                          Part range) const {
  if (scheme_ != Scheme::gear5) return;
  auto columns = columns_of(bodies, integrator, range);
  columns.round = round_.data();
  for (std::size_t k = 0; k < 3; ++k)
    columns.ease[k] = ease_[k].data(), columns.torque[k] = sums.torque[k].data();
  run_kernel(isa_, CorrectKernel{columns, 19.0 / 90 * dt_ * dt_ / 2});  // c_0 (2.14), as for places
}

}  // namespace chute::soft
