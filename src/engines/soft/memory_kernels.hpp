#pragma once
#include <cmath>
#include <cstdint>

#include "core/kernel.hpp"
#include "core/team.hpp"
#include "engines/soft/contacts.hpp"
#include "laws/slip.hpp"

/// The loops of ContactMemory, and of tangential laws that have one.
namespace chute::soft {

/// What contacts remember comes from where it was a step ago: `source`, negative for contacts that are new.
struct TakeOverKernel {
  const std::int32_t* source;
  const double* old;
  Part range;
  double* now;

  void operator()() const {
    const auto* from = source;
    const auto* before = old;
    const auto [begin, end] = range;
    auto* out = now;
    CHUTE_VECTOR_LOOP
    for (std::size_t c = begin; c < end; ++c) {
      const auto o = from[c] < 0 ? 0 : from[c];
      const double known = from[c] < 0 ? 0.0 : 1.0;
      out[c] = known * before[o];
    }
  }
};

/// The same for `V` vectors in the contact plane, which turn with it in space, and how far the surfaces slipped in the
/// step. The first vector is the slip's velocity: it becomes the present one.
///
/// The turn about n by the angle φ of both grains' spins is Cayley's, (1 − h², 2h)/(1 + h²) for cosine and sine with
/// h = φ/2: its angle is φ but for φ³/12.
template <int T, int V>
struct CarryKernel {
  const std::int32_t *source, *first, *second;
  std::array<const double*, T> slip, spin, old_normal, normal;  // the last three in space only
  const double *overlap, *closing;
  std::int32_t grains;  // from this number on walls, which do not turn
  double duration;
  bool trapezoid;
  Part range;
  std::array<std::array<const double*, T>, V> old;
  std::array<std::array<double*, T>, V> now;
  std::array<double*, T> way;

  void operator()() const {
    const auto *from = source, *fi = first, *se = second;
    const auto v_s = slip, w = spin, n_old = old_normal, n_now = normal;
    const auto *xi = overlap, *dxi = closing;
    const auto count = grains;
    const double dt = duration, half = 0.5 * duration, earlier = trapezoid ? 0.5 : 0.0,
                 later = trapezoid ? 0.5 : 1.0;
    const auto [begin, end] = range;
    const auto in = old;
    const auto out = now;
    const auto path = way;
    CHUTE_VECTOR_LOOP
    for (std::size_t c = begin; c < end; ++c) {
      // Weights instead of branches; whatever new contacts find at 0 is finite, and counts nothing.
      const auto o = from[c] < 0 ? 0 : from[c];
      const double known = from[c] < 0 ? 0.0 : 1.0;
      [[maybe_unused]] Vec<T> axis, after;
      [[maybe_unused]] double cosine = 1, rest = 0.5, c_twist = 1, s_twist = 0;
      if constexpr (T == 3) {
        const auto i = fi[c], j = se[c] < count ? se[c] : fi[c];
        const double turns_too = se[c] < count ? 1.0 : 0.0;
        Vec<3> before, spins;
        for (int k = 0; k < 3; ++k) before[k] = n_old[k][o];
        for (int k = 0; k < 3; ++k) after[k] = n_now[k][c];
        for (int k = 0; k < 3; ++k) spins[k] = w[k][i] + turns_too * w[k][j];
        const double spin_along = dot(spins, after);
        axis = cross(before, after);
        cosine = dot(before, after);
        constexpr double farthest = -0.5;  // no normal turns so far in a step
        rest = 1 / (1 + (cosine > farthest ? cosine : farthest));
        const double h = 0.5 * half * spin_along, scale = 1 / (1 + h * h);
        c_twist = (1 - h * h) * scale;
        s_twist = 2 * h * scale;
      }
      const auto carried = [&](const std::array<const double*, T>& column) {
        Vec<T> a;
        for (int k = 0; k < T; ++k) a[k] = column[k][o];
        if constexpr (T == 3) {
          a = cosine * a + cross(axis, a) + (dot(axis, a) * rest) * axis;
          a = c_twist * a + s_twist * cross(after, a);
          // rounding must not tilt it out of the plane in the course of a long contact
          a = a - dot(a, after) * after;
        }
        return a;
      };
      const auto keep = [&](const std::array<double*, T>& column, const Vec<T>& a) {
        for (int k = 0; k < T; ++k) column[k][c] = known * a[k];
      };
      keep(out[1], carried(in[1]));
      keep(out[2], carried(in[2]));
      if constexpr (V == 4) keep(out[3], carried(in[3]));
      const Vec<T> slipped = carried(in[0]);
      const double until_closed = xi[c] / dxi[c];
      const double shorter = until_closed < dt ? until_closed : dt;
      const double since = dxi[c] > 0 ? shorter : dt;  // a new contact began when ξ was 0
      for (int k = 0; k < T; ++k) {
        const double u = v_s[k][c];
        path[k][c] = known * (dt * (earlier * slipped[k] + later * u)) + (1 - known) * (since * u);
        out[0][k][c] = u;
      }
    }
  }
};

/// What the surfaces of each contact do, for laws with a memory. What they take is the work done against them
/// minus the change of what is stored: work by the mean of the forces at the ends of the step, which for a
/// spring is exact. A force that is there at once when a contact begins or ends acts for half a step before
/// or after, as it does in the integration.
template <class Choice, int T>
struct RememberingShearKernel {
  using Law = typename Choice::Law;
  static constexpr std::size_t vectors = static_cast<std::size_t>(Law::vectors),
                               scalars = static_cast<std::size_t>(Law::scalars);
  Choice choice;
  double duration;
  const std::int32_t* source;
  std::array<const double*, T> way, slip;
  const double *normal_force, *overlap, *m_eff, *r_eff;
  Part range;
  std::array<std::array<double*, T>, vectors> vector;
  std::array<double*, scalars> scalar;
  std::array<double*, T> previous_force, force;
  double *stored_before, *stored, *loss;

