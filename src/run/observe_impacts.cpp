#include "common/atomic_file.hpp"
#include "measure/impact_histograms.hpp"
#include "run/observer.hpp"

namespace chute::run {
namespace {

/// Sees all impacts after `from`. The engine stops there, so that it collects none before.
template <class Self>
class ImpactObserver : public Remembering<Self> {
 public:
  ImpactObserver(const RunContext& run, double from) : run_(run), first_(run.schedule(from, 0).step_of(0)) {}

  std::int64_t next_after(std::int64_t step) const override {
    return first_ > step ? first_ : std::numeric_limits<std::int64_t>::max();
  }
  bool wants_impacts(std::int64_t step) const override { return step >= first_; }
  void look(const Look& look) override {
    // Another observer may have had them collected earlier.
    const double from = static_cast<double>(first_) * run_.time_step;
    const auto begin = std::find_if(look.impacts.begin(), look.impacts.end(),
                                    [&](const Impact& impact) { return first_ == 0 || impact.time > from; });
    static_cast<Self&>(*this).take({begin, look.impacts.end()}, look.engine);
  }

 protected:
  const RunContext& run_;

 private:
  std::int64_t first_;
};

class ImpactList final : public ImpactObserver<ImpactList> {
 public:
  using ImpactObserver::ImpactObserver;
  void take(std::span<const Impact> impacts, const Engine&) {
    impacts_.insert(impacts_.end(), impacts.begin(), impacts.end());
  }
  void write(const measure::Flow&) const override {
    write_atomically(run_.directory.file("impacts.vtp"), io::impacts_vtp(impacts_, run_.facts));
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(impacts_);
  }

 private:
  std::vector<Impact> impacts_;
};

class Histograms final : public ImpactObserver<Histograms> {
 public:
  Histograms(const RunContext& run, const scene::ImpactHistogramSpec& spec)
      : ImpactObserver(run, spec.from.value_or(0)),
        from_(spec.from),
        histograms_(
            {static_cast<std::size_t>(spec.angles), static_cast<std::size_t>(spec.velocities), spec.fastest},
            run.window(spec.from)) {}

  void take(std::span<const Impact> impacts, const Engine& engine) {
    histograms_.add(impacts, engine.grains().moving);
  }

  void write(const measure::Flow& flow) const override {
    io::Csv csv(
        run_.comments("impacts of grains with grains, with the bed, and all: probability densities of gamma "
                      "modulo pi and of abs(v_n), and the mean abs(v_n) at each gamma; errors from blocks of "
                      "the time window"),
        {"pair", "quantity", "x", "value", "value_err"});
    for (const auto& row : histograms_.result(from_.value_or(flow.from)))
      csv.row({row.pair, row.quantity}, {row.x, row.value.mean, row.value.error});
    write_atomically(run_.directory.file("impact_histograms.csv"), csv.text());
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(histograms_);
  }

 private:
  std::optional<double> from_;
  measure::ImpactHistograms histograms_;
};

}  // namespace

std::unique_ptr<Observer> observe_impacts(const RunContext& run) {
  const auto& spec = run.scene.output.impacts;
  return spec ? std::make_unique<ImpactList>(run, spec->from) : nullptr;
}

std::unique_ptr<Observer> observe_impact_histograms(const RunContext& run) {
  const auto& spec = run.scene.output.impact_histograms;
  return spec ? std::make_unique<Histograms>(run, *spec) : nullptr;
}

}  // namespace chute::run
