#include "engines/restructuring/restructuring_engine.hpp"

#include <fmt/format.h>

#include <cereal/types/array.hpp>
#include <cereal/types/vector.hpp>
#include <numeric>

#include "common/error.hpp"
#include "common/state_archive.hpp"
#include "engines/kind/packing.hpp"
#include "engines/monte_carlo/monte_carlo_engine.hpp"

namespace chute::restructuring {
namespace {

/// The walls as bounds, and which of them it is.
template <int D>
Bounds bounds_of(const std::vector<Wall<D>>& walls, std::size_t& which) {
  Bounds bounds;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const auto& wall = walls[w];
    if (const auto* round = wall.cylinder(); round && D == 2 && walls.size() == 1) {
      bounds.drum = {{{wall.point[0], wall.point[D - 1]}}, round->radius, wall.surface.friction.value_or(0)};
      return bounds;
    }
    if (wall.normal[D - 1] != 1)
      throw WorkError("restructuring lays grains on a level floor or in a drum; it knows no other wall");
    if (wall.point[D - 1] > bounds.floor) bounds.floor = wall.point[D - 1], which = w;
  }
  return bounds;
}

}  // namespace

template <int D>
RestructuringEngine<D>::RestructuringEngine(Grains<D> grains, const RestructuringSetup<D>& setup)
    : setup_(setup),
      grains_(std::move(grains)),
      bounds_(bounds_of<D>(setup.walls, wall_)),
      columns_(grains_, setup_.domain),
      placer_(columns_, bounds_),
      supports_(grains_.moving),
      start_place_(grains_.position) {
  if (bounds_.drum && !(*std::ranges::max_element(grains_.radius) < bounds_.drum->radius))
    throw WorkError("a grain is larger than the drum");
  for (auto& force : no_force_) force.assign(grains_.size(), 0);
  for (int k = 0; k < D; ++k) {
    std::fill_n(grains_.velocity[static_cast<std::size_t>(k)].begin(), grains_.moving, 0.0);
  }
  for (auto& spin : grains_.spin) std::fill_n(spin.begin(), grains_.moving, 0.0);
}

template <int D>
void RestructuringEngine<D>::advance(std::int64_t step) {
  while (step_ < step) shake();
}

template <int D>
void RestructuringEngine<D>::shake() {
  ++step_;
  events_ = 0;
  if (setup_.loosening && step_ > 1) loosen();
  if (step_ > 1) turn();
  const bool cooperative = setup_.stabilise == Stabilise::cooperative && step_ > 1;
  columns_.clear();
  for (std::size_t j = grains_.moving; j < grains_.size(); ++j)
    columns_.lay({grains_.place(j), grains_.radius[j], static_cast<std::int32_t>(j)});
  std::vector<std::size_t> order(grains_.moving);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const bool rains = setup_.rain != Rain::none && step_ == 1;
  const auto& height = grains_.position[D - 1];
  if (!rains)
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
      return height[a] != height[b] ? height[a] < height[b] : a < b;
    });
  const auto as_it_lies = [&](std::size_t i) {
    return Placed<D>{grains_.place(i), grains_.radius[i], static_cast<std::int32_t>(i)};
  };
  if (cooperative)
    for (const auto i : order) columns_.lay(as_it_lies(i));
  for (const auto i : order) {
    if (cooperative) columns_.take(as_it_lies(i));
    lay(i, cooperative ? height[i] : std::numeric_limits<double>::infinity());
  }
}

/// The drum turns, and everything in it as one body.
template <int D>
void RestructuringEngine<D>::turn() {
  if (!bounds_.drum || setup_.turn == 0) return;
  const double sine = std::sin(setup_.turn), cosine = std::cos(setup_.turn);
  const auto& middle = bounds_.drum->centre;
  auto &x = grains_.position[0], &z = grains_.position[D - 1];
  for (std::size_t i = 0; i < grains_.moving; ++i) {
    const double along = x[i] - middle[0], above = z[i] - middle[1];
    x[i] = middle[0] + cosine * along - sine * above;
    z[i] = middle[1] + sine * along + cosine * above;
    if constexpr (D == 2) grains_.orientation[0][i] += setup_.turn;
  }
}

