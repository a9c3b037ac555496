#include <algorithm>

#include "measure/impact_histograms.hpp"
#include "measure/outputs.hpp"

namespace chute::measure {
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
  void write(const Flow&) const override { run_.write("impacts.vtp", io::impacts_vtp(impacts_, run_.facts)); }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(impacts_);
  }

 private:
  std::vector<Impact> impacts_;
};

class Histograms final : public ImpactObserver<Histograms> {
 public:
  Histograms(const RunContext& run, const ImpactHistogramSpec& spec)
      : ImpactObserver(run, spec.from.value_or(0)),
        from_(spec.from),
        histograms_(
            {static_cast<std::size_t>(spec.angles), static_cast<std::size_t>(spec.velocities), spec.fastest},
            run.window(spec.from)) {}

  void take(std::span<const Impact> impacts, const Engine& engine) {
    histograms_.add(impacts, engine.grains().moving);
  }

  void write(const Flow& flow) const override {
    auto comments = run_.comments(
        "impacts of grains with grains, with the bed, and all: probability densities of gamma "
        "modulo pi and of abs(v_n), and the mean abs(v_n) at each gamma; errors from blocks of "
        "the time window");
    for (auto& line : run_.average_note(from_, flow)) comments.push_back(std::move(line));
    io::Csv csv(comments, {"pair", "quantity", "x", "value", "value_err"});
    for (const auto& row : histograms_.result(from_.value_or(flow.from)))
      csv.row({row.pair, row.quantity}, {row.x, row.value.mean, row.value.error});
    run_.write("impact_histograms.csv", csv.text());
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(histograms_);
  }

 private:
  From from_;
  ImpactHistograms histograms_;
};

}  // namespace

std::vector<std::unique_ptr<Observer>> ImpactsOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<ImpactList>(run, spec->from));
  return observers;
}

void ImpactHistogramsOutput::fill(const Scales& scales) {
  if (spec && spec->fastest == 0) spec->fastest = 2 * scales.velocity;
}

std::vector<std::unique_ptr<Observer>> ImpactHistogramsOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<Histograms>(run, *spec));
  return observers;
}

}  // namespace chute::measure
