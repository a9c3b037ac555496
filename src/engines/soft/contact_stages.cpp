#include "engines/soft/contact_stages.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>

#include "core/compress.hpp"
#include "engines/soft/contact_kernels.hpp"
#include "engines/soft/memory_kernels.hpp"

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

/// The last range goes on to the end of a vector: see `padded`.
Part whole_vectors(Part range, std::size_t count) {
  return {range.begin, range.end == count ? padded(count) : range.end};
}

/// Fills the last vector up with the last contact.
template <int D>
void pad(Contacts<D>& contacts) {
  for (std::size_t c = contacts.count; c < padded(contacts.count); ++c) {
    contacts.i[c] = contacts.i[c - 1];
    contacts.j[c] = contacts.j[c - 1];
    contacts.m_eff[c] = contacts.m_eff[c - 1];
    contacts.law[c] = contacts.law[c - 1];
  }
}

/// The first contact that begins with this grain or a later one.
template <int D>
std::size_t first_of(const Contacts<D>& contacts, std::size_t grain) {
  const auto *begin = contacts.i.data(), *end = begin + contacts.count;
  return static_cast<std::size_t>(std::lower_bound(begin, end, static_cast<std::int32_t>(grain)) - begin);
}

/// Adds the forces of contacts to those of their grains.
template <int D>
struct Adder {
  const std::int32_t *first, *second;
  std::array<const double*, D> normal;
  std::array<const double*, turns<D>> shear_force;
  const double *normal_force, *radius;
  std::array<double*, D> force;
  std::array<double*, turns<D>> torque;

  Adder(const Contacts<D>& c, const Grains<D>& grains, GrainSums<D>& sums)
      : first(c.i.data()),
        second(c.j.data()),
        normal(pointers(c.normal)),
        shear_force(pointers(c.shear_force)),
        normal_force(c.normal_force.data()),
        radius(grains.radius.data()),
        force(pointers(sums.force)),
        torque(pointers(sums.torque)) {}

  void forces(std::size_t c, bool to_i, bool to_j) const {
    const auto i = static_cast<std::size_t>(first[c]), j = static_cast<std::size_t>(second[c]);
    Vec<D> f, n;
    for (int k = 0; k < D; ++k) n[k] = normal[k][c];
    f = normal_force[c] * n;
    Vec<turns<D>> turn;  // both grains: the lever arms and the forces are opposite
    if constexpr (D == 2) {
      const double f_s = shear_force[0][c];
      f[0] += f_s * n[1];
      f[1] -= f_s * n[0];
      turn[0] = f_s;
    } else {
      Vec<3> f_s;
      for (int k = 0; k < 3; ++k) f_s[k] = shear_force[k][c];
      f = f + f_s;
      turn = -1.0 * cross(n, f_s);
    }
    if (to_i) {
      for (int k = 0; k < turns<D>; ++k) torque[k][i] += radius[i] * turn[k];
      for (int k = 0; k < D; ++k) force[k][i] -= f[k];
    }
    if (to_j) {
      for (int k = 0; k < turns<D>; ++k) torque[k][j] += radius[j] * turn[k];
      for (int k = 0; k < D; ++k) force[k][j] += f[k];
    }
  }
};

template <int D>
void add_losses(const Contacts<D>& contacts, Part which, double duration, GrainSums<D>& sums) {
  const double *normal = contacts.normal_loss.data(), *shear = contacts.shear_loss.data();
  double *normal_sum = sums.normal_loss.data(), *shear_sum = sums.shear_loss.data();
  for (std::size_t c = which.begin; c < which.end; ++c) {
    const auto i = static_cast<std::size_t>(contacts.i[c]);
    normal_sum[i] += duration * normal[c];
    shear_sum[i] += duration * shear[c];
  }
}

}  // namespace

template <int D>
void Contacts<D>::reserve(std::size_t most) {
  most = padded(most);
  if (i.size() >= most) return;
  i.resize(most);
  j.resize(most);
  law.resize(most);
  for (auto& a : normal) a.resize(most);
  for (auto& a : slip) a.resize(most);
  for (auto& a : shear_force) a.resize(most);
  for (auto* a : {&overlap, &closing, &m_eff, &r_eff, &normal_force, &normal_loss, &shear_loss, &stored})
    a->resize(most);
  weight.resize(most, 1.0);
}

