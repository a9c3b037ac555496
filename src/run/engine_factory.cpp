#include "run/engine_factory.hpp"

#include <cmath>

#include "scene/start.hpp"
#include "soft/soft_engine.hpp"

namespace chute::run {

double time_step(const scene::Scene& scene) {
  if (scene.engine.time_step) return *scene.engine.time_step;
  const auto contact = scene.contact.laws();
  const double t_n = std::visit([&](const auto& law) { return law.contact_time(scene.reference_mass()); },
                                contact.normal);
  return t_n / scene.engine.steps_per_contact;
}

Made make_engine(const scene::Scene& scene) {
  auto start = scene::make_start(scene);
  const double theta = scene.incline.theta(), g = scene.incline.gravity;
  soft::SoftSetup<2> setup;
  setup.domain = start.domain;
  setup.gravity = {{g * std::sin(theta), -g * std::cos(theta)}};
  setup.laws = scene.contact.laws();
  setup.scheme = scene.engine.integrator == scene::EngineSpec::Integrator::gear5 ? soft::Scheme::gear5
                                                                                  : soft::Scheme::verlet;
  setup.time_step = time_step(scene);
  setup.skins = soft::usual_skins<2>(scene.mean_diameter());
  setup.deepest_overlap = scene.engine.deepest_overlap;
  if (scene.bed.kind != scene::Bed::Kind::none) setup.floor = -(scene.bed.diameter + scene.mean_diameter());
  return {std::make_unique<soft::SoftEngine<2>>(std::move(start.grains), setup), start.domain};
}

}  // namespace chute::run
