#include "engines/dsmc/cell_collisions.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engines/dsmc/hard_gas.hpp"

namespace chute::dsmc {
namespace {

/// Cells are shared out and summed up in chunks, so that sums do not depend on threads.
constexpr std::size_t cells_at_once = 64;

/// Four random words of 32 bits at a time.
struct Words {
  std::uint64_t a, b;
  explicit Words(Random& random) : a(random()), b(random()) {}
  static double unit(std::uint64_t word) {
    return (static_cast<double>(static_cast<std::uint32_t>(word)) + 0.5) * 0x1p-32;
  }
  double first() const { return unit(a); }
  double second() const { return unit(a >> 32); }
  double third() const { return unit(b); }
  double fourth() const { return unit(b >> 32); }
};

/// A direction on the half of the unit circle (sphere) that `along` points to, as likely as its component along it: the
/// impact parameter is even in [−1, 1], or its square in [0, 1].
template <int D>
Vec<D> facing_direction(const Vec<D>& along, double u, double w) {
  if constexpr (D == 2) {
    const double b = 2 * u - 1, c = std::sqrt(1 - b * b);
    return {{c * along[0] - b * along[1], c * along[1] + b * along[0]}};
  } else {
    const double b = std::sqrt(u), c = std::sqrt(1 - u), angle = 2 * std::numbers::pi * w;
    const Vec<3> other = std::abs(along[0]) < 0.6 ? Vec<3>{{1, 0, 0}} : Vec<3>{{0, 1, 0}};
    Vec<3> s = cross(along, other);
    s = (1 / norm(s)) * s;
    return c * along + b * std::cos(angle) * s + b * std::sin(angle) * cross(along, s);
  }
}

/// A direction evenly from the whole circle (sphere).
template <int D>
Vec<D> any_direction(double u, double w) {
  const double angle = 2 * std::numbers::pi * u;
  if constexpr (D == 2) {
    return {{std::cos(angle), std::sin(angle)}};
  } else {
    const double z = 2 * w - 1, r = std::sqrt(1 - z * z);
    return {{r * std::cos(angle), r * std::sin(angle), z}};
  }
}

template <int D>
void put_back(Grains<D>& grains, std::size_t i, const laws::Collider<D>& c) {
  for (int k = 0; k < D; ++k) grains.velocity[static_cast<std::size_t>(k)][i] = c.velocity[k];
  for (std::size_t k = 0; k < turns<D>; ++k) grains.spin[k][i] = c.spin[static_cast<int>(k)];
}

/// A number whose mean is `mean`, one of the two whole ones beside it.
std::int64_t whole_number(double mean, Random& random) {
  return static_cast<std::int64_t>(std::floor(mean + random.uniform()));
}

}  // namespace

template <int D>
CellCollisions<D>::CellCollisions(const Grains<D>& grains, const DsmcSetup<D>& setup)
    : setup_(setup),
      rough_(setup.contact.tangential.friction > 0 && setup.contact.tangential.beta > -1),
      buffers_(static_cast<std::size_t>(setup.threads)) {
  const auto end = grains.radius.begin() + static_cast<std::ptrdiff_t>(grains.moving);
  const auto [least, most] = std::minmax_element(grains.radius.begin(), end);
  widest_ = 2 * *most;
  equal_ = *least == *most;
  alike_ = equal_;
  for (std::size_t i = 1; i < grains.moving; ++i)
    alike_ = alike_ && grains.inverse_mass[i] == grains.inverse_mass[0] &&
             grains.inverse_inertia[i] == grains.inverse_inertia[0];
}

/// Asks for what the cell after next will need: its grains lie anywhere in memory.
template <int D>
void CellCollisions<D>::fetch_ahead(const Grains<D>& grains, const GasCells<D>& cells,
                                    std::size_t cell) const {
  constexpr std::size_t ahead = 2;
  if (cell + ahead >= cells.count()) return;
  for (const auto i : cells.members(cell + ahead)) {
    for (const auto& v : grains.velocity) __builtin_prefetch(&v[i], 1);
    if (!rough_) continue;
    for (const auto& w : grains.spin) __builtin_prefetch(&w[i], 1);
  }
}

template <int D>
laws::Collider<D> CellCollisions<D>::collider(const Grains<D>& grains, std::size_t i, const Vec<D>& v) const {
  const std::size_t like = alike_ ? 0 : i;  // which is at hand
  return {v, {}, grains.radius[like], grains.inverse_mass[like], grains.inverse_inertia[like]};
}

template <int D>
Tally CellCollisions<D>::collide(Grains<D>& grains, const GasCells<D>& cells, std::uint64_t step,
                                 Team& team) {
  if (setup_.dense == Dense::esmc) return collide_coloured(grains, cells, step, team);
  const std::size_t chunks = (cells.count() + cells_at_once - 1) / cells_at_once;
  of_chunk_.resize(chunks);
  for (auto& c : of_chunk_) c = {};
  team.run([&](std::size_t k) {
    for (std::size_t at = chunks * k / team.size(); at < chunks * (k + 1) / team.size(); ++at)
      for (std::size_t c = at * cells_at_once; c < std::min((at + 1) * cells_at_once, cells.count()); ++c)
        in_cell(grains, cells, c, step, buffers_[k], of_chunk_[at].tally);
  });
  Tally sum;
  for (const auto& c : of_chunk_) sum += c.tally;
  return sum;
}

template <int D>
void CellCollisions<D>::in_cell(Grains<D>& grains, const GasCells<D>& cells, std::size_t cell,
                                std::uint64_t step, Buffer& buffer, Tally& tally) const {
  fetch_ahead(grains, cells, cell);
  const auto ids = cells.members(cell);
  const std::size_t N = ids.size();
  if (N < 2) return;
  auto& v = buffer.velocity;
  auto& spin = buffer.spin;
  v.resize(N);
  if (rough_) spin.resize(N);
  Vec<D> mean{};
  for (std::size_t n = 0; n < N; ++n) {
    v[n] = grains.speed(ids[n]);
    if (rough_) spin[n] = grains.turning(ids[n]);
    mean = mean + v[n];
  }
  mean = (1 / static_cast<double>(N)) * mean;
  double farthest = 0;
  for (std::size_t n = 0; n < N; ++n) {
    const Vec<D> off = v[n] - mean;
    farthest = std::max(farthest, dot(off, off));
  }
  double v_max = 2 * std::sqrt(farthest);
  const double pairs = static_cast<double>(N * (N - 1));
  const double factor = setup_.dense == Dense::rate ? cells.crowding(cell) : 1;
  const double mean_candidates = 0.5 * pairs * setup_.weight * factor * std::pow(widest_, D - 1) * facing<D> *
                                 v_max * setup_.time_step / cells.volume(cell);
  if (!(mean_candidates > 0)) return;
  Random random(setup_.seed, Purpose::engine, item::cells + cell, step);
  bool changed = false;
  for (auto left = whole_number(mean_candidates, random); left-- > 0;) {
    const Words words(random);
    const auto pair = static_cast<std::size_t>(words.first() * pairs);
    const std::size_t a = pair / (N - 1), other = pair % (N - 1), b = other + (other >= a);
    const Vec<D> relative = v[a] - v[b];
    const double square = dot(relative, relative);
    if (square > v_max * v_max) v_max = std::sqrt(square), ++tally.raised;
    double bound = words.second() * v_max;
    if (!equal_) bound /= std::pow((grains.radius[ids[a]] + grains.radius[ids[b]]) / widest_, D - 1);
    if (!(square > bound * bound)) continue;
    const Vec<D> n = facing_direction<D>((1 / std::sqrt(square)) * relative, words.third(), words.fourth());
    auto i = collider(grains, ids[a], v[a]), j = collider(grains, ids[b], v[b]);
    if (rough_) i.spin = spin[a], j.spin = spin[b];
    const auto done = setup_.contact.tangential(n, setup_.contact.restitution, i, j);
    v[a] = i.velocity, v[b] = j.velocity;
    if (rough_) spin[a] = i.spin, spin[b] = j.spin;
    ++tally.collisions;
    tally.normal_loss += done.normal_loss, tally.shear_loss += done.shear_loss;
    changed = true;
  }
  if (!changed) return;
  for (std::size_t n = 0; n < N; ++n) {
    for (int k = 0; k < D; ++k) grains.velocity[static_cast<std::size_t>(k)][ids[n]] = v[n][k];
    if (rough_)
      for (std::size_t k = 0; k < turns<D>; ++k) grains.spin[k][ids[n]] = spin[n][static_cast<int>(k)];
  }
}

/// Montanero & Santos: a grain i, a direction σ̂, and a partner from the cell at r_i + d σ̂, accepted with probability
/// proportional to χ n there and to Θ(v·σ̂)(v·σ̂). Each collision counts for both, so half of the grains are asked.
template <int D>
void CellCollisions<D>::with_neighbours(Grains<D>& grains, const GasCells<D>& cells, std::size_t cell,
                                        std::uint64_t step, Chunk& mine) const {
  auto& tally = mine.tally;
  const auto ids = cells.members(cell);
  if (ids.empty()) return;
  // χ w/V of a cell, by which its number of grains is multiplied.
  const auto crowding = [&](std::size_t c) { return cells.crowding(c) * setup_.weight / cells.volume(c); };
  double most = 0, fastest = 0;
  Vec<D> mean{};
  for (const auto i : ids) mean = mean + grains.speed(i);
  mean = (1 / static_cast<double>(ids.size())) * mean;
  cells.around(cell, [&](std::size_t c) {
    const auto others = cells.members(c);
    most = std::max(most, crowding(c) * static_cast<double>(others.size()));
    for (const auto j : others) {
      const Vec<D> off = grains.speed(j) - mean;
      fastest = std::max(fastest, dot(off, off));
    }
  });
  double v_max = 2 * std::sqrt(fastest);
  const double mean_candidates = 0.5 * static_cast<double>(ids.size()) * whole_sphere<D> *
                                 std::pow(widest_, D - 1) * most * v_max * setup_.time_step;
  if (!(mean_candidates > 0)) return;
  Random random(setup_.seed, Purpose::engine, item::cells + cell, step);
  for (auto left = whole_number(mean_candidates, random); left-- > 0;) {
    const Words words(random), more(random);
    const std::size_t a = ids[static_cast<std::size_t>(words.first() * static_cast<double>(ids.size()))];
    const Vec<D> n = any_direction<D>(words.second(), words.third());
    Vec<D> there = grains.place(a) + widest_ * n;
    std::array<int, D> laps{};
    hard::Flight<D>::wrap(there, laps, setup_.domain);
    const auto partner_cell = cells.cell_of(there);
    if (partner_cell == GasCells<D>::outside) continue;
    const auto partners = cells.members(partner_cell);
    if (partners.empty()) continue;
    const std::size_t b =
        partners[static_cast<std::size_t>(words.fourth() * static_cast<double>(partners.size()))];
    if (a == b) continue;
    const double approach = dot(grains.speed(a) - grains.speed(b), n);
    if (!(approach > 0)) continue;
    if (approach > v_max) v_max = approach, ++tally.raised;
    double chance = approach / v_max * crowding(partner_cell) * static_cast<double>(partners.size()) / most;
    if (!equal_) chance *= std::pow((grains.radius[a] + grains.radius[b]) / widest_, D - 1);
    if (!(more.first() < chance)) continue;
    auto i = collider(grains, a, grains.speed(a)), j = collider(grains, b, grains.speed(b));
    i.spin = grains.turning(a), j.spin = grains.turning(b);
    const auto done = setup_.contact.tangential(n, setup_.contact.restitution, i, j);
    put_back(grains, a, i), put_back(grains, b, j);
    ++tally.collisions;
    tally.normal_loss += done.normal_loss, tally.shear_loss += done.shear_loss;
    if (!collecting_) continue;
    const bool first = a < b;
    Collision& kept = mine.kept.emplace_back();
    kept.a = static_cast<std::int64_t>(std::min(a, b)), kept.b = static_cast<std::int64_t>(std::max(a, b));
    const Vec<D> along = first ? n : -1 * n;
    kept.point = as_file_vector(grains.place(std::min(a, b)) + grains.radius[std::min(a, b)] * along);
    kept.branch = as_file_vector((grains.radius[a] + grains.radius[b]) * along);
    set_force(kept, along, first ? done.impulse : -1 * done.impulse);
    kept.time = static_cast<double>(step + 1) * setup_.time_step;
  }
}

/// A cell changes grains of the cells beside it, so that only cells at least three apart are worked on at the same time:
/// they have the same colour. Cells left over at the end of a period have colours of their own.
template <int D>
Tally CellCollisions<D>::collide_coloured(Grains<D>& grains, const GasCells<D>& cells, std::uint64_t step,
                                          Team& team) {
  constexpr std::size_t kinds = 5;
  std::array<std::array<std::vector<int>, kinds>, D> along;
  std::size_t colours = 1;
  for (std::size_t k = 0; k < D; ++k) {
    const int n = cells.along()[k], rest = cells.periodic(static_cast<int>(k)) ? n % 3 : 0;
    for (int at = 0; at < n; ++at)
      along[k][static_cast<std::size_t>(at >= n - rest ? 3 + at - (n - rest) : at % 3)].push_back(at);
    colours *= kinds;
  }
  Tally sum;
  for (std::size_t colour = 0; colour < colours; ++colour) {
    std::array<const std::vector<int>*, D> lists;
    std::size_t total = 1;
    for (std::size_t k = 0, rest = colour; k < D; ++k, rest /= kinds) {
      lists[k] = &along[k][rest % kinds];
      total *= lists[k]->size();
    }
    if (total == 0) continue;
    const std::size_t chunks = (total + cells_at_once - 1) / cells_at_once;
    of_chunk_.resize(chunks);
    for (auto& c : of_chunk_) c = {};
    team.run([&](std::size_t member) {
      for (std::size_t c = chunks * member / team.size(); c < chunks * (member + 1) / team.size(); ++c)
        for (std::size_t one = c * cells_at_once; one < std::min((c + 1) * cells_at_once, total); ++one) {
          typename GasCells<D>::Index at;
          for (std::size_t k = 0, rest = one; k < D; ++k) {
            at[k] = (*lists[k])[rest % lists[k]->size()];
            rest /= lists[k]->size();
          }
          with_neighbours(grains, cells, cells.number(at), step, of_chunk_[c]);
        }
    });
    for (const auto& c : of_chunk_) {
      sum += c.tally;
      kept_.insert(kept_.end(), c.kept.begin(), c.kept.end());
    }
  }
  return sum;
}

template class CellCollisions<2>;
template class CellCollisions<3>;

}  // namespace chute::dsmc
