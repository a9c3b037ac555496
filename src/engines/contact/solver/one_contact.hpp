#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "engines/contact/solver/problem.hpp"

namespace chute::contact {

/// One contact alone, solved exactly: r with u = W r + q, 0 ≤ r_n ⟂ u_n ≥ 0 and Coulomb's cone, W being its
/// own block. What depends on W only is computed once, for a sweep solves each contact again and again.
///
/// If the contact does not open (q_n < 0), u_n = 0 gives r_n = −(q_n + W_nt·r_t)/W_nn, and what is left for
/// the tangential part is (A + λ) r_t = −b with
///
///   A = W_tt − W_tn W_nt / W_nn,   b = q_t − W_tn q_n / W_nn,
///
/// λ = 0 where it sticks and else the λ > 0 with |r_t(λ)| = μ r_n(λ), which then is |u_t|/|r_t|. The search
/// for it is bracketed: at λ = 0 the contact does not stick, so |r_t| > μ r_n there, and for λ → ∞ r_t
/// vanishes and r_n does not. (The slip angle of Acary, Brémond & Huber 2018, RR-9118, is the direction of
/// r_t(λ); λ has the bracket for nothing, and in two dimensions a closed form.)
template <int D>
class OneContact {
 public:
  OneContact() = default;
  OneContact(const Block<D>& w, double friction) : w_(w), friction_(friction), inverse_nn_(1 / w(0, 0)) {
    for (int i = 0; i < D - 1; ++i) {
      tn_[i] = w(i + 1, 0) * inverse_nn_;
      nt_[i] = w(0, i + 1) * inverse_nn_;
    }
    for (int i = 0; i < D - 1; ++i)
      for (int j = 0; j < D - 1; ++j) a_(i, j) = w(i + 1, j + 1) - tn_[i] * w(0, j + 1);
    for (int i = 0; i < D; ++i) rho_ += w(i, i);
    rho_ = D / rho_;
    if constexpr (D == 2) inverse_a_ = 1 / a_(0, 0);
    if constexpr (D == 3) inverse_a_ = 1 / (a_(0, 0) * a_(1, 1) - a_(0, 1) * a_(1, 0));
  }

  const Block<D>& w() const { return w_; }
  double friction() const { return friction_; }
  /// D/trace W, the mass that turns this contact's velocities into impulses.
  double rho() const { return rho_; }

  /// The impulse; `guess` is one near it, if there is any: the last sweep's.
  Vec<D> solve(const Vec<D>& q, const Vec<D>& guess) const {
    if (q[0] >= 0) return {};
    const double without_shear = -q[0] * inverse_nn_;
    if (friction_ == 0) return normal_only(without_shear);
    Tangential b;
    for (int i = 0; i < D - 1; ++i) b[i] = q[i + 1] - tn_[i] * q[0];
    const auto held = respond(b, inverse_a_, 0);
    const double n = without_shear - dot(nt_, held);
    if (n >= 0 && dot(held, held) <= friction_ * friction_ * n * n) return join(n, held);
    if constexpr (D == 2) {
      const double bound = std::copysign(friction_, held[0]);
      return join(without_shear / (1 + bound * nt_[0]), {{bound * without_shear / (1 + bound * nt_[0])}});
    } else {
      return slide(without_shear, b, guess);
    }
  }

 private:
  using Tangential = Vec<D - 1>;
  Block<D> w_;
  double friction_ = 0, rho_ = 0, inverse_nn_ = 0, inverse_a_ = 0;  // 1/det A
  Tangential tn_, nt_;                                              // W_tn/W_nn, W_nt/W_nn
  Block<D - 1> a_;

  static Vec<D> normal_only(double n) {
    Vec<D> r;
    r[0] = n;
    return r;
  }
  static Vec<D> join(double n, const Tangential& t) {
    Vec<D> r;
    r[0] = n;
    for (int i = 0; i < D - 1; ++i) r[i + 1] = t[i];
    return r;
  }