  void operator()() const {
    const Choice law = choice;
    const double dt = duration, inverse = duration > 0 ? 1 / duration : 0;
    const auto* from = source;
    const auto path = way, v_s = slip;
    const auto *F = normal_force, *xi = overlap, *m = m_eff, *R = r_eff;
    const auto [begin, end] = range;
    const auto own_vectors = vector;
    const auto own_scalars = scalar;
    const auto before_out = previous_force, force_out = force;
    auto *kept = stored_before, *stored_out = stored, *loss_out = loss;
    CHUTE_VECTOR_LOOP
    for (std::size_t c = begin; c < end; ++c) {
      laws::Slip<T> seen{{}, F[c], xi[c], laws::Pair(m[c], R[c])};
      Vec<T> before, moved;
      for (int k = 0; k < T; ++k) {
        seen.way[k] = path[k][c];
        const double whole = dt * v_s[k][c];
        moved[k] = from[c] < 0 ? whole : seen.way[k];
        before[k] = before_out[k][c];
      }
      typename Law::template Memory<T> own;
      for (std::size_t v = 0; v < vectors; ++v)
        for (int k = 0; k < T; ++k) own.vector[v][k] = own_vectors[v][k][c];
      for (std::size_t s = 0; s < scalars; ++s) own.scalar[s] = own_scalars[s][c];

      const Law& f = law(c);
      const Vec<T> now = f(seen, own);
      const double energy = f.energy(seen, own);
      const double taken = -0.5 * dot(before + now, moved) - (energy - kept[c]);

      for (std::size_t v = 0; v < vectors; ++v)
        for (int k = 0; k < T; ++k) own_vectors[v][k][c] = own.vector[v][k];
      for (std::size_t s = 0; s < scalars; ++s) own_scalars[s][c] = own.scalar[s];
      for (int k = 0; k < T; ++k) {
        before_out[k][c] = now[k];
        force_out[k][c] = now[k];
      }
      kept[c] = energy;
      stored_out[c] += energy;
      loss_out[c] = taken * inverse;
    }
  }
};

}  // namespace chute::soft
