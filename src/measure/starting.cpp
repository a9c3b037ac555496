#include <cmath>
#include <numbers>

#include "measure/ball_outputs.hpp"
#include "measure/standstill.hpp"

namespace chute::measure {
namespace {

/// When grains that had come to rest first leave their place. On an incline that tilts slowly that is the static angle of
/// repose of each (Riguidel's theta_s, thesis 4.1.1).
class Starting final : public Remembering<Starting> {
 public:
  Starting(const RunContext& run, const StartingSpec& spec)
      : run_(run),
        due_(run.schedule(0, spec.every)),
        step_(run.frame.bead_spacing),
        rest_(run.gravity > 0 ? Standstill::rest * std::sqrt(step_ / run.gravity) : 0) {}

  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }
  void look(const Look& look) override {
    if (due_.index_at(look.engine.step()) < 0) return;
    const auto grains = look.engine.grains();
    grains_.resize(grains.moving);
    for (std::size_t i = 0; i < grains_.size(); ++i) {
      Grain& g = grains_[i];
      if (g.started) continue;
      const double x = grains.unwrapped(i, 0), y = grains.dimensions == 3 ? grains.unwrapped(i, 1) : 0;
      const bool away = !g.known || std::hypot(x - g.x, y - g.y) > step_;
      if (!away) {
        g.rested = g.rested || grains.time - g.since > rest_;
        continue;
      }
      g.started = g.rested;
      g.known = true, g.x = x, g.y = y, g.since = grains.time;
    }
  }
  void write(const Flow&) const override {
    io::Csv csv(
        run_.comments(
            "rested: 1 if the grain stayed within a bead's spacing for 50 sqrt(d/g); started: 1 if it "
            "then left it, at this time and this angle of the incline in degrees"),
        {"grain", "rested", "started", "time", "angle"});
    for (std::size_t i = 0; i < grains_.size(); ++i) {
      const Grain& g = grains_[i];
      const double angle =
          g.started && run_.tilt ? run_.tilt->angle(g.since) * 180 / std::numbers::pi : unknown;
      csv.row({static_cast<double>(i), static_cast<double>(g.rested), static_cast<double>(g.started),
               g.started ? g.since : unknown, angle});
    }
    run_.write("starting.csv", csv.text());
  }
  template <class Archive>
  void serialize(Archive& a) {
    a(grains_);
  }

 private:
  struct Grain {
    bool known = false, rested = false, started = false;
    double x = 0, y = 0, since = 0;
    template <class Archive>
    void serialize(Archive& a) {
      a(known, rested, started, x, y, since);
    }
  };
  const RunContext& run_;
  Schedule due_;
  double step_, rest_;
  std::vector<Grain> grains_;
};

}  // namespace

std::vector<std::unique_ptr<Observer>> StartingOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<Starting>(run, *spec));
  return observers;
}

}  // namespace chute::measure
