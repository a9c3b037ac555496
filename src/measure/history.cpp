#include <numbers>

#include "measure/flow_outputs.hpp"

namespace chute::measure {
namespace {

struct HistorySums {
  double count = 0, v_x = 0, v_x2 = 0;
  template <class Archive>
  void serialize(Archive& a) {
    a(count, v_x, v_x2);
  }
};

/// Profiles of grains, their velocity and its fluctuations over the height, again and again: what a front is seen in.
class History final : public Remembering<History> {
 public:
  History(const RunContext& run, const HistorySpec& spec)
      : run_(run),
        bin_(spec.bin),
        samples_(spec.samples),
        between_(spec.between),
        due_(run.schedule(spec.from, spec.every / static_cast<double>(spec.samples))) {}

  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }
  void look(const Look& look) override {
    const auto index = due_.index_at(look.engine.step());
    if (index < 0) return;
    const auto grains = look.engine.grains();
    for (std::size_t i = 0; i < grains.moving; ++i) {
      const double x = grains.position[Frame::downhill][i];
      if (between_ && !(x >= (*between_)[0] && x < (*between_)[1])) continue;
      const double b = std::floor(grains.position[run_.frame.normal()][i] / bin_);
      if (!(b >= 0 && b < most_layers)) continue;
      const auto at = static_cast<std::size_t>(b);
      if (at >= now_.size()) now_.resize(at + 1);
      const double v = grains.velocity[Frame::downhill][i];
      now_[at].count += 1, now_[at].v_x += v, now_[at].v_x2 += v * v;
    }
    looks_ += 1;
    if (index % samples_ != 0) return;
    for (std::size_t b = 0; b < now_.size(); ++b) {
      const HistorySums& s = now_[b];
      if (s.count == 0) continue;
      const double mean = s.v_x / s.count;
      rows_.push_back({grains.time, (static_cast<double>(b) + 0.5) * bin_,
                       s.count / static_cast<double>(looks_), mean,
                       std::sqrt(std::max(0.0, s.v_x2 / s.count - mean * mean))});
    }
    now_.clear(), looks_ = 0;
  }
  void write(const Flow&) const override {
    io::Csv csv(run_.comments("profiles over the height, each averaged over the looks since the one before"),
                {run_.offers.clock, "h", "grains", "v_x", "sigma_x"});
    for (const auto& row : rows_) csv.row({row[0], row[1], row[2], row[3], row[4]});
    run_.write("history.csv", csv.text());
  }
  template <class Archive>
  void serialize(Archive& a) {
    a(rows_, now_, looks_);
  }

 private:
  const RunContext& run_;
  double bin_;
  std::int64_t samples_;
  std::optional<std::vector<double>> between_;
  Schedule due_;
  std::vector<std::array<double, 5>> rows_;  // as written
  std::vector<HistorySums> now_;             // since the last profile
  std::int64_t looks_ = 0;
};

}  // namespace

std::vector<std::unique_ptr<Observer>> HistoryOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<History>(run, *spec));
  return observers;
}

}  // namespace chute::measure