template <int D>
ContactStages<D>::ContactStages(const Domain<D>& domain, const LawTable& laws, Isa isa, SlipRule rule)
    : domain_(domain),
      laws_(laws),
      isa_(isa),
      memory_(laws.first(), rule),
      needs_radius_(laws.needs_radius()) {}

/// Writes the pairs of `range` that touch to `pair`, and tells how many they are. In pieces, whose hits stay
/// in the nearest cache.
template <int D>
std::size_t ContactStages<D>::find(const search::Candidates<D>& candidates, const Grains<D>& grains,
                                   Part range, std::int32_t* pair) const {
  constexpr std::size_t piece = 1024;
  alignas(64) std::array<std::int64_t, piece> hit;  // as wide as a double: the same vector lanes
  std::size_t found = 0;
  for (std::size_t begin = range.begin; begin < range.end; begin += piece)
    found +=
        find_in(candidates, grains, {begin, std::min(range.end, begin + piece)}, hit.data(), pair + found);
  return found;
}

template <int D>
std::size_t ContactStages<D>::find_in(const search::Candidates<D>& candidates, const Grains<D>& grains,
                                      Part range, std::int64_t* hit, std::int32_t* pair) const {
  const auto& pairs = candidates.pairs;
  const auto *i = pairs.i.data() + range.begin, *j = pairs.j.data() + range.begin;
  const double* reach_squared = pairs.reach_squared.data() + range.begin;
  const auto base = static_cast<std::int32_t>(range.begin);
  const std::size_t count = range.size();
  if (!candidates.coarse || isa_ == Isa::baseline) {  // two lanes: the words cost more than they save
    run_kernel(isa_, TouchKernel<D>{pointers(grains.position), i, j, reach_squared, domain_.length,
                                    0.5 * domain_.length, count, hit});
    return compress(isa_, hit, count, base, pair);
  }
  const auto& coarse = *candidates.coarse;
  std::int64_t doubt = 0;
  CoarseTouchKernel<D> kernel{{},    coarse.quantum, i,     j,   reach_squared,
                              1e-12, coarse.margin,  count, hit, &doubt};
  for (int w = 0; w < coarse.words; ++w) kernel.word[w] = coarse.word[w].data();
  run_kernel(isa_, kernel);
  const std::size_t found = compress(isa_, hit, count, base, pair);
  if (!doubt) return found;
  const auto apart = [&](std::int32_t p) {
    const auto local = static_cast<std::size_t>(p - base);
    if (hit[local] == 1) return false;
    const auto way = domain_.way(grains.place(static_cast<std::size_t>(i[local])),
                                 grains.place(static_cast<std::size_t>(j[local])));
    return !(dot(way, way) < reach_squared[local]);
  };
  return static_cast<std::size_t>(std::remove_if(pair, pair + found, apart) - pair);
}

/// Names the grains of contacts, and which law they have where there are several.
template <int D>
void ContactStages<D>::name(const search::PairList& pairs, const std::int32_t* touching, Part which,
                            const Grains<D>& grains, Contacts<D>& contacts) const {
  for (std::size_t c = which.begin; c < which.end; ++c) {
    const auto p = static_cast<std::size_t>(touching[c - which.begin]);
    contacts.i[c] = pairs.i[p];
    contacts.j[c] = pairs.j[p];
    contacts.m_eff[c] = pairs.m_eff[p];
  }
  if (!laws_.several()) return;
  for (std::size_t c = which.begin; c < which.end; ++c)
    contacts.law[c] = laws_.of(grains.material[static_cast<std::size_t>(contacts.i[c])],
                               grains.material[static_cast<std::size_t>(contacts.j[c])]);
}

/// Names the grains of the contacts in a range: what each of the team found follows on what the one before
/// found.
template <int D>
void ContactStages<D>::name_grains(const search::PairList& pairs, Part range, const Grains<D>& grains,
                                   Contacts<D>& contacts, const Team& team) const {
  std::size_t first = 0;
  for (std::size_t member = 0; member < found_.size(); first += found_[member++]) {
    const auto* touching = touching_.pair.data() + team.part(pairs.size(), member).begin;
    const auto begin = std::max(range.begin, first), end = std::min(range.end, first + found_[member]);
    if (begin < end) name(pairs, touching + (begin - first), {begin, end}, grains, contacts);
  }
  if (range.end == contacts.count) pad(contacts);
}