template <int D>
void RestructuringEngine<D>::loosen() {
  // Grains that touch do so up to rounding, and hard ones must not overlap by an ulp.
  constexpr double rounding = 1e-9;
  constexpr std::int64_t between_looks = 5;
  const auto& how = *setup_.loosening;
  monte_carlo::MonteCarloSetup<D> moves{setup_.surroundings()};
  moves.seed = setup_.seed + (static_cast<std::uint64_t>(step_) << 32);  // other numbers in every shake
  moves.step = how.step;
  auto grains = grains_;
  for (auto& radius : grains.radius) radius *= 1 - rounding;
  auto& z = grains.position[D - 1];
  for (std::size_t i = 0; i < grains.moving; ++i) z[i] *= 1 + how.expand;
  monte_carlo::MonteCarloEngine<D> mover(std::move(grains), moves);
  const auto fraction = [&] {
    return engines::packing_of(mover.state(), setup_.domain, setup_.frame).fraction;
  };
  loosened_ = fraction();
  for (std::int64_t done = 0; done < how.sweeps && !(loosened_ >= how.density);) {
    done = std::min(how.sweeps, done + between_looks);
    mover.advance_to(done);
    loosened_ = fraction();
  }
  grains_.position = mover.state().position;
  grains_.wraps = mover.state().wraps;
}

template <int D>
void RestructuringEngine<D>::lay(std::size_t i, double from) {
  Random random(setup_.seed, Purpose::engine, i, static_cast<std::uint64_t>(step_));
  Vec<D> place = grains_.place(i);
  const auto& domain = setup_.domain;
  for (int k = 0; k + 1 < D; ++k) {
    const double length = domain.periodic(k) ? domain.length[k] : 0;
    if (setup_.rain != Rain::none && step_ == 1) {
      const double part = setup_.rain == Rain::line ? random.uniform() : 0.5;
      place[k] = bounds_.drum ? bounds_.drum->centre[0] + (2 * part - 1) * bounds_.drum->radius
                              : domain.lower[k] + part * length;
    }
    if (setup_.jolt > 0) place[k] += random.uniform(-setup_.jolt, setup_.jolt);
  }
  const auto rest = placer_.place(place, grains_.radius[i], random, from);
  if (!rest)
    leave_physics(i, bounds_.drum
                         ? std::string("it found no rest: the drum is too full")
                         : fmt::format("it found no rest: it fell through the bed, or its way has more "
                                       "than {} events",
                                       Placer<D>::most_events));
  Supports& supports = supports_[i];
  supports.count = 0;
  for (int k = 0; k < rest->count; ++k)
    supports.id[static_cast<std::size_t>(supports.count++)] = rest->supports[static_cast<std::size_t>(k)];
  if (rest->on_floor) supports.id[static_cast<std::size_t>(supports.count++)] = wall_id(0);
  place = rest->place;
  for (int k = 0; k < D; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    if (domain.periodic(k)) {
      const double laps = std::floor((place[k] - domain.lower[k]) / domain.length[k]);
      place[k] -= laps * domain.length[k];
      grains_.wraps[axis][i] += static_cast<int>(laps);
    }
    grains_.position[axis][i] = place[k];
  }
  columns_.lay({place, grains_.radius[i], static_cast<std::int32_t>(i)});
  events_ += rest->events;
}

template <int D>
EnergyAccount RestructuringEngine<D>::energy() const {
  EnergyAccount e;
  e.add_motion(grains(), setup_.gravity, start_place_);
  e.normal_loss = e.gravity_work;  // grains arrive without speed: all that gravity did is lost on the way
  return e;
}

/// A cooperative grain may have gone on since another was laid on it.
template <int D>
bool RestructuringEngine<D>::still_touch(double way, double reach) const {
  constexpr double slack = 1e-8;
  return setup_.stabilise == Stabilise::sequential || way < (1 + slack) * reach;
}

