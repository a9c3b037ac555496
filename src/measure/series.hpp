#pragma once
#include <cstdint>
#include <vector>

#include "measure/observer.hpp"
#include "measure/tilting.hpp"

namespace chute::measure {

/// Averages over all moving grains at one time, and the energy account.
struct SeriesRow {
  double time;
  double x;                 ///< mean place along the incline, counted on through the periods
  std::array<double, 3> v;  ///< mean velocity, in the coordinates of files
  double omega;             ///< mean spin, positive when rolling downhill
  std::int64_t contacts;
  EnergyAccount energy;
  std::vector<double> tells;  ///< what the method tells of itself (Engine::tells)

  template <class Archive>
  void serialize(Archive& a) {
    a(time, x, v, omega, contacts, energy.translation, energy.rotation, energy.elastic, energy.gravity_work,
      energy.normal_loss, energy.shear_loss, energy.wall_work, energy.projection_work, energy.inflow,
      energy.outflow, energy.start, tells);
  }
};

SeriesRow observe_series(const Engine& engine, const Frame& frame);

/// Keeps the series, and of grains that do not feel each other the way of each, for the verdicts are made of it.
class SeriesObserver final : public Remembering<SeriesObserver> {
 public:
  SeriesObserver(const RunContext& run, const Every& every);

  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }
  void look(const Look& look) override;
  void write(const Flow& flow) const override;

  std::size_t rows() const { return rows_.size(); }
  const std::vector<SeriesRow>& series() const { return rows_; }
  /// What became of the flow, or of each grain that does not feel the others.
  std::vector<Flow> starts() const;
  /// Where it started and stopped, of an incline that is tilted.
  std::optional<TurningAngles> turning_angles() const;
  /// What became of all of it: of several starts the verdict that most of them have, with means over those.
  Flow flow() const;

  template <class Archive>
  void serialize(Archive& a) {
    a(rows_, tracks_, mass_, told_);
  }

 private:
  /// The way of one grain through time.
  struct Track {
    std::vector<double> x, omega, kinetic;
    template <class Archive>
    void serialize(Archive& a) {
      a(x, omega, kinetic);
    }
  };
  const RunContext& run_;
  Schedule due_;
  std::vector<SeriesRow> rows_;
  std::vector<Track> tracks_;      // of independent grains
  double mass_ = 0;                // of all moving grains
  std::vector<std::string> told_;  // names of SeriesRow::tells
};

}  // namespace chute::measure
