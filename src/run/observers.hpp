#pragma once
#include "measure/series.hpp"
#include "run/observer.hpp"

namespace chute::run {

/// Everybody who watches a run. The series is always there: the verdict about the flow is made of it.
class Observers {
 public:
  explicit Observers(const RunContext& run);

  /// The first step after `step` at which somebody must look.
  std::int64_t next_after(std::int64_t step) const;
  /// Starts or goes on collecting impacts if somebody wants them now.
  void prepare(Engine& engine) const;
  void look(Engine& engine);

  bool saw_something() const { return !series_.empty(); }
  measure::Flow flow(const GrainsView& grains) const;

  void write(const GrainsView& grains) const;
  void save(std::ostream& out);
  void load(std::istream& in);

 private:
  const RunContext& run_;
  Schedule series_due_;
  std::vector<measure::SeriesRow> series_;
  std::vector<std::unique_ptr<Observer>> list_;
};

}  // namespace chute::run
