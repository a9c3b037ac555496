#pragma once
#include <functional>
#include <limits>

#include "common/error.hpp"
#include "core/sphere.hpp"
#include "engines/soft/soft_engine.hpp"
#include "laws/collision.hpp"
#include "laws/list.hpp"

/// Grains in free space, for experiments with a few of them.
namespace chute::experiments {

/// A solid sphere (I = 2/5 m R²), in 2D too.
template <int D>
struct Ball {
  double radius = 1, mass = 1;
  Vec<D> velocity{};
  Vec<turns<D>> spin{};
  bool fixed = false;  ///< infinitely heavy; it must then be the second one, at rest

  double inertia() const { return sphere_inertia(mass, radius); }
  laws::Collider<D> collider() const {
    return {velocity, spin, radius, fixed ? 0 : 1 / mass, fixed ? 0 : 1 / inertia()};
  }
};

template <int D>
void add_ball(Grains<D>& grains, const Ball<D>& ball, const Vec<D>& place) {
  grains.add(place, ball.radius, ball.mass, ball.inertia(), !ball.fixed);
  for (int k = 0; k < D; ++k) grains.velocity[k].back() = ball.velocity[k];
  for (int k = 0; k < turns<D>; ++k) grains.spin[k].back() = ball.spin[k];
}

/// What a contact of the two knows of them.
template <int D>
laws::Pair pair_of(const Ball<D>& i, const Ball<D>& j) {
  return {j.fixed ? i.mass : i.mass * j.mass / (i.mass + j.mass),
          i.radius * j.radius / (i.radius + j.radius)};
}

/// The soft-sphere engine without gravity or borders, for grains of about the given diameter; overlaps may
/// be as deep as they like.
template <int D>
soft::SoftSetup<D> free_space(const laws::ContactLaws& laws, double time_step, double diameter) {
  soft::SoftSetup<D> setup;
  setup.laws = laws;
  setup.time_step = time_step;
  setup.skins = soft::usual_skins<D>(diameter);
  setup.deepest_overlap = std::numeric_limits<double>::infinity();
  return setup;
}

/// Called at the start and after every step, with the time since the surfaces of the first contact met.
template <int D>
using Watch = std::function<void(const soft::SoftEngine<D>& engine, double time)>;

/// The one loop of all experiments: step by step until `done()`, which is asked after each. WorkError that says
/// `otherwise` if that takes more than `patience` of time. The surfaces first meet at time `lead`.
template <int D, class Done>
void step_until(soft::SoftEngine<D>& engine, const Watch<D>& watch, double lead, double patience,
                const char* otherwise, const Done& done) {
  if (watch) watch(engine, engine.time() - lead);
  do {
    if (engine.time() > patience) throw WorkError(otherwise);
    engine.advance_to(engine.step() + 1);
    if (watch) watch(engine, engine.time() - lead);
  } while (!done());
}

}  // namespace chute::experiments
