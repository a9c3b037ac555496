#include "run/engine_factory.hpp"

#include <algorithm>
#include <cmath>

#include "scene/contact.hpp"
#include "scene/start.hpp"
#include "soft/soft_engine.hpp"

namespace chute::run {

double time_step(const scene::Scene& scene) {
  if (scene.engine.time_step) return *scene.engine.time_step;
  const auto pair = scene.reference_pair();
  const auto impact = laws::normal_impact(scene.contact.laws(pair), scene::impact_velocity(scene.contact), pair);
  const double longest = impact.contact_time / scene.engine.steps_per_contact;
  // A whole number of steps to an output, so that frames are at t = 12.5 and not at 12.49999.
  const auto& out = scene.output;
  const double between = out.frames ? std::min(out.frames->every, out.series.every) : out.series.every;
  return between / std::ceil(between / longest);
}

Made make_engine(const scene::Scene& scene) {
  auto start = scene::make_start(scene);
  const double theta = scene.incline.theta(), g = scene.incline.gravity;
  soft::SoftSetup<2> setup;
  setup.domain = start.domain;
  setup.gravity = {{g * std::sin(theta), -g * std::cos(theta)}};
  setup.laws = scene.contact.laws(scene.reference_pair());
  setup.scheme = scene.engine.integrator == scene::EngineSpec::Integrator::gear5 ? soft::Scheme::gear5
                                                                                  : soft::Scheme::verlet;
  setup.time_step = time_step(scene);
  setup.skins = soft::usual_skins<2>(scene.mean_diameter());
  setup.deepest_overlap = scene.engine.deepest_overlap;
  if (scene.bed.kind != scene::Bed::Kind::none) setup.floor = -(scene.bed.diameter + scene.mean_diameter());
  return {std::make_unique<soft::SoftEngine<2>>(std::move(start.grains), setup), start.domain};
}

}  // namespace chute::run
