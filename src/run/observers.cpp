#include "run/observers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/atomic_file.hpp"
#include "run/flow.hpp"
#include "run/version.hpp"

namespace chute::run {

std::vector<std::string> RunContext::comments(std::string what) const {
  return {std::move(what), fmt::format("{}; units: {}; seed {}; chute {} ({})", scene.title, facts.units,
                                       scene.seed, version, commit)};
}

Observers::Observers(const RunContext& run)
    : run_(run), series_due_(run.schedule(run.scene.output.series.from, run.scene.output.series.every)) {
  const auto add = [&](std::unique_ptr<Observer> observer) {
    if (observer) list_.push_back(std::move(observer));
  };
  add(observe_frames(run));
  for (auto& file : observe_profiles(run)) add(std::move(file));
  add(observe_fields(run));
  add(observe_impacts(run));
  add(observe_impact_histograms(run));
}

std::int64_t Observers::next_after(std::int64_t step) const {
  auto next = series_due_.after(step);
  for (const auto& observer : list_) next = std::min(next, observer->next_after(step));
  return next;
}

void Observers::prepare(Engine& engine) const {
  engine.collect_impacts(std::any_of(list_.begin(), list_.end(), [&](const auto& observer) {
    return observer->wants_impacts(engine.step());
  }));
}

void Observers::look(Engine& engine) {
  if (series_due_.index_at(engine.step()) >= 0) series_.push_back(measure::observe_series(engine));
  const auto impacts = engine.take_impacts();
  for (const auto& observer : list_) observer->look({engine, impacts});
  prepare(engine);
}

measure::Flow Observers::flow(const GrainsView& grains) const {
  return judge_run(series_, run_.scene, grains);
}

void Observers::write(const GrainsView& grains) const {
  using Row = measure::SeriesRow;
  const auto energy = [](double EnergyAccount::*member) {
    return [member](const Row& row) { return row.energy.*member; };
  };
  Columns<Row> columns;
  columns.add("time", &Row::time)
      .add("x", &Row::x)
      .add("v_x", &Row::v_x)
      .add("v_y", &Row::v_y)
      .add("omega", &Row::omega)
      .add("contacts", [](const Row& row) { return static_cast<double>(row.contacts); })
      .add("translation", energy(&EnergyAccount::translation))
      .add("rotation", energy(&EnergyAccount::rotation))
      .add("elastic", energy(&EnergyAccount::elastic))
      .add("gravity_work", energy(&EnergyAccount::gravity_work))
      .add("normal_loss", energy(&EnergyAccount::normal_loss))
      .add("shear_loss", energy(&EnergyAccount::shear_loss))
      .add("residual", [](const Row& row) { return row.energy.residual(); });
  const auto comments =
      run_.comments("means over the moving grains, and where the energy is and went (see README)");
  write_atomically(run_.directory.file("series.csv"), columns.csv(comments, series_));
  const auto what_became = flow(grains);
  for (const auto& observer : list_) observer->write(what_became);
}

void Observers::save(std::ostream& out) {
  cereal::PortableBinaryOutputArchive archive(out);
  archive(series_);
  for (const auto& observer : list_) observer->save(archive);
}

void Observers::load(std::istream& in) {
  cereal::PortableBinaryInputArchive archive(in);
  archive(series_);
  for (const auto& observer : list_) observer->load(archive);
}

}  // namespace chute::run
