#include "measure/series.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "measure/outputs.hpp"

namespace chute::measure {

SeriesRow observe_series(const Engine& engine, const Frame& frame) {
  const GrainsView grains = engine.grains();
  SeriesRow row{};
  row.time = engine.time();
  const auto& spin = grains.spin[frame.rolling_axis()];
  for (std::size_t i = 0; i < grains.moving; ++i) {
    row.x += grains.unwrapped(i, 0);
    for (std::size_t k = 0; k < static_cast<std::size_t>(frame.dimensions); ++k)
      row.v[k] += grains.velocity[k][i];
    row.omega += frame.rolling_sign() * spin[i];
  }
  const auto n = static_cast<double>(std::max<std::size_t>(1, grains.moving));  // of none all means are 0
  row.x /= n;
  for (double& v : row.v) v /= n;
  row.omega /= n;
  row.contacts = static_cast<std::int64_t>(engine.contacts().size());
  row.energy = engine.energy();
  for (const auto& [name, value] : engine.tells()) row.tells.push_back(value);
  return row;
}

SeriesObserver::SeriesObserver(const RunContext& run, const Every& every)
    : run_(run), due_(run.schedule(every.from, every.every)) {}

void SeriesObserver::look(const Look& look) {
  if (due_.index_at(look.engine.step()) < 0) return;
  rows_.push_back(observe_series(look.engine, run_.frame));
  if (run_.open && rows_.size() > 1) {
    // Where grains come and go their mean place stays while they flow: the way is that of the mean velocity.
    auto& now = rows_.back();
    const auto& before = rows_[rows_.size() - 2];
    now.x = before.x + (now.time - before.time) * (before.v[0] + now.v[0]) / 2;
  }
  if (rows_.size() == 1)
    for (const auto& [name, value] : look.engine.tells()) told_.push_back(name);
  const GrainsView grains = look.engine.grains();
  mass_ = 0;
  for (std::size_t i = 0; i < grains.moving; ++i) mass_ += grains.mass[i];
  if (!run_.independent) return;
  tracks_.resize(grains.moving);
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    double square = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(grains.dimensions); ++k)
      square += grains.velocity[k][i] * grains.velocity[k][i];
    for (const auto& spin : grains.spin)
      if (!spin.empty()) square += grains.inertia[i] / grains.mass[i] * spin[i] * spin[i];
    tracks_[i].x.push_back(grains.unwrapped(i, 0));
    tracks_[i].omega.push_back(run_.frame.rolling_sign() * grains.spin[run_.frame.rolling_axis()][i]);
    tracks_[i].kinetic.push_back(0.5 * square);
  }
}

std::vector<Flow> SeriesObserver::starts() const {
  const FlowScales scales{run_.frame.bead_spacing, run_.gravity};
  std::vector<double> time;
  for (const auto& row : rows_) time.push_back(row.time);
  std::vector<Flow> flows;
  for (const auto& track : tracks_)
    flows.push_back(judge_flow({time, track.x, track.omega, track.kinetic}, scales));
  if (!tracks_.empty()) return flows;
  Track mean;
  for (const auto& row : rows_) {
    mean.x.push_back(row.x);
    mean.omega.push_back(row.omega);
    mean.kinetic.push_back(mass_ > 0 ? (row.energy.translation + row.energy.rotation) / mass_ : 0);
  }
  return {judge_flow({time, mean.x, mean.omega, mean.kinetic}, scales)};
}

Flow SeriesObserver::flow() const {
  const auto all = starts();
  Flow flow = tracks_.empty() ? all.front() : joined(all);
  flow.kinetic.mean *= mass_;
  if (flow.kinetic.error) *flow.kinetic.error *= mass_;
  return flow;
}

std::optional<TurningAngles> SeriesObserver::turning_angles() const {
  if (!run_.tilt || !(run_.tilt->gravity > 0)) return {};
  std::vector<double> time, v_x;
  for (const auto& row : rows_) time.push_back(row.time), v_x.push_back(row.v[0]);
  return measure::turning_angles(*run_.tilt, run_.diameter, time, v_x);
}

void SeriesObserver::write(const Flow&) const {
  using Row = SeriesRow;
  const auto energy = [](double EnergyAccount::*member) {
    return [member](const Row& row) { return row.energy.*member; };
  };
  Columns<Row> columns;
  columns.add(std::string(run_.offers.clock), &Row::time).add("x", &Row::x);
  for (std::size_t k = 0; k < static_cast<std::size_t>(run_.frame.dimensions); ++k)
    columns.add(std::string("v_") + axis_names[k], [k](const Row& row) { return row.v[k]; });
  columns.add("omega", &Row::omega)
      .add("contacts", [](const Row& row) { return static_cast<double>(row.contacts); })
      .add("translation", energy(&EnergyAccount::translation))
      .add("rotation", energy(&EnergyAccount::rotation))
      .add("elastic", energy(&EnergyAccount::elastic))
      .add("gravity_work", energy(&EnergyAccount::gravity_work))
      .add("normal_loss", energy(&EnergyAccount::normal_loss))
      .add("shear_loss", energy(&EnergyAccount::shear_loss))
      .add("wall_work", energy(&EnergyAccount::wall_work))
      .add("projection_work", energy(&EnergyAccount::projection_work));
  if (run_.open)
    columns.add("energy_in", energy(&EnergyAccount::inflow))
        .add("energy_out", energy(&EnergyAccount::outflow));
  columns.add("residual", [](const Row& row) { return row.energy.residual(); });
  if (run_.tilt)
    columns.add("angle",
                [this](const Row& row) { return run_.tilt->angle(row.time) * 180 / std::numbers::pi; });
  for (std::size_t k = 0; k < told_.size(); ++k)
    columns.add(told_[k], [k](const Row& row) { return row.tells[k]; });
  run_.write("series.csv",
             columns.csv(run_.comments("means over the moving grains, and where the energy is and went (see "
                                       "README)"),
                         rows_));
}

void SeriesOutput::before_reading(const Scales& scales) {
  constexpr double rows = 400;
  series.every = scales.duration / rows;
}
std::vector<std::unique_ptr<Observer>> SeriesOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<SeriesObserver>(run, series));
  return observers;
}

}  // namespace chute::measure