template <int D>
std::vector<Contact> RestructuringEngine<D>::contacts() const {
  std::vector<Contact> list;
  for (std::size_t i = 0; i < grains_.moving; ++i)
    for (int s = 0; s < supports_[i].count; ++s) {
      const auto other = supports_[i].id[static_cast<std::size_t>(s)];
      Contact contact;
      Vec<D> way{};
      double own = grains_.radius[i];
      if (is_wall(other)) {
        const auto touch = setup_.walls[wall_].nearest(grains_.place(i), 0, setup_.domain);
        way = -touch.height * touch.normal;
        contact.a = static_cast<std::int64_t>(i), contact.b = other;
      } else {
        const auto j = static_cast<std::size_t>(other), a = std::min(i, j), b = std::max(i, j);
        way = setup_.domain.way(grains_.place(a), grains_.place(b));
        own = grains_.radius[a];
        contact.a = static_cast<std::int64_t>(a), contact.b = static_cast<std::int64_t>(b);
      }
      const Vec<D> n = (1 / norm(way)) * way;
      if (!still_touch(norm(way),
                       own + (is_wall(other) ? 0 : grains_.radius[static_cast<std::size_t>(contact.b)])))
        continue;
      contact.branch = as_file_vector(way);
      contact.normal = as_file_vector(n);
      contact.point = as_file_vector(grains_.place(static_cast<std::size_t>(contact.a)) + own * n);
      list.push_back(contact);
    }
  std::ranges::sort(list,
                    [](const Contact& x, const Contact& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
  return list;
}

template <int D>
std::vector<std::pair<std::string, double>> RestructuringEngine<D>::tells() const {
  const auto packing = engines::packing_of(grains_, setup_.domain, setup_.frame);
  // Each contact counts for both of its grains; one with the bed or the floor for one.
  std::int64_t ends = 0;
  for (const auto& contact : contacts())
    ends += contact.b >= 0 && contact.b < static_cast<std::int64_t>(grains_.moving) ? 2 : 1;
  const auto n = static_cast<double>(grains_.moving);
  std::vector<std::pair<std::string, double>> list{{"packing_fraction", packing.fraction},
                                                   {"mean_height", packing.mean_height},
                                                   {"tracer", packing.tracer},
                                                   {"coordination", static_cast<double>(ends) / n},
                                                   {"events", static_cast<double>(events_) / n}};
  if (setup_.loosening) list.emplace_back("loosened_fraction", loosened_);
  if (bounds_.drum) add_drum(list);
  return list;
}

/// What a drum tells. A bed with a straight surface is the same on both sides of the line through its middle that is upright
/// on the surface, and so is the drum: that line goes through the drum's axis, and its slope is the surface's.
template <int D>
void RestructuringEngine<D>::add_drum(std::vector<std::pair<std::string, double>>& list) const {
  const auto &x = grains_.position[0], &z = grains_.position[D - 1];
  const auto n = static_cast<double>(grains_.moving);
  double along = 0, above = 0, mass = 0, size = 0;
  for (std::size_t i = 0; i < grains_.moving; ++i) {
    along += grains_.mass[i] * x[i], above += grains_.mass[i] * z[i], mass += grains_.mass[i];
    size += grains_.radius[i] / n;
  }
  along /= mass, above /= mass;
  const auto& middle = bounds_.drum->centre;
  list.emplace_back("surface_angle", std::atan2(along - middle[0], middle[1] - above));
  double square[2] = {}, count[2] = {};  // of smaller and larger grains
  for (std::size_t i = 0; i < grains_.moving; ++i) {
    const std::size_t large = grains_.radius[i] > size;
    square[large] += std::pow(x[i] - along, 2) + std::pow(z[i] - above, 2), ++count[large];
  }
  list.emplace_back("core", count[0] > 0 && count[1] > 0
                                ? std::sqrt(square[0] / count[0] / (square[1] / count[1]))
                                : std::numeric_limits<double>::quiet_NaN());
}

template <int D>
void RestructuringEngine<D>::save(std::ostream& out) const {
  StateOutput archive(out);
  archive(step_, events_, grains_, supports_, loosened_);
}

template <int D>
void RestructuringEngine<D>::restore(std::istream& in) {
  StateInput archive(in);
  archive(step_, events_, kept(grains_), kept(supports_), loosened_);
  for (const auto& supports : supports_)
    if (supports.count < 0 || supports.count > D + 1) wrong_state();
}

template class RestructuringEngine<2>;
template class RestructuringEngine<3>;

}  // namespace chute::restructuring
