#include "soft/contact_stages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace chute::soft {
namespace {

template <std::size_t K>
std::array<const double*, K> pointers(const std::array<Array, K>& arrays) {
  std::array<const double*, K> p;
  for (std::size_t k = 0; k < K; ++k) p[k] = arrays[k].data();
  return p;
}
template <std::size_t K>
std::array<double*, K> pointers(std::array<Array, K>& arrays) {
  std::array<double*, K> p;
  for (std::size_t k = 0; k < K; ++k) p[k] = arrays[k].data();
  return p;
}

/// Which pairs touch? Most do not; this is the loop that a run spends most of its time in.
template <int D>
struct TouchKernel {
  std::array<const double*, D> place;
  const std::int32_t *first, *second;
  const double* reach_squared;
  Vec<D> length, half;
  Part range;
  std::int64_t* hit;

  void operator()() const {
    const auto r = place;
    const auto *i = first, *j = second;
    const auto* reach2 = reach_squared;
    const auto full = length, fold = half;
    const auto [begin, end] = range;
    auto* out = hit;
    CHUTE_VECTOR_LOOP
    for (std::size_t p = begin; p < end; ++p) {
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
  const double *radius, *inverse_mass;
  const std::int32_t *first, *second;
  Vec<D> length, half;
  Part range;
  std::array<double*, D> normal;
  double *overlap, *closing, *m_eff;
  std::array<double*, T> slip;

  void operator()() const {
    const auto r = place, v = velocity;
    const auto w = spin;
    const auto *R = radius, *inv_m = inverse_mass;
    const auto *fi = first, *se = second;
    const auto full = length, fold = half;
    const auto [begin, end] = range;
    const auto n_out = normal;
    auto *xi_out = overlap, *closing_out = closing, *m_out = m_eff;
    const auto slip_out = slip;
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
      xi_out[c] = R[i] + R[j] - distance;
      closing_out[c] = -v_n;
      m_out[c] = 1 / (inv_m[i] + inv_m[j]);
    }
  }
};

template <class Law>
struct NormalKernel {
  Law law;
  double least;  // the force is clipped there: 0 without attraction, else −∞
  const double *overlap, *closing, *m_eff, *r_eff;
  Part range;
  double *force, *loss;

  void operator()() const {
    const Law f = law;
    const double floor = least;
    const auto *xi = overlap, *dxi = closing, *m = m_eff, *R = r_eff;
    const auto [begin, end] = range;
    auto *force_out = force, *loss_out = loss;
    CHUTE_VECTOR_LOOP
    for (std::size_t c = begin; c < end; ++c) {
      const auto result = f(xi[c], dxi[c], laws::Pair(m[c], R[c]));
      const double clipped = result.total < floor ? floor : result.total;
      force_out[c] = clipped;
      loss_out[c] = result.loss_rate + (clipped - result.total) * dxi[c];  // what the spring gives is lost
    }
  }
};

/// The same for a law with a memory. Such laws branch and call functions; there is nothing to vectorise.
template <class Law>
void remembering_normal(const Law& law, std::array<double*, static_cast<std::size_t>(Law::memory)> columns,
                        double inverse_duration, const double* overlap, const double* closing,
                        const double* m_eff, const double* r_eff, Part range, double* force, double* loss,
                        double* stored) {
  for (std::size_t c = range.begin; c < range.end; ++c) {
    std::array<double, static_cast<std::size_t>(Law::memory)> memory;
    for (std::size_t k = 0; k < memory.size(); ++k) memory[k] = columns[k][c];
    const auto result = law(overlap[c], closing[c], laws::Pair(m_eff[c], r_eff[c]), memory);
    for (std::size_t k = 0; k < memory.size(); ++k) columns[k][c] = memory[k];
    force[c] = result.total;
    loss[c] = result.loss * inverse_duration;
    stored[c] = law.energy(overlap[c], laws::Pair(m_eff[c], r_eff[c]), memory);
  }
}

template <class Law, int T>
struct ShearKernel {
  Law law;
  std::array<const double*, T> slip;
  const double *normal_force, *m_eff;
  Part range;
  std::array<double*, T> force;
  double* loss;