template <int D>
void ContactStages<D>::geometry(const Grains<D>& grains, Part range, Contacts<D>& contacts) const {
  range = whole_vectors(range, contacts.count);
  std::int64_t deep = 0;
  run_kernel(
      isa_, GeometryKernel<D>{pointers(grains.position), pointers(grains.velocity), pointers(grains.spin),
                              grains.radius.data(), contacts.i.data(), contacts.j.data(), domain_.length,
                              0.5 * domain_.length, range, pointers(contacts.normal), contacts.overlap.data(),
                              contacts.closing.data(), pointers(contacts.slip), deepest_, &deep});
  if (deep) std::atomic_ref(contacts.deep).store(1, std::memory_order_relaxed);
  if (!needs_radius_) return;
  for (std::size_t c = range.begin; c < range.end; ++c) {
    const double a = grains.radius[static_cast<std::size_t>(contacts.i[c])];
    const double b = grains.radius[static_cast<std::size_t>(contacts.j[c])];
    contacts.r_eff[c] = a * b / (a + b);
  }
}

template <int D>
void ContactStages<D>::evaluate(const search::Candidates<D>& candidates, std::span<const Part> pairs,
                                const Grains<D>& grains, Contacts<D>& contacts, Touching& touching) {
  contacts.count = 0;
  contacts.deep = 0;
  for (const Part range : pairs) {
    touching.reserve(range.size());
    const Part found{contacts.count, contacts.count + find(candidates, grains, range, touching.pair.data())};
    contacts.reserve(found.end);
    name(candidates.pairs, touching.pair.data(), found, grains, contacts);
    contacts.count = found.end;
  }
  pad(contacts);
  const Part all{0, contacts.count};
  geometry(grains, all, contacts);
  normal_forces(all, contacts, 0);
  shear_forces(all, contacts, 0);
}

template <int D>
void ContactStages<D>::evaluate(const search::Candidates<D>& candidates, const Grains<D>& grains,
                                Contacts<D>& contacts, double duration, Team& team) {
  const auto& pairs = candidates.pairs;
  touching_.reserve(pairs.size());
  found_.resize(team.size());
  team.split(pairs.size(), [&](Part range, std::size_t member) {
    found_[member] = find(candidates, grains, range, touching_.pair.data() + range.begin);
  });
  contacts.count = std::accumulate(found_.begin(), found_.end(), std::size_t{0});
  contacts.deep = 0;
  contacts.reserve(contacts.count);
  if (!memory_.needed()) {
    team.split(contacts.count, [&](Part range, std::size_t) {
      name_grains(pairs, range, grains, contacts, team);
      geometry(grains, range, contacts);
      normal_forces(range, contacts, duration);
      shear_forces(range, contacts, duration);
    });
    return;
  }
  team.split(contacts.count,
             [&](Part range, std::size_t) { name_grains(pairs, range, grains, contacts, team); });
  memory_.match(contacts, duration);
  // In pieces whose numbers stay in a core's own cache from stage to stage: there are several hundred bytes a contact.
  constexpr std::size_t piece = 512;
  team.split(contacts.count, [&](Part all, std::size_t) {
    for (std::size_t begin = all.begin; begin < all.end; begin += piece) {
      const Part range{begin, std::min(all.end, begin + piece)};
      geometry(grains, range, contacts);
      remembered_forces(grains, range, contacts, duration);
    }
  });
}

template <int D>
void ContactStages<D>::evaluate_and_apply(const search::Candidates<D>& candidates, const Grains<D>& grains,
                                          std::size_t pairs_in_piece, Contacts<D>& piece, double duration,
                                          GrainSums<D>& sums) {
  const std::size_t pairs = candidates.pairs.size();
  touching_.reserve(pairs_in_piece);
  piece.deep = 0;
  memory_.begin();
  for (std::size_t begin = 0; begin < pairs; begin += pairs_in_piece) {
    piece.count =
        find(candidates, grains, {begin, std::min(pairs, begin + pairs_in_piece)}, touching_.pair.data());
    piece.reserve(piece.count);
    const Part all{0, piece.count};
    name(candidates.pairs, touching_.pair.data(), all, grains, piece);
    pad(piece);
    memory_.match_piece(piece, duration);
    geometry(grains, all, piece);
    remembered_forces(grains, all, piece, duration);
    apply(piece, grains, duration, sums, Team::alone());
  }
  memory_.end(duration);
}

