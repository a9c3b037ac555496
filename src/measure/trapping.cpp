#include <cmath>

#include "measure/ball_outputs.hpp"
#include "measure/standstill.hpp"

namespace chute::measure {
namespace {

/// Which grains came to rest. How far they had gone tells a ball that a hole caught on a steady way (region B, thesis
/// 4.3.2.1) from one that could not get going (region A). The rate counts only those that still move at `from`: stops a
/// length of way, the inverse of the mean way to trapping of (4.2). Ways that end with the run count, too: where stops come
/// at random that is the likeliest rate, with a relative error of 1/√stops.
class Trapping final : public Remembering<Trapping> {
 public:
  Trapping(const RunContext& run, const TrappingSpec& spec)
      : run_(run),
        due_(run.schedule(0, spec.every)),
        from_(spec.from),
        rest_(run.frame.bead_spacing, run.gravity) {}

  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }
  void look(const Look& look) override {
    if (due_.index_at(look.engine.step()) < 0) return;
    const auto grains = look.engine.grains();
    now_ = grains.time;
    period_ = grains.period;
    rest_.note(grains);
    if (begin_.empty() && now_ >= from_)
      for (std::size_t i = 0; i < rest_.size(); ++i) begin_.push_back(rest_.way(i));
  }
  void write(const Flow&) const override {
    io::Csv csv(
        run_.comments(
            "stopped: 1 if the grain came to rest, at this time and place, after this way downhill; else what "
            "it did until the end"),
        {"grain", "stopped", "time", "x", "y", "way"});
    const auto inside = [&](double place, std::size_t k) {
      return period_[k] > 0 ? place - period_[k] * std::floor(place / period_[k]) : place;
    };
    for (std::size_t i = 0; i < rest_.size(); ++i)
      csv.row({static_cast<double>(i), static_cast<double>(rest_.stopped(i)),
               rest_.stopped(i) ? rest_.since(i) : now_, inside(rest_.x(i), 0), inside(rest_.y(i), 1),
               rest_.way(i)});
    run_.write("trapping.csv", csv.text());
    write_rate();
  }
  template <class Archive>
  void serialize(Archive& a) {
    a(rest_, now_, period_, begin_);
  }

 private:
  const RunContext& run_;
  Schedule due_;
  double from_;
  Standstill rest_;
  double now_ = 0;
  std::array<double, 3> period_{};
  std::vector<double> begin_;  // way of each grain until `from`

  void write_rate() const {
    double balls = 0, stops = 0, way = 0;
    for (std::size_t i = 0; i < begin_.size(); ++i) {
      if (rest_.stopped(i) && rest_.since(i) <= from_) continue;  // it never got going: region A
      balls += 1, stops += rest_.stopped(i), way += rest_.way(i) - begin_[i];
    }
    io::Csv csv(
        run_.comments(
            "grains that moved at `from`, and from then on: how many stopped, their way downhill together, and "
            "stops a length of way, the inverse of the mean way to a stop"),
        {"grains", "stopped", "way", "rate", "rate_err"});
    csv.row(
        {balls, stops, way, way > 0 ? stops / way : unknown, stops > 0 ? std::sqrt(stops) / way : unknown});
    run_.write("trapping_rate.csv", csv.text());
  }
};

}  // namespace

std::vector<std::unique_ptr<Observer>> TrappingOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<Trapping>(run, *spec));
  return observers;
}

}  // namespace chute::measure