  /// −(A + λ)⁻¹ b, where `inverse` is 1/det(A + λ).
  Tangential respond(const Tangential& b, double inverse, double lambda) const {
    if constexpr (D == 2) {
      return {{-b[0] * inverse}};
    } else {
      return {{((a_(1, 1) + lambda) * -b[0] + a_(0, 1) * b[1]) * inverse,
               ((a_(0, 0) + lambda) * -b[1] + a_(1, 0) * b[0]) * inverse}};
    }
  }

  /// Newton's method for 1/|r_t| − 1/(μ r_n) = 0, which is linear in λ where A is a multiple of one and r_n
  /// does not depend on r_t, as between spheres; halving where that leaves the bracket.
  Vec<D> slide(double without_shear, const Tangential& b, const Vec<D>& guess) const {
    constexpr double close_enough = 1e-15;  // of |r_t|: a few roundings
    constexpr int most = 100;               // halvings reach the last bit well before
    const double isotropic = std::max(0.0, norm(b) / (friction_ * without_shear) - (a_(0, 0) + a_(1, 1)) / 2);
    double low = 0, high = std::numeric_limits<double>::infinity(), lambda = isotropic;
    if (const double was = std::hypot(guess[1], guess[2]); was > 0) {
      // the slip that the guess leaves, along itself
      const Tangential t{{guess[1], guess[2]}};
      const Tangential u{
          {a_(0, 0) * t[0] + a_(0, 1) * t[1] + b[0], a_(1, 0) * t[0] + a_(1, 1) * t[1] + b[1]}};
      if (const double along = -dot(u, t) / (was * was); along > 0) lambda = along;
    }
    Tangential t;
    double n = 0, size = 0;
    for (int k = 0; k < most; ++k) {
      const double d0 = a_(0, 0) + lambda, d1 = a_(1, 1) + lambda;
      const double inverse = 1 / (d0 * d1 - a_(0, 1) * a_(1, 0));
      t = respond(b, inverse, lambda);
      size = norm(t);
      n = without_shear - dot(nt_, t);
      const double over = size - friction_ * n;
      if (std::abs(over) <= close_enough * size) break;
      (over > 0 ? low : high) = lambda;
      double next = -1;
      if (n > 0) {
        const Tangential slope = respond(t, inverse, lambda);  // d r_t/dλ
        const double bound = friction_ * n;
        const double rise =
            -dot(t, slope) / (size * size * size) - friction_ * dot(nt_, slope) / (bound * bound);
        next = lambda - (1 / size - 1 / bound) / rise;
      }
      if (!(next > low && next < high))
        next = high < 1e300 ? (low + high) / 2 : 2 * low + a_(0, 0) + a_(1, 1);
      if (next == lambda) break;
      lambda = next;
    }
    return join(n, friction_ * n / size * t);
  }
};

/// P_K(x): the nearest impulse in Coulomb's cone |r_t| ≤ μ r_n.
template <int D>
Vec<D> project_on_cone(const Vec<D>& x, double friction) {
  double t = 0;
  for (int i = 1; i < D; ++i) t += x[i] * x[i];
  t = std::sqrt(t);
  if (x[0] >= 0 && t <= friction * x[0]) return x;
  if (friction * t <= -x[0]) return {};
  const double n = (x[0] + friction * t) / (1 + friction * friction);
  Vec<D> y = friction * n / t * x;
  y[0] = n;
  return y;
}

/// r − P_K(r − ρ(u + μ|u_t| n)), an impulse that is 0 where r solves the contact that moves with u.
template <int D>
Vec<D> natural_map(const Vec<D>& r, const Vec<D>& u, double friction, double rho) {
  double slip = 0;
  for (int i = 1; i < D; ++i) slip += u[i] * u[i];
  Vec<D> x = r - rho * u;
  x[0] -= rho * friction * std::sqrt(slip);
  return r - project_on_cone(x, friction);
}

}  // namespace chute::contact