template <int D>
void ContactStages<D>::locate(const search::Candidates<D>& candidates, const Grains<D>& grains,
                              Contacts<D>& contacts) {
  const Part all_pairs{0, candidates.pairs.size()};
  touching_.reserve(all_pairs.size());
  contacts.count = find(candidates, grains, all_pairs, touching_.pair.data());
  contacts.reserve(contacts.count);
  name(candidates.pairs, touching_.pair.data(), {0, contacts.count}, grains, contacts);
  pad(contacts);
  geometry(grains, {0, contacts.count}, contacts);
}

template <int D>
void ContactStages<D>::remembered_forces(const Grains<D>& grains, Part range, Contacts<D>& contacts,
                                         double duration) {
  memory_.carry(grains, contacts, duration, range, isa_);
  std::fill(contacts.stored.data() + range.begin, contacts.stored.data() + range.end, 0.0);
  normal_forces(range, contacts, duration);
  shear_forces(range, contacts, duration);
}

template <int D>
void ContactStages<D>::normal_forces(Part range, Contacts<D>& contacts, double duration) {
  const double inverse_duration = duration > 0 ? 1 / duration : 0;
  laws_.normal(contacts.law.data(), [&]<class Choice>(const Choice& choice) {
    using Law = typename Choice::Law;
    const double *xi = contacts.overlap.data(), *dxi = contacts.closing.data();
    const double *m = contacts.m_eff.data(), *R = contacts.r_eff.data();
    double *force = contacts.normal_force.data(), *loss = contacts.normal_loss.data();
    if constexpr (laws::NormalWithMemory<Law>) {
      std::array<double*, static_cast<std::size_t>(Law::memory)> columns;
      for (int k = 0; k < Law::memory; ++k) columns[static_cast<std::size_t>(k)] = memory_.normal_column(k);
      remembering_normal(choice, columns, inverse_duration, xi, dxi, m, R, range, force, loss,
                         contacts.stored.data());
    } else {
      const double least = laws_.first().attraction ? -std::numeric_limits<double>::infinity() : 0.0;
      const auto run = [&]<EndsOfContacts ends>() {
        run_kernel(isa_, NormalKernel<Choice, ends>{choice, laws_.ends(), least, xi, dxi, m, R,
                                                    whole_vectors(range, contacts.count), force, loss,
                                                    contacts.weight.data()});
      };
      if constexpr (acts_at_once<Law>) {
        if (apart() > 0) return run.template operator()<EndsOfContacts::mean>();
        if (laws_.ends().on()) return run.template operator()<EndsOfContacts::inside>();
      }
      run.template operator()<EndsOfContacts::sampled>();
    }
  });
}

template <int D>
void ContactStages<D>::shear_forces(Part range, Contacts<D>& contacts, double duration) {
  const std::array<Array, turns<D>>& slip = contacts.slip;
  laws_.shear(contacts.law.data(), [&]<class Choice>(const Choice& choice) {
    if constexpr (laws::ShearWithMemory<typename Choice::Law>)
      run_kernel(isa_, remembering(choice, range, contacts, duration));
    else
      run_kernel(isa_, ShearKernel<Choice, turns<D>>{
                           choice, pointers(slip), contacts.normal_force.data(), contacts.m_eff.data(),
                           contacts.weight.data(), whole_vectors(range, contacts.count),
                           pointers(contacts.shear_force), contacts.shear_loss.data()});
  });
}

