#pragma once
#include <cmath>
#include <cstdint>

#include "core/domain.hpp"
#include "core/grains.hpp"
#include "core/kernel.hpp"
#include "core/team.hpp"
#include "engines/soft/contact_ends.hpp"
#include "engines/soft/contacts.hpp"
#include "engines/soft/law_table.hpp"
#include "search/coarse_places.hpp"

/// The loops of ContactStages over pairs and contacts.
namespace chute::soft {

/// Which pairs touch? Most do not, so a look at coarse places decides nearly always; this is the loop that a
/// run spends most of its time in. The hit is 1 where they surely touch and 2 where that is in doubt.
template <int D>
struct CoarseTouchKernel {
  static constexpr int words = search::CoarsePlaces<D>::words;
  std::array<const std::uint64_t*, words> word;
  Vec<D> quantum;
  const std::int32_t *first, *second;
  const double* reach_squared;
  double relative_margin, margin;
  std::size_t count;
  std::int64_t *hit, *doubt;

  void operator()() const {
    const auto place = word;
    const auto unit = quantum;
    const auto *i = first, *j = second;
    const auto* reach2 = reach_squared;
    const double more = 1 + relative_margin, less = 1 - relative_margin, slack = margin;
    const auto n = count;
    auto* out = hit;
    std::int64_t uncertain = 0;
    CHUTE_VECTOR_LOOP
    for (std::size_t p = 0; p < n; ++p) {
      double d2 = 0;
      for (int w = 0; w < words; ++w) {
        const std::uint64_t way = place[w][j[p]] - place[w][i[p]] + 0x8000000080000000U;
        const double low = unit[2 * w] * search::CoarsePlaces<D>::quanta(way & 0xffffffffU);
        d2 += low * low;
        if (2 * w + 1 < D) {
          const double high = unit[2 * w + 1] * search::CoarsePlaces<D>::quanta(way >> 32);
          d2 += high * high;
        }
      }
      const bool maybe = d2 < reach2[p] * more + slack, surely = d2 < reach2[p] * less - slack;
      const std::int64_t hits = maybe + (maybe != surely);
      out[p] = hits;
      uncertain |= hits;
    }
    *doubt = uncertain & 2;
  }
};

/// The same by the places themselves.
template <int D>
struct TouchKernel {
  std::array<const double*, D> place;
  const std::int32_t *first, *second;
  const double* reach_squared;
  Vec<D> length, half;
  std::size_t count;
  std::int64_t* hit;

  void operator()() const {
    const auto r = place;
    const auto *i = first, *j = second;
    const auto* reach2 = reach_squared;
    const auto full = length, fold = half;
    const auto n = count;
    auto* out = hit;
    CHUTE_VECTOR_LOOP
    for (std::size_t p = 0; p < n; ++p) {
      double d2 = 0;
      for (int k = 0; k < D; ++k) {
        const double d = Domain<D>::nearest_image(r[k][j[p]] - r[k][i[p]], full[k], fold[k]);
        d2 += d * d;
      }
      out[p] = d2 < reach2[p];
    }
  }
};

/// Frame and relative motion of each contact: (2.3), (2.4), (2.6), (2.7).
template <int D>
struct GeometryKernel {
  static constexpr int T = turns<D>;
  std::array<const double*, D> place, velocity;
  std::array<const double*, T> spin;
  const double* radius;
  const std::int32_t *first, *second;
  Vec<D> length, half;
  Part range;
  std::array<double*, D> normal;
  double *overlap, *closing;
  std::array<double*, T> slip;
  double deepest;
  std::int64_t* deep;  // is any overlap deeper than that?

  void operator()() const {
    const auto r = place, v = velocity;
    const auto w = spin;
    const auto* R = radius;
    const auto *fi = first, *se = second;
    const auto full = length, fold = half;
    const auto [begin, end] = range;
    const auto n_out = normal;
    auto *xi_out = overlap, *closing_out = closing;
    const auto slip_out = slip;
    const double limit = deepest;
    std::int64_t any = 0;
    CHUTE_VECTOR_LOOP
    for (std::size_t c = begin; c < end; ++c) {
      const auto i = fi[c], j = se[c];
      Vec<D> n, dv;
      for (int k = 0; k < D; ++k) {
        n[k] = Domain<D>::nearest_image(r[k][j] - r[k][i], full[k], fold[k]);
        dv[k] = v[k][j] - v[k][i];
      }
      const double distance = std::sqrt(dot(n, n));
      const double inverse = 1 / distance;
      for (int k = 0; k < D; ++k) n[k] *= inverse;
      const double v_n = dot(dv, n);
      if constexpr (D == 2) {
        // (1.14) with s = (n_y, −n_x)
        slip_out[0][c] = dv[0] * n[1] - dv[1] * n[0] + R[i] * w[0][i] + R[j] * w[0][j];
      } else {
        // (2.7), with the sum of the spins (the printed difference contradicts (1.14))
        Vec<3> spin_sum;
        for (int k = 0; k < 3; ++k) spin_sum[k] = R[i] * w[k][i] + R[j] * w[k][j];
        const auto turn = cross(n, spin_sum);
        for (int k = 0; k < 3; ++k) slip_out[k][c] = dv[k] - v_n * n[k] + turn[k];
      }
      for (int k = 0; k < D; ++k) n_out[k][c] = n[k];
      const double xi = R[i] + R[j] - distance;
      any |= xi > limit;
      xi_out[c] = xi;
      closing_out[c] = -v_n;
    }
    *deep = any;
  }
};

/// Laws whose force is there at once when a contact begins, and those with a linear spring beside it: see EndWeights.
template <class Law>
constexpr bool acts_at_once = requires {
  Law::acts_at_once;
};
template <class Law>
constexpr bool linear_spring = requires {
  Law::linear_spring;
};

/// How steps near the ends of contacts count: see EndWeights.
enum class EndsOfContacts { sampled, inside, mean };

/// `Choice` says which law a contact has (LawTable).
template <class Choice, EndsOfContacts ends_count>
struct NormalKernel {
  Choice choice;
  EndWeights ends;
  double least;  // the force is clipped there: 0 without attraction, else −∞
  const double *overlap, *closing, *m_eff, *r_eff;
  Part range;
  double *force, *loss, *weight;

