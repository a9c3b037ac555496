#include "engines/dsmc/dsmc_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cereal/types/array.hpp>
#include <cereal/types/vector.hpp>
#include <cmath>

#include "common/error.hpp"
#include "common/state_archive.hpp"
#include "engines/dsmc/hard_gas.hpp"

namespace chute::dsmc {
namespace {

/// Grains that one thread takes at a time; sums are made of these.
constexpr std::size_t chunk = 1024;

/// Whether it is still a gas is looked at now and then, and whenever somebody looks.
constexpr std::int64_t steps_between_checks = 50;

}  // namespace

template <int D>
DsmcEngine<D>::DsmcEngine(Grains<D> grains, const DsmcSetup<D>& setup)
    : setup_(setup),
      grains_(std::move(grains)),
      obstacles_(grains_, setup_),
      cells_(grains_, setup_, obstacles_),
      collisions_(grains_, setup_),
      team_(std::make_unique<Team>(setup.threads)) {
  wrap_into(setup_.domain, grains_);
  chunks_.resize((grains_.moving + chunk - 1) / chunk);
  start_potential_ = gravity_potential();
  start_energy_ = energy().stored();
}

/// Σ m g·r, counted on through the periods: gravity's work is its growth.
template <int D>
double DsmcEngine<D>::gravity_potential() const {
  double sum = 0;
  const auto view = grains();
  for (std::size_t k = 0; k < D; ++k) {
    const double g = setup_.gravity[static_cast<int>(k)];
    if (g == 0) continue;
    for (std::size_t i = 0; i < grains_.moving; ++i) sum += grains_.mass[i] * g * view.unwrapped(i, k);
  }
  return sum;
}

template <int D>
void DsmcEngine<D>::advance(std::int64_t step) {
  if (step <= step_) return;
  while (step_ < step) {
    take_step();
    if (step_ % steps_between_checks == 0) check_physics();
  }
  check_physics();
}

template <int D>
void DsmcEngine<D>::take_step() {
  fly();
  cells_.fill(grains_, *team_);
  tally_ += collisions_.collide(grains_, cells_, static_cast<std::uint64_t>(step_), *team_);
  if (setup_.heating > 0) heat();
  ++step_;
}

template <int D>
void DsmcEngine<D>::fly() {
  const double end = static_cast<double>(step_ + 1) * setup_.time_step;
  team_->run([&](std::size_t k) {
    for (std::size_t c = chunks_.size() * k / team_->size(); c < chunks_.size() * (k + 1) / team_->size();
         ++c) {
      const Part part{c * chunk, std::min((c + 1) * chunk, grains_.moving)};
      obstacles_.none() ? fly_freely(part) : fly_among_obstacles(part, end, c);
    }
  });
  if (obstacles_.none()) return;
  for (auto& c : chunks_) {
    tally_ += c.tally, stopped_ += c.stopped;
    impacts_.insert(impacts_.end(), c.impacts.begin(), c.impacts.end());
    c = {};
  }
  const auto fresh = std::stable_partition(impacts_.begin(), impacts_.end(),
                                           [&](const Impact& i) { return i.time <= end - setup_.time_step; });
  std::stable_sort(fresh, impacts_.end(), [](const Impact& a, const Impact& b) { return a.time < b.time; });
}

/// (2.19), (2.20) with nothing in the way.
template <int D>
void DsmcEngine<D>::fly_freely(Part part) {
  const double dt = setup_.time_step;
  for (std::size_t k = 0; k < D; ++k) {
    const double g = setup_.gravity[static_cast<int>(k)], fall = 0.5 * g * dt * dt;
    double *x = grains_.position[k].data(), *v = grains_.velocity[k].data();
    for (std::size_t i = part.begin; i < part.end; ++i) x[i] += v[i] * dt + fall, v[i] += g * dt;
    if (!setup_.domain.periodic(static_cast<int>(k))) continue;
    const double low = setup_.domain.lower[static_cast<int>(k)],
                 period = setup_.domain.length[static_cast<int>(k)];
    for (std::size_t i = part.begin; i < part.end; ++i) {
      if (x[i] >= low && x[i] < low + period) continue;
      const double laps = std::floor((x[i] - low) / period);
      x[i] -= laps * period;
      grains_.wraps[k][i] += static_cast<int>(laps);
    }
  }
  for (std::size_t i = part.begin; i < part.end; ++i) {
    const auto spin = grains_.turning(i);
    if (dot(spin, spin) == 0) continue;
    const auto now = turned<D>(grains_.attitude(i), spin, dt);
    for (std::size_t k = 0; k < orientation_numbers<D>; ++k)
      grains_.orientation[k][i] = now[static_cast<int>(k)];
  }
}

template <int D>
void DsmcEngine<D>::fly_among_obstacles(Part part, double end, std::size_t c) {
  auto& mine = chunks_[c];
  for (std::size_t i = part.begin; i < part.end; ++i) {
    hard::Flight<D> flight{grains_.place(i), grains_.speed(i), setup_.gravity, grains_.turning(i),
                           grains_.attitude(i)};
    for (std::size_t k = 0; k < D; ++k) flight.wraps[k] = grains_.wraps[k][i];
    flight.time = end - setup_.time_step;
    flight.radius = grains_.radius[i];
    Random random(setup_.seed, Purpose::engine, item::walls + i, static_cast<std::uint64_t>(step_));
    if (!obstacles_.fly(i, flight, end, random, mine.tally, collecting_ ? &mine.impacts : nullptr))
      ++mine.stopped;
    for (int k = 0; k < D; ++k) {
      const auto a = static_cast<std::size_t>(k);
      grains_.position[a][i] = flight.place[k], grains_.velocity[a][i] = flight.velocity[k];
      grains_.wraps[a][i] = flight.wraps[a];
    }
    for (std::size_t k = 0; k < turns<D>; ++k) grains_.spin[k][i] = flight.spin[static_cast<int>(k)];
    for (std::size_t k = 0; k < orientation_numbers<D>; ++k)
      grains_.orientation[k][i] = flight.orientation[static_cast<int>(k)];
  }
}

/// White noise (van Noije & Ernst 1998): every velocity component gets a random kick of variance ξ² Δt, less the mean of all
/// kicks, so that momentum is kept.
template <int D>
void DsmcEngine<D>::heat() {
  const double kick = std::sqrt(setup_.heating * setup_.time_step);
  double before = 0, after = 0, mass = 0;
  Vec<D> given{};
  const auto energy_of = [&](std::size_t i) {
    return 0.5 * grains_.mass[i] * dot(grains_.speed(i), grains_.speed(i));
  };
  for (std::size_t i = 0; i < grains_.moving; ++i) {
    before += energy_of(i), mass += grains_.mass[i];
    Random random(setup_.seed, Purpose::engine, item::heating + i, static_cast<std::uint64_t>(step_));
    for (std::size_t k = 0; k < D; ++k) {
      const double dv = kick * random.normal();
      grains_.velocity[k][i] += dv;
      given[static_cast<int>(k)] += grains_.mass[i] * dv;
    }
  }
  for (std::size_t i = 0; i < grains_.moving; ++i) {
    for (std::size_t k = 0; k < D; ++k) grains_.velocity[k][i] -= given[static_cast<int>(k)] / mass;
    after += energy_of(i);
  }
  tally_.wall_work += after - before;
}

template <int D>
void DsmcEngine<D>::check_physics() {
  // The first grain that is wrong, looked for by all threads: each tells of its own part, and the lowest number counts.
  std::vector<std::size_t> wrong(team_->size(), grains_.moving);
  const double* z = grains_.position[D - 1].data();
  team_->split(grains_.moving, [&](Part part, std::size_t k) {
    const auto* found =
        std::find_if(z + part.begin, z + part.end, [&](double h) { return !(h >= setup_.floor); });
    if (found != z + part.end) wrong[k] = static_cast<std::size_t>(found - z);
  });
  if (const auto i = *std::ranges::min_element(wrong); i < grains_.moving)
    leave_physics(i, std::isnan(z[i]) ? "its place is not a number" : "it fell through the bed");
  if (const double phi = cells_.densest_packing(); phi > densest)
    leave_physics(fmt::format(
        "grains gathered to a packing fraction of {:.2f} somewhere; above {} they are caged by their "
        "neighbours, which DSMC knows nothing of: use event, hybrid or soft",
        phi, densest));
}

template <int D>
EnergyAccount DsmcEngine<D>::energy() const {
  EnergyAccount e;
  for (std::size_t i = 0; i < grains_.moving; ++i) {
    e.translation += 0.5 * grains_.mass[i] * dot(grains_.speed(i), grains_.speed(i));
    e.rotation += 0.5 * grains_.inertia[i] * dot(grains_.turning(i), grains_.turning(i));
  }
  e.gravity_work = gravity_potential() - start_potential_;
  e.normal_loss = tally_.normal_loss, e.shear_loss = tally_.shear_loss, e.wall_work = tally_.wall_work;
  e.start = start_energy_;
  return e;
}

/// T = m⟨(v − u)²⟩/D about the mean velocity of all; a_2 = ⟨v⁴⟩/(D(D + 2)(T/m)²) − 1.
template <int D>
std::vector<std::pair<std::string, double>> DsmcEngine<D>::tells() const {
  Vec<D> u{};
  const auto n = static_cast<double>(grains_.moving);
  double mass = 0;
  for (std::size_t i = 0; i < grains_.moving; ++i)
    u = u + grains_.mass[i] * grains_.speed(i), mass += grains_.mass[i];
  u = (1 / mass) * u;
  double energy = 0, second = 0, fourth = 0, spin = 0;
  for (std::size_t i = 0; i < grains_.moving; ++i) {
    const Vec<D> c = grains_.speed(i) - u;
    const double square = dot(c, c);
    energy += grains_.mass[i] * square, second += square / n, fourth += square * square / n;
    spin += grains_.inertia[i] * dot(grains_.turning(i), grains_.turning(i));
  }
  const double T = second / D;
  return {{"temperature", energy / (D * n)},
          {"temperature_rotation", spin / (turns<D> * n)},
          {"a_2", T > 0 ? fourth / (D * (D + 2) * T * T) - 1 : 0},
          {"collisions", static_cast<double>(tally_.collisions)},
          {"densest", cells_.densest_packing()},
          {"speeds_raised", static_cast<double>(tally_.raised)},
          {"stopped", static_cast<double>(stopped_)}};
}

namespace {
template <class Archive, class T>
void transfer(Archive& archive, T& tally) {
  archive(tally.collisions, tally.raised, tally.normal_loss, tally.shear_loss, tally.wall_work);
}
}  // namespace

template <int D>
void DsmcEngine<D>::save(std::ostream& out) const {
  StateOutput archive(out);
  archive(grains_, cells_, step_, stopped_, start_energy_, start_potential_);
  transfer(archive, tally_);
}

template <int D>
void DsmcEngine<D>::restore(std::istream& in) {
  StateInput archive(in);
  archive(kept(grains_), cells_, step_, stopped_, start_energy_, start_potential_);
  transfer(archive, tally_);
}

template class DsmcEngine<2>;
template class DsmcEngine<3>;

}  // namespace chute::dsmc
