#include "run/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cereal/types/string.hpp>
#include <cmath>
#include <map>
#include <sstream>

#include "common/state_archive.hpp"
#include "run/version.hpp"
#include "scene/world.hpp"

namespace chute::run {
namespace {

std::string units_of(const scene::Scene& scene) {
  return std::string(scene::units_words[static_cast<std::size_t>(scene.units)]);
}

/// What the scene says of an output, as TOML.
std::string keys_of(const Chosen<measure::Output>& output) {
  auto copy = output;
  TomlWriter writer;
  copy->write(writer);
  return writer.text();
}

/// These lines without those of some keys.
std::string without(const std::string& lines, const std::vector<std::string>& keys) {
  std::istringstream in(lines);
  std::string left;
  for (std::string line; std::getline(in, line);)
    if (std::ranges::none_of(keys, [&](const auto& key) { return line.starts_with(key + " = "); }))
      left.append(line).push_back('\n');
  return left;
}

/// The engine, and on the way what observers know of its world.
template <int D>
std::unique_ptr<Engine> made(const scene::Scene& scene, int threads, measure::RunContext& run) {
  auto world = scene::make_world<D>(scene);
  run.frame = world.frame;
  run.tilt = world.tilt;
  run.open = world.open();
  run.facts = io::facts_of(world, units_of(scene));
  for (const auto& material : scene.materials) run.materials.push_back(material.name);
  run.facts.materials = run.materials;
  // Starts and methods may tell kinds of grains apart in scenes that name none.
  const auto& kinds = world.grains.material;
  constexpr int sensible = 64;  // a file may number them as it likes
  const int most = kinds.empty() ? 0 : std::min(sensible, *std::max_element(kinds.begin(), kinds.end()));
  for (int k = static_cast<int>(run.materials.size()); k <= most; ++k)
    run.materials.push_back(std::to_string(k));
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
    Watch watch{output.word(), keys_of(output), output->may_change(), {}};
    for (auto& observer : output->make(run_)) {
      if (auto* series = dynamic_cast<measure::SeriesObserver*>(observer.get())) series_ = series;
      watch.observers.push_back(observer.get());
      observers_.push_back(std::move(observer));
    }
    watches_.push_back(std::move(watch));
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
  move(until);
  look();
}

void Session::move(std::int64_t until) {
  auto next = std::min(until, last_step_);
  for (const auto& observer : observers_) next = std::min(next, observer->next_after(engine_->step()));
  engine_->advance_to(next);
}

void Session::write() const {
  const auto flow = series_->rows() > 0 ? series_->flow() : measure::Flow{};
  for (const auto& observer : observers_) observer->write(flow);
}

void Session::save(std::ostream& out) const {
  engine_->save(out);
  StateOutput archive(out);
  if (run_.files) archive(*run_.files);
  archive(watches_.size());
  for (const auto& watch : watches_) {
    std::ostringstream kept;
    {
      StateOutput inside(kept);
      for (auto* observer : watch.observers) observer->save(inside);
    }
    archive(watch.word, watch.keys, kept.str());
  }
}

std::vector<std::string> Session::load(std::istream& in) {
  engine_->restore(in);
  StateInput archive(in);
  if (run_.files) archive(*run_.files);
  struct Stored {
    std::string keys, bytes;
  };
  std::map<std::string, Stored> kept;
  std::size_t count = 0;
  archive(count);
  for (std::size_t k = 0; k < count; ++k) {
    std::string word;
    Stored one;
    archive(word, one.keys, one.bytes);
    kept[word] = std::move(one);
  }
  std::vector<std::string> told;
  for (const auto& watch : watches_) {
    const auto before = kept.find(watch.word);
    if (before != kept.end() &&
        without(before->second.keys, watch.may_change) == without(watch.keys, watch.may_change)) {
      std::istringstream bytes(before->second.bytes);
      StateInput inside(bytes);
      for (auto* observer : watch.observers) observer->load(inside);
    } else {
      told.push_back(fmt::format("output.{}{} begins at {}, where the run goes on", watch.word,
                                 before == kept.end() ? "" : " has other keys than before: it",
                                 run_.moment(engine_->time())));
      for (auto* observer : watch.observers) observer->look({*engine_, {}, {}});
    }
    if (before != kept.end()) kept.erase(before);
  }
  for (const auto& [word, one] : kept)
    told.push_back(
        fmt::format("output.{} ends at {}: its files stay as they are", word, run_.moment(engine_->time())));
  prepare();
  return told;
}

}  // namespace chute::run
