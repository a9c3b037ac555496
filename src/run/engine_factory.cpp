#include "run/engine_factory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "event/event_engine.hpp"
#include "scene/contact.hpp"
#include "scene/start.hpp"
#include "soft/soft_engine.hpp"
#include "theory/stochastic_engine.hpp"

namespace chute::run {
namespace {

using Method = scene::EngineSpec::Method;

laws::NormalImpact reference_impact(const scene::Scene& scene) {
  return scene::reference_impact(scene.contact, scene.reference_pair());
}

/// Walton's collision with what [engine] says, and else what [contact] comes to for the reference pair.
event::HardContact hard_contact(const scene::Scene& scene) {
  const auto& engine = scene.engine;
  event::HardContact contact;
  const double e_n = engine.restitution.value_or(reference_impact(scene).restitution);
  contact.restitution = laws::ConstantRestitution{e_n};
  if (engine.restitution_velocity)
    contact.restitution =
        laws::PowerLawRestitution{1 - e_n, *engine.restitution_velocity, engine.restitution_exponent};
  auto shear = scene.contact.laws(scene.reference_pair()).shear;
  const double* mu = laws::friction(shear);
  contact.tangential = {engine.friction.value_or(mu ? *mu : 0), engine.tangential_restitution};
  return contact;
}

std::unique_ptr<Engine> event_engine(const scene::Scene& scene, Grains<2> grains, const Domain<2>& domain,
                                     const Vec<2>& gravity, double floor) {
  event::EventSetup<2> setup;
  setup.domain = domain;
  setup.gravity = gravity;
  setup.contact = hard_contact(scene);
  setup.contact_time = scene.engine.contact_time.value_or(reference_impact(scene).contact_time);
  setup.tick = time_step(scene);
  setup.floor = floor;
  return std::make_unique<event::EventEngine<2>>(std::move(grains), setup);
}

std::unique_ptr<Engine> stochastic_engine(const scene::Scene& scene, Grains<2> grains,
                                          const Domain<2>& domain) {
  const auto contact = hard_contact(scene);
  theory::StochasticModel model;
  model.ball_radius = scene.mean_diameter() / 2;
  model.bead_radius = scene.bed.diameter / 2;
  model.gap = scene.bed.kind == scene::Bed::Kind::row ? scene.bed.gap : scene.bed.gap_max / 2;  // (4.52)
  model.theta = scene.incline.theta();
  model.gravity = scene.incline.gravity;
  model.restitution = laws::restitution_at(contact.restitution, 0);
  model.friction = contact.tangential.friction;
  model.beta = contact.tangential.beta;
  model.law = scene.engine.impact_friction == scene::EngineSpec::Friction::published
                  ? theory::Friction::published
                  : theory::Friction::without_rotation;
  model.shadowed = scene.engine.shadowed;
  return std::make_unique<theory::StochasticEngine>(std::move(grains), domain, model,
                                                    static_cast<std::uint64_t>(scene.seed), time_step(scene));
}

}  // namespace

double time_step(const scene::Scene& scene) {
  if (scene.engine.time_step) return *scene.engine.time_step;
  const double longest = reference_impact(scene).contact_time / scene.engine.steps_per_contact;
  // A whole number of steps to an output, so that frames are at t = 12.5 and not at 12.49999.
  const auto& out = scene.output;
  const double between = out.frames ? std::min(out.frames->every, out.series.every) : out.series.every;
  return between / std::ceil(between / longest);
}

Made make_engine(const scene::Scene& scene, int threads) {
  auto start = scene::make_start(scene);
  const double theta = scene.incline.theta(), g = scene.incline.gravity;
  const Vec<2> gravity{{g * std::sin(theta), -g * std::cos(theta)}};
  const double floor = scene.bed.kind != scene::Bed::Kind::none
                           ? -(scene.bed.diameter + scene.mean_diameter())
                           : -std::numeric_limits<double>::infinity();
  if (scene.engine.method == Method::event)
    return {event_engine(scene, std::move(start.grains), start.domain, gravity, floor), start.domain};
  if (scene.engine.method == Method::stochastic)
    return {stochastic_engine(scene, std::move(start.grains), start.domain), start.domain};
  soft::SoftSetup<2> setup;
  setup.domain = start.domain;
  setup.gravity = gravity;
  setup.laws = scene.contact.laws(scene.reference_pair());
  setup.scheme = scene.engine.integrator == scene::EngineSpec::Integrator::gear5 ? soft::Scheme::gear5
                                                                                 : soft::Scheme::verlet;
  setup.time_step = time_step(scene);
  setup.skins = soft::usual_skins<2>(scene.mean_diameter());
  setup.deepest_overlap = scene.engine.deepest_overlap;
  setup.floor = floor;
  setup.contact_time = reference_impact(scene).contact_time;
  setup.threads =
      static_cast<int>(std::clamp<std::int64_t>(scene.grains.count / grains_per_thread, 1, threads));
  return {std::make_unique<soft::SoftEngine<2>>(std::move(start.grains), setup), start.domain};
}

}  // namespace chute::run