  static EndWeights::Parts parts(const EndWeights& ends, double xi, double dxi) {
    if constexpr (ends_count == EndsOfContacts::mean)
      return ends.mean(xi, dxi);
    else
      return ends.inside(xi, dxi, linear_spring<typename Choice::Law>);
  }

  void operator()() const {
    const Choice law = choice;
    const EndWeights near_ends = ends;
    const double floor = least;
    const auto *xi = overlap, *dxi = closing, *m = m_eff, *R = r_eff;
    const auto [begin, end] = range;
    auto *force_out = force, *loss_out = loss, *weight_out = weight;
    CHUTE_VECTOR_LOOP
    for (std::size_t c = begin; c < end; ++c) {
      const laws::Pair pair(m[c], R[c]);
      if constexpr (ends_count != EndsOfContacts::sampled) {
        // The force that carries the velocity on is that of the old velocity.
        const auto before = parts(near_ends, xi[c], dxi[c]);
        const auto carrying = law(c)(before.overlap, dxi[c], pair);
        const double closing_now =
            near_ends.closing(dxi[c], carrying.total + (before.at_once - 1) * carrying.at_once, pair.m_eff);
        const auto part = parts(near_ends, xi[c], closing_now);
        const auto whole = law(c)(part.overlap, closing_now, pair);
        const double total = whole.total + (part.at_once - 1) * whole.at_once;
        // Where it would pull and must not, it does not, whatever its weight.
        const double pushes = whole.total < total ? whole.total : total;
        const double clipped = pushes < floor ? floor : total;
        force_out[c] = clipped;
        loss_out[c] = part.at_once * whole.loss_rate + (clipped - total) * closing_now;
        weight_out[c] = part.at_once;
      } else {
        const auto result = law(c)(xi[c], dxi[c], pair);
        const double clipped = result.total < floor ? floor : result.total;
        force_out[c] = clipped;
        loss_out[c] = result.loss_rate + (clipped - result.total) * dxi[c];  // what the spring gives is lost
      }
    }
  }
};

/// The same for a law with a memory. Such laws branch and call functions; there is nothing to vectorise.
template <class Choice, class Law = typename Choice::Law>
void remembering_normal(const Choice& choice,
                        std::array<double*, static_cast<std::size_t>(Law::memory)> columns,
                        double inverse_duration, const double* overlap, const double* closing,
                        const double* m_eff, const double* r_eff, Part range, double* force, double* loss,
                        double* stored) {
  for (std::size_t c = range.begin; c < range.end; ++c) {
    const Law& law = choice(c);
    std::array<double, static_cast<std::size_t>(Law::memory)> memory;
    for (std::size_t k = 0; k < memory.size(); ++k) memory[k] = columns[k][c];
    const auto result = law(overlap[c], closing[c], laws::Pair(m_eff[c], r_eff[c]), memory);
    for (std::size_t k = 0; k < memory.size(); ++k) columns[k][c] = memory[k];
    force[c] = result.total;
    loss[c] = result.loss * inverse_duration;
    stored[c] = law.energy(overlap[c], laws::Pair(m_eff[c], r_eff[c]), memory);
  }
}

template <class Choice, int T>
struct ShearKernel {
  Choice choice;
  std::array<const double*, T> slip;
  const double *normal_force, *m_eff;
  const double* weight;  // of EndWeights: friction's viscous branch is there at once too
  Part range;
  std::array<double*, T> force;
  double* loss;

  void operator()() const {
    const Choice law = choice;
    const auto v_s = slip;
    const auto *f_n = normal_force, *m = m_eff, *w = weight;
    const auto [begin, end] = range;
    const auto force_out = force;
    auto* loss_out = loss;
    CHUTE_VECTOR_LOOP
    for (std::size_t c = begin; c < end; ++c) {
      Vec<T> v;
      for (int k = 0; k < T; ++k) v[k] = v_s[k][c];
      const Vec<T> result = law(c)(w[c] * v, f_n[c], m[c]);
      for (int k = 0; k < T; ++k) force_out[k][c] = result[k];
      loss_out[c] = -dot(result, v);
    }
  }
};

}  // namespace chute::soft