  void operator()() const {
    const Law f = law;
    const auto v_s = slip;
    const auto *f_n = normal_force, *m = m_eff;
    const auto [begin, end] = range;
    const auto force_out = force;
    auto* loss_out = loss;
    CHUTE_VECTOR_LOOP
    for (std::size_t c = begin; c < end; ++c) {
      Vec<T> v;
      for (int k = 0; k < T; ++k) v[k] = v_s[k][c];
      const Vec<T> result = f(v, f_n[c], m[c]);
      for (int k = 0; k < T; ++k) force_out[k][c] = result[k];
      loss_out[c] = -dot(result, v);
    }
  }
};

/// What the surfaces of each contact do, for laws with a memory. What they take is the work done against them
/// minus the change of what is stored: work by the mean of the forces at the ends of the step, which for a
/// spring is exact. A force that is there at once when a contact begins or ends acts for half a step before
/// or after, as it does in the integration.
template <class Law, int D>
void remembering_shear(const Law& law, ContactMemory<D>& memory, double duration, Part range,
                       Contacts<D>& contacts) {
  constexpr int T = turns<D>;
  const double inverse_duration = duration > 0 ? 1 / duration : 0;
  for (std::size_t c = range.begin; c < range.end; ++c) {
    laws::Slip<T> slip{
        {}, contacts.normal_force[c], contacts.overlap[c], laws::Pair(contacts.m_eff[c], contacts.r_eff[c])};
    Vec<T> before, way;
    for (int k = 0; k < T; ++k) {
      slip.way[k] = memory.way()[k][c];
      way[k] = memory.fresh(c) ? duration * contacts.slip[k][c] : slip.way[k];
      before[k] = memory.previous_force(k)[c];
    }
    typename Law::template Memory<T> own;
    for (int v = 0; v < Law::vectors; ++v)
      for (int k = 0; k < T; ++k) own.vector[static_cast<std::size_t>(v)][k] = memory.vector_column(v, k)[c];
    for (int s = 0; s < Law::scalars; ++s)
      own.scalar[static_cast<std::size_t>(s)] = memory.scalar_column(s)[c];

    const Vec<T> force = law(slip, own);
    const double stored = law.energy(slip, own);
    const double taken = -0.5 * dot(before + force, way) - (stored - memory.stored_column()[c]);

    for (int v = 0; v < Law::vectors; ++v)
      for (int k = 0; k < T; ++k) memory.vector_column(v, k)[c] = own.vector[static_cast<std::size_t>(v)][k];
    for (int s = 0; s < Law::scalars; ++s)
      memory.scalar_column(s)[c] = own.scalar[static_cast<std::size_t>(s)];
    for (int k = 0; k < T; ++k) memory.previous_force(k)[c] = contacts.shear_force[k][c] = force[k];
    memory.stored_column()[c] = stored;
    contacts.stored[c] += stored;
    contacts.shear_loss[c] = taken * inverse_duration;
  }
}

}  // namespace

template <int D>
void Contacts<D>::reserve(std::size_t most) {
  if (i.size() >= most) return;
  i.resize(most);
  j.resize(most);
  for (auto& a : normal) a.resize(most);
  for (auto& a : slip) a.resize(most);
  for (auto& a : shear_force) a.resize(most);
  for (auto* a : {&overlap, &closing, &m_eff, &r_eff, &normal_force, &normal_loss, &shear_loss, &stored})
    a->resize(most);
}

template <int D>
ContactStages<D>::ContactStages(const Domain<D>& domain, const laws::Contact& laws, Isa isa, SlipRule rule)
    : domain_(domain), laws_(laws), isa_(isa), memory_(laws, rule), needs_radius_(laws::needs_radius(laws)) {}

template <int D>
void ContactStages<D>::find_touching(const search::PairList& pairs, const Grains<D>& grains,
                                     Contacts<D>& contacts, Team& team) {
  const std::size_t n = pairs.size();
  if (hit_.size() < n) hit_.resize(n), touching_.resize(n);
  found_.resize(team.size());
  team.split(n, [&](Part range, std::size_t member) {
    run_kernel(isa_, TouchKernel<D>{pointers(grains.position), pairs.i.data(), pairs.j.data(),
                                    pairs.reach_squared.data(), domain_.length, 0.5 * domain_.length, range,
                                    hit_.data()});
    std::size_t end = range.begin;
    for (std::size_t p = range.begin; p < range.end;
         ++p) {  // without a branch: which touch is not predictable
      touching_[end] = static_cast<std::int32_t>(p);
      end += static_cast<std::size_t>(hit_[p]);
    }
    found_[member] = end - range.begin;
  });
  contacts.count = std::accumulate(found_.begin(), found_.end(), std::size_t{0});
  contacts.reserve(contacts.count);
}

/// Names the grains of the contacts in a range: what each of the team found follows on what the one before
/// found.
template <int D>
void ContactStages<D>::name_grains(const search::PairList& pairs, Part range, Contacts<D>& contacts,
                                   const Team& team) const {
  std::size_t first = 0;
  for (std::size_t member = 0; member < found_.size(); first += found_[member++]) {
    const auto* touching = touching_.data() + team.part(pairs.size(), member).begin;
    const auto end = std::min(range.end, first + found_[member]);
    for (std::size_t c = std::max(range.begin, first); c < end; ++c) {
      const auto p = static_cast<std::size_t>(touching[c - first]);
      contacts.i[c] = pairs.i[p];
      contacts.j[c] = pairs.j[p];
    }
  }
}

template <int D>
void ContactStages<D>::geometry(const Grains<D>& grains, Part range, Contacts<D>& contacts) const {
  run_kernel(isa_,
             GeometryKernel<D>{pointers(grains.position), pointers(grains.velocity), pointers(grains.spin),
                               grains.radius.data(), grains.inverse_mass.data(), contacts.i.data(),
                               contacts.j.data(), domain_.length, 0.5 * domain_.length, range,
                               pointers(contacts.normal), contacts.overlap.data(), contacts.closing.data(),
                               contacts.m_eff.data(), pointers(contacts.slip)});
  if (!needs_radius_) return;
  for (std::size_t c = range.begin; c < range.end; ++c) {
    const double a = grains.radius[static_cast<std::size_t>(contacts.i[c])];
    const double b = grains.radius[static_cast<std::size_t>(contacts.j[c])];
    contacts.r_eff[c] = a * b / (a + b);
  }
}

template <int D>
void ContactStages<D>::evaluate(const search::PairList& pairs, const Grains<D>& grains, Contacts<D>& contacts,
                                double duration, Team& team) {
  find_touching(pairs, grains, contacts, team);
  const auto begin = [&](Part range) {
    name_grains(pairs, range, contacts, team);
    geometry(grains, range, contacts);
  };
  const auto laws = [&](Part range) {
    normal_forces(range, contacts, duration);
    shear_forces(range, contacts, duration);
  };
  if (!memory_.needed()) {
    team.split(contacts.count, [&](Part range, std::size_t) {
      begin(range);
      laws(range);
    });
    return;
  }
  team.split(contacts.count, [&](Part range, std::size_t) { begin(range); });
  memory_.carry(grains, contacts, duration);
  std::fill_n(contacts.stored.begin(), contacts.count, 0.0);
  team.split(contacts.count, [&](Part range, std::size_t) { laws(range); });
}

template <int D>
void ContactStages<D>::normal_forces(Part range, Contacts<D>& contacts, double duration) {
  const double inverse_duration = duration > 0 ? 1 / duration : 0;
  std::visit(
      [&]<class Law>(const Law& law) {
        const double *xi = contacts.overlap.data(), *dxi = contacts.closing.data();
        const double *m = contacts.m_eff.data(), *R = contacts.r_eff.data();
        double *force = contacts.normal_force.data(), *loss = contacts.normal_loss.data();
        if constexpr (laws::NormalWithMemory<Law>) {
          std::array<double*, static_cast<std::size_t>(Law::memory)> columns;
          for (int k = 0; k < Law::memory; ++k)
            columns[static_cast<std::size_t>(k)] = memory_.normal_column(k);
          remembering_normal(law, columns, inverse_duration, xi, dxi, m, R, range, force, loss,
                             contacts.stored.data());
        } else {
          const double least = laws_.attraction ? -std::numeric_limits<double>::infinity() : 0.0;
          run_kernel(isa_, NormalKernel<Law>{law, least, xi, dxi, m, R, range, force, loss});
        }
      },
      laws_.normal);
}

template <int D>
void ContactStages<D>::shear_forces(Part range, Contacts<D>& contacts, double duration) {
  const std::array<Array, turns<D>>& slip = contacts.slip;
  std::visit(
      [&]<class Law>(const Law& law) {
        if constexpr (laws::ShearWithMemory<Law>)
          remembering_shear<Law, D>(law, memory_, duration, range, contacts);
        else
          run_kernel(isa_, ShearKernel<Law, turns<D>>{
                               law, pointers(slip), contacts.normal_force.data(), contacts.m_eff.data(),
                               range, pointers(contacts.shear_force), contacts.shear_loss.data()});
      },
      laws_.shear);
}

template <int D>
void ContactStages<D>::apply(const Contacts<D>& contacts, const Grains<D>& grains,
                             std::array<Array, D>& force, std::array<Array, turns<D>>& torque,
                             Team& team) const {
  team.run([&](std::size_t member) {
    Part own = team.part(grains.moving, member);
    if (member + 1 == team.size()) own.end = grains.size();  // with the bed
    apply_to(own, contacts, grains, force, torque);
  });
}

/// A grain's sums are in the order of its contacts, whoever computes them: those with grains before the
/// range, which come first, and then those that begin in it.
template <int D>
void ContactStages<D>::apply_to(Part own, const Contacts<D>& contacts, const Grains<D>& grains,
                                std::array<Array, D>& force, std::array<Array, turns<D>>& torque) const {
  for (auto& f : force)
    std::fill(f.begin() + static_cast<std::ptrdiff_t>(own.begin),
              f.begin() + static_cast<std::ptrdiff_t>(own.end), 0.0);
  for (auto& t : torque)
    std::fill(t.begin() + static_cast<std::ptrdiff_t>(own.begin),
              t.begin() + static_cast<std::ptrdiff_t>(own.end), 0.0);
  const auto add = [&](std::size_t c, bool to_i, bool to_j) {
    const auto i = static_cast<std::size_t>(contacts.i[c]), j = static_cast<std::size_t>(contacts.j[c]);
    Vec<D> f, n;
    for (int k = 0; k < D; ++k) n[k] = contacts.normal[k][c];
    f = contacts.normal_force[c] * n;
    Vec<turns<D>> turn;  // both grains: the lever arms and the forces are opposite
    if constexpr (D == 2) {
      const double f_s = contacts.shear_force[0][c];
      f[0] += f_s * n[1];
      f[1] -= f_s * n[0];
      turn[0] = f_s;
    } else {
      Vec<3> f_s;
      for (int k = 0; k < 3; ++k) f_s[k] = contacts.shear_force[k][c];
      f = f + f_s;
      turn = -1.0 * cross(n, f_s);
    }
    const double Ri = grains.radius[i], Rj = grains.radius[j];
    if (to_i)
      for (int k = 0; k < turns<D>; ++k) torque[k][i] += Ri * turn[k];
    if (to_j)
      for (int k = 0; k < turns<D>; ++k) torque[k][j] += Rj * turn[k];
    if (to_i)
      for (int k = 0; k < D; ++k) force[k][i] -= f[k];
    if (to_j)
      for (int k = 0; k < D; ++k) force[k][j] += f[k];
  };
  const auto until = contacts.i.begin() + static_cast<std::ptrdiff_t>(contacts.count);
  const auto contact_of = [&](std::size_t grain) {
    return static_cast<std::size_t>(
        std::lower_bound(contacts.i.begin(), until, static_cast<std::int32_t>(grain)) - contacts.i.begin());
  };
  const std::size_t first = contact_of(own.begin), last = contact_of(own.end);
  const auto is_own = [&](std::int32_t j) {
    return static_cast<std::size_t>(j) >= own.begin && static_cast<std::size_t>(j) < own.end;
  };
  for (std::size_t c = 0; c < first; ++c)
    if (is_own(contacts.j[c])) add(c, false, true);
  for (std::size_t c = first; c < last; ++c) add(c, true, is_own(contacts.j[c]));
}

template <int D>
double ContactStages<D>::elastic_energy(const Contacts<D>& contacts) const {
  double sum = 0;
  std::visit(
      [&]<class Law>(const Law& law) {
        if constexpr (!laws::NormalWithMemory<Law>)
          for (std::size_t c = 0; c < contacts.count; ++c)
            sum += law.energy(contacts.overlap[c], laws::Pair(contacts.m_eff[c], contacts.r_eff[c]));
      },
      laws_.normal);
  if (memory_.needed())
    for (std::size_t c = 0; c < contacts.count; ++c) sum += contacts.stored[c];
  return sum;
}

template struct Contacts<2>;
template struct Contacts<3>;
template class ContactStages<2>;
template class ContactStages<3>;

}  // namespace chute::soft
