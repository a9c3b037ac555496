#include "run/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cereal/types/string.hpp>
#include <cmath>

#include "common/state_archive.hpp"
#include "run/version.hpp"
#include "scene/world.hpp"

namespace chute::run {
namespace {

std::string units_of(const scene::Scene& scene) {
  return std::string(scene::units_words[static_cast<std::size_t>(scene.units)]);
}

/// The engine, and on the way what observers know of its world.
template <int D>
std::unique_ptr<Engine> made(const scene::Scene& scene, int threads, measure::RunContext& run) {
  auto world = scene::make_world<D>(scene);
  run.frame = world.frame;
  run.tilt = world.tilt;
  run.facts = io::facts_of(world, units_of(scene));
  return scene.engine->make(std::move(world), scene::setting_of(scene), threads);
}

}  // namespace

Session::Session(const scene::Scene& scene, int threads, std::shared_ptr<io::RunFiles> files) {
  engine_ = scene.dimensions == 2 ? made<2>(scene, threads, run_) : made<3>(scene, threads, run_);
  run_.title = scene.title;
  run_.made_by =
      fmt::format("units: {}; seed {}; chute {} ({})", units_of(scene), scene.seed, version, commit);
  run_.offers = scene.engine->offers();
  run_.facts.clock = run_.offers.clock;
  run_.gravity = scene.incline.gravity;
  run_.diameter = scene::setting_of(scene).mean_diameter;
  run_.independent = scene.grains.independent;
  run_.time_step = engine_->time_step();
  run_.duration = scene.duration;
  const auto setting = scene::setting_of(scene);
  run_.contact_time = setting.contact.impact(setting.reference()).contact_time;
  run_.files = std::move(files);
  last_step_ = std::max<std::int64_t>(1, std::llround(scene.duration / run_.time_step));
  for (const auto& output : scene.output) {
    if (!output->wanted()) continue;
    for (auto& observer : output->make(run_)) {
      if (auto* series = dynamic_cast<measure::SeriesObserver*>(observer.get())) series_ = series;
      observers_.push_back(std::move(observer));
    }
  }
}

void Session::prepare() {
  const auto step = engine_->step();
  const auto any = [&](auto&& wants) { return std::ranges::any_of(observers_, wants); };
  engine_->collect_impacts(any([&](const auto& o) { return o->wants_impacts(step); }));
  engine_->collect_collisions(any([&](const auto& o) { return o->wants_collisions(step); }));
  engine_->collect_avalanches(any([&](const auto& o) { return o->wants_avalanches(step); }));
}

void Session::look() {
  const auto impacts = engine_->take_impacts();
  const auto collisions = engine_->take_collisions();
  const auto partings = engine_->take_partings();
  const auto avalanches = engine_->take_avalanches();
  for (const auto& observer : observers_)
    observer->look({*engine_, impacts, collisions, partings, avalanches});
  prepare();
}

void Session::begin() {
  prepare();
  look();
}

void Session::advance(std::int64_t until) {
  auto next = std::min(until, last_step_);
  for (const auto& observer : observers_) next = std::min(next, observer->next_after(engine_->step()));
  engine_->advance_to(next);
  look();
}

void Session::write() const {
  const auto flow = series_->rows() > 0 ? series_->flow() : measure::Flow{};
  for (const auto& observer : observers_) observer->write(flow);
}

void Session::save(std::ostream& out) const {
  engine_->save(out);
  StateOutput archive(out);
  for (const auto& observer : observers_) observer->save(archive);
  if (run_.files) archive(*run_.files);
}

void Session::load(std::istream& in) {
  engine_->restore(in);
  StateInput archive(in);
  for (const auto& observer : observers_) observer->load(archive);
  if (run_.files) archive(*run_.files);
  prepare();
}

}  // namespace chute::run
