#pragma once
#include <cereal/types/deque.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>
#include <vector>

#include "core/grains.hpp"

namespace chute::measure {

/// Which grains have come to rest, and when: a grain that stays within a bead's spacing for a while. What it did shortly
/// before is no steady motion either.
class Standstill {
 public:
  Standstill() = default;
  Standstill(double bead_spacing, double gravity)
      : step_(bead_spacing), unit_(gravity > 0 ? std::sqrt(bead_spacing / gravity) : 0) {}

  /// Units of √(d/g), 10 ms for beads of 1 mm. A ball that stays at a bead for 50 has stopped: the slowest steady ones take
  /// 5 for it. Steady means end 150 before it stopped (1.5 s).
  static constexpr double rest = 50, unsteady = 150;

  void note(const GrainsView& grains) {
    grains_.resize(grains.moving);
    for (std::size_t i = 0; i < grains_.size(); ++i) {
      Grain& g = grains_[i];
      const double x = grains.unwrapped(i, 0), y = grains.dimensions == 3 ? grains.unwrapped(i, 1) : 0;
      if (!g.known) g = {true, false, x, y, x, grains.time};
      if (g.stopped) continue;
      if (std::hypot(x - g.x, y - g.y) > step_)
        g.x = x, g.y = y, g.since = grains.time;
      else if (grains.time - g.since > rest * unit_ && unit_ > 0)
        g.stopped = true;
    }
  }
  std::size_t size() const { return grains_.size(); }
  bool stopped(std::size_t i) const { return grains_[i].stopped; }
  /// Since when grain i has been where it is, and how far it went until then.
  double since(std::size_t i) const { return grains_[i].since; }
  double way(std::size_t i) const { return grains_[i].x - grains_[i].start; }
  double x(std::size_t i) const { return grains_[i].x; }
  double y(std::size_t i) const { return grains_[i].y; }

  /// What grain i did at `time` was steady motion, as far as can be told; `now` is late enough to tell.
  bool tells(double time, double now) const { return now - time > (rest + unsteady) * unit_; }
  bool steady(std::size_t i, double time) const {
    return i >= grains_.size() || !grains_[i].stopped || time < grains_[i].since - unsteady * unit_;
  }

  template <class Archive>
  void serialize(Archive& a) {
    a(grains_);
  }

 private:
  struct Grain {
    bool known = false, stopped = false;
    double x = 0, y = 0, start = 0, since = 0;
    template <class Archive>
    void serialize(Archive& a) {
      a(known, stopped, x, y, start, since);
    }
  };
  double step_ = 0, unit_ = 0;
  std::vector<Grain> grains_;
};

/// What was seen of each grain and does not count yet, for the grain may come to rest soon after.
template <class Sample>
class Pending {
 public:
  void add(std::size_t grain, double time, Sample sample) {
    if (of_.size() <= grain) of_.resize(grain + 1);
    of_[grain].emplace_back(time, std::move(sample));
  }
  /// visit(grain, time, sample) for all that count now, grain by grain in order of time; drops what never will.
  template <class Visit>
  void release(double now, const Standstill& rest, const Visit& visit) {
    for (std::size_t i = 0; i < of_.size(); ++i)
      for (auto& queue = of_[i]; !queue.empty() && rest.tells(queue.front().first, now); queue.pop_front())
        if (rest.steady(i, queue.front().first)) visit(i, queue.front().first, queue.front().second);
  }
  template <class Archive>
  void serialize(Archive& a) {
    a(of_);
  }

 private:
  std::vector<std::deque<std::pair<double, Sample>>> of_;
};

/// No more than so many samples, taken evenly from all that come: when it is full, every other one is dropped, and from then
/// on only every other one is taken.
template <class Sample>
class Thinned {
 public:
  explicit Thinned(std::int64_t most = 0) : most_(static_cast<std::size_t>(most)) {}
  void add(const Sample& sample) {
    if (seen_++ % stride_ != 0) return;
    if (kept_.size() == most_) {
      for (std::size_t k = 0; 2 * k < kept_.size(); ++k) kept_[k] = kept_[2 * k];
      kept_.resize((kept_.size() + 1) / 2);
      stride_ *= 2;
      if ((seen_ - 1) % stride_ != 0) return;
    }
    kept_.push_back(sample);
  }
  const std::vector<Sample>& kept() const { return kept_; }
  std::int64_t seen() const { return seen_; }
  template <class Archive>
  void serialize(Archive& a) {
    a(seen_, stride_, kept_);
  }

 private:
  std::size_t most_;
  std::int64_t seen_ = 0, stride_ = 1;
  std::vector<Sample> kept_;
};

}  // namespace chute::measure
