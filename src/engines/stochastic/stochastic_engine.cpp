#include "engines/stochastic/stochastic_engine.hpp"

#include <fmt/format.h>

#include <cereal/types/array.hpp>
#include <cereal/types/vector.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "common/error.hpp"
#include "common/state_archive.hpp"

namespace chute::stochastic {
namespace {

double kinetic(double mass, const Vec<2>& v) { return 0.5 * mass * dot(v, v); }

}  // namespace

StochasticEngine::StochasticEngine(World<2> world, const StochasticModel& model, std::uint64_t seed,
                                   double tick)
    : grains_(std::move(world.grains)),
      domain_(world.domain),
      model_(model),
      seed_(seed),
      tick_(tick),
      height_(model.ball_radius + model.bead_radius),
      walk_(model, {}) {
  if (grains_.moving != 1)
    throw WorkError(fmt::format("the stochastic model moves one ball, not {}", grains_.moving));
  place_ = grains_.place(0), velocity_ = grains_.speed(0);
  if (!(velocity_[0] > 0)) throw WorkError("the stochastic model's ball must start downhill: velocity > 0");
  for (auto& force : no_force_) force.assign(grains_.size(), 0);
  start_energy_ = kinetic(grains_.mass[0], velocity_);
  // The first flight is from the start down to the tops of the beads.
  const double pull = -gravity()[1], above = std::max(0.0, place_[1] - height_), up = velocity_[1];
  end_ = (up + std::sqrt(up * up + 2 * pull * above)) / pull;
  if (end_ <= 0) throw WorkError("the stochastic model's ball must start above the beads or upwards");
  walk_.restore(velocity_ + end_ * gravity(), false);
  show();
}

Vec<2> StochasticEngine::gravity() const { return gravity_on_incline<2>(model_.gravity, model_.theta); }

void StochasticEngine::advance(std::int64_t step) {
  if (step <= step_) return;
  while (end_ <= static_cast<double>(step) * tick_) next_flight();
  step_ = step;
  show();
}

void StochasticEngine::next_flight() {
  const double mass = grains_.mass[0], duration = end_ - begin_;
  const Vec<2> way = duration * (velocity_ + (duration / 2) * gravity());
  gravity_work_ += mass * dot(gravity(), way);
  place_ = {{place_[0] + way[0], height_}};
  begin_ = end_;
  const Vec<2> before = walk_.velocity();
  Random random(seed_, Purpose::stochastic, 0, static_cast<std::uint64_t>(draws_++));
  const auto hop = walk_.hop(random);
  if (!hop) {  // trapped: the impact took everything
    normal_loss_ += kinetic(mass, before);
    velocity_ = {};
    end_ = std::numeric_limits<double>::infinity();
    return;
  }
  const double normal = 0.5 * mass * hop->v_n * hop->v_n * (1 - model_.restitution * model_.restitution);
  normal_loss_ += normal;
  shear_loss_ += kinetic(mass, hop->before) - kinetic(mass, hop->after) - normal;
  Impact now = impact(*hop);
  touches_.begin(now);
  touches_.end(begin_, 0, static_cast<std::size_t>(now.bead));
  if (collecting_) impacts_.push_back(now);
  velocity_ = hop->after;
  end_ = begin_ + hop->time;
}

Impact StochasticEngine::impact(const Hop& hop) const {
  Impact impact{};
  impact.time = begin_;
  impact.gamma = hop.gamma, impact.v_n = hop.v_n, impact.v_t = hop.v_t;
  const double r = model_.bead_radius;
  impact.place = {place_[0], r * std::cos(hop.gamma), 0};
  impact.bead = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t j = grains_.moving; j < grains_.size(); ++j) {
    const double periods =
        domain_.periodic(0) ? std::floor((place_[0] - domain_.lower[0]) / domain_.length[0]) : 0;
    const double x = place_[0] - (periods != 0 ? periods * domain_.length[0] : 0);
    const double away = std::abs(domain_.way({{x, 0}}, {{grains_.position[0][j], 0}})[0]);
    if (away < nearest) nearest = away, impact.bead = static_cast<std::int64_t>(j);
  }
  return impact;
}

std::vector<Impact> StochasticEngine::take_impacts() { return std::exchange(impacts_, {}); }

void StochasticEngine::show() {
  const double dt = std::isfinite(end_) ? static_cast<double>(step_) * tick_ - begin_ : 0;
  Vec<2> place = place_ + dt * (velocity_ + (dt / 2) * gravity());
  const Vec<2> velocity = std::isfinite(end_) ? velocity_ + dt * gravity() : Vec<2>{};
  int laps = 0;
  if (domain_.periodic(0)) {
    laps = static_cast<int>(std::floor((place[0] - domain_.lower[0]) / domain_.length[0]));
    place[0] -= laps * domain_.length[0];
  }
  grains_.wraps[0][0] = laps;
  for (int k = 0; k < 2; ++k) {
    grains_.position[static_cast<std::size_t>(k)][0] = place[k];
    grains_.velocity[static_cast<std::size_t>(k)][0] = velocity[k];
  }
}

GrainsView StochasticEngine::grains() const { return view_of(grains_, no_force_, domain_, time()); }

EnergyAccount StochasticEngine::energy() const {
  EnergyAccount e;
  const double mass = grains_.mass[0];
  const Vec<2> now{{grains_.velocity[0][0], grains_.velocity[1][0]}};
  e.start = start_energy_;
  e.translation = kinetic(mass, now);
  e.gravity_work = gravity_work_;
  if (std::isfinite(end_))
    e.gravity_work += kinetic(mass, now) - kinetic(mass, velocity_);  // of the flight so far
  e.normal_loss = normal_loss_, e.shear_loss = shear_loss_;
  return e;
}

void StochasticEngine::save(std::ostream& out) const {
  StateOutput archive(out);
  archive(walk_.velocity().c, walk_.trapped(), begin_, end_, place_.c, velocity_.c, draws_, step_,
          gravity_work_, normal_loss_, shear_loss_, start_energy_, touches_);
}

void StochasticEngine::restore(std::istream& in) {
  StateInput archive(in);
  Vec<2> velocity;
  bool trapped = false;
  archive(velocity.c, trapped, begin_, end_, place_.c, velocity_.c, draws_, step_, gravity_work_,
          normal_loss_, shear_loss_, start_energy_, touches_);
  walk_.restore(velocity, trapped);
  show();
}

}  // namespace chute::stochastic