template <int D>
template <class Choice>
RememberingShearKernel<Choice, turns<D>> ContactStages<D>::remembering(const Choice& choice, Part range,
                                                                       Contacts<D>& contacts,
                                                                       double duration) {
  using Law = typename Choice::Law;
  RememberingShearKernel<Choice, turns<D>> kernel{};
  kernel.choice = choice, kernel.duration = duration, kernel.range = range, kernel.source = memory_.source();
  kernel.normal_force = contacts.normal_force.data(), kernel.overlap = contacts.overlap.data();
  kernel.m_eff = contacts.m_eff.data(), kernel.r_eff = contacts.r_eff.data();
  kernel.stored_before = memory_.stored_column(), kernel.stored = contacts.stored.data();
  kernel.loss = contacts.shear_loss.data();
  for (int k = 0; k < turns<D>; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    kernel.way[axis] = memory_.way(k), kernel.slip[axis] = contacts.slip[axis].data();
    kernel.previous_force[axis] = memory_.previous_force(k);
    kernel.force[axis] = contacts.shear_force[axis].data();
    for (int v = 0; v < Law::vectors; ++v)
      kernel.vector[static_cast<std::size_t>(v)][axis] = memory_.vector_column(v, k);
  }
  for (int s = 0; s < Law::scalars; ++s)
    kernel.scalar[static_cast<std::size_t>(s)] = memory_.scalar_column(s);
  return kernel;
}

template <int D>
void ContactStages<D>::evaluate_found(const Grains<D>& grains, Contacts<D>& contacts, double duration) {
  pad(contacts);
  const Part all{0, contacts.count};
  if (!memory_.needed()) {
    normal_forces(all, contacts, duration);
    shear_forces(all, contacts, duration);
    return;
  }
  memory_.match(contacts, duration);
  remembered_forces(grains, all, contacts, duration);
}

template <int D>
void ContactStages<D>::apply_first(const Contacts<D>& contacts, const Grains<D>& grains, double duration,
                                   GrainSums<D>& sums) const {
  const Adder<D> add(contacts, grains, sums);
  for (std::size_t c = 0; c < contacts.count; ++c) add.forces(c, true, false);
  add_losses(contacts, {0, contacts.count}, duration, sums);
}

/// A grain's sums are in the order of its contacts, whoever computes them: those with grains before the
/// range, which come first, and then those that begin in it.
template <int D>
void ContactStages<D>::apply(const Contacts<D>& contacts, const Grains<D>& grains, double duration,
                             GrainSums<D>& sums, Team& team) const {
  const Adder<D> add(contacts, grains, sums);
  if (team.size() == 1) {
    for (std::size_t c = 0; c < contacts.count; ++c) add.forces(c, true, true);
    add_losses(contacts, {0, contacts.count}, duration, sums);
    return;
  }
  team.run([&](std::size_t member) {
    Part own = team.part(grains.moving, member);
    if (member + 1 == team.size()) own.end = grains.size();  // with the bed
    const auto is_own = [&](std::int32_t j) {
      return static_cast<std::size_t>(j) >= own.begin && static_cast<std::size_t>(j) < own.end;
    };
    const std::size_t first = first_of(contacts, own.begin), last = first_of(contacts, own.end);
    for (std::size_t c = 0; c < first; ++c)
      if (is_own(contacts.j[c])) add.forces(c, false, true);
    for (std::size_t c = first; c < last; ++c) add.forces(c, true, is_own(contacts.j[c]));
    add_losses(contacts, {first, last}, duration, sums);
  });
}

template <int D>
void ContactStages<D>::apply_forces(const Contacts<D>& contacts, const Grains<D>& grains,
                                    GrainSums<D>& sums) const {
  const Adder<D> add(contacts, grains, sums);
  for (std::size_t c = 0; c < contacts.count; ++c)
    add.forces(c, true, static_cast<std::size_t>(contacts.j[c]) < grains.moving);
}

template <int D>
void ContactStages<D>::apply_losses(const Contacts<D>& contacts, Part range, double duration,
                                    GrainSums<D>& sums) const {
  add_losses(contacts, {first_of(contacts, range.begin), first_of(contacts, range.end)}, duration, sums);
}

template <int D>
double ContactStages<D>::elastic_energy(const Contacts<D>& contacts) const {
  double sum = 0;
  laws_.normal(contacts.law.data(), [&]<class Choice>(const Choice& law) {
    if constexpr (!laws::NormalWithMemory<typename Choice::Law>)
      for (std::size_t c = 0; c < contacts.count; ++c)
        sum += law(c).energy(std::max(0.0, contacts.overlap[c]),
                             laws::Pair(contacts.m_eff[c], contacts.r_eff[c]));
  });
  if (memory_.needed())
    for (std::size_t c = 0; c < contacts.count; ++c) sum += contacts.stored[c];
  return sum;
}

template struct Contacts<2>;
template struct Contacts<3>;
template class ContactStages<2>;
template class ContactStages<3>;

}  // namespace chute::soft
