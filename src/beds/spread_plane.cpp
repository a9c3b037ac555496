#include <algorithm>
#include <cmath>
#include <numbers>

#include "beds/crowd.hpp"
#include "beds/planes.hpp"
#include "core/random.hpp"

namespace chute::beds {
namespace {

using Place = std::array<double, 2>;

/// Beads that are rolled in against a growing front, along x from an uneven edge at 0.
class Front {
 public:
  explicit Front(double width) : width_(width) {}

  struct Bead {
    Place place;
    double room;  ///< the radius that it keeps others away with
  };

  /// The first beads lie at the edge, wherever there was room.
  bool lie(const Bead& bead) {
    if (!free(bead)) return false;
    beads_.push_back(bead);
    return true;
  }
  /// Rolls a bead into the gap that is nearest to the edge.
  void roll(double room) {
    std::vector<Place> gaps;
    const std::size_t first = rear();
    for (std::size_t a = first; a < beads_.size(); ++a)
      for (std::size_t b = a + 1; b < beads_.size(); ++b) resting(beads_[a], beads_[b], room, gaps);
    std::sort(gaps.begin(), gaps.end());
    for (const auto& gap : gaps)
      if (free({gap, room})) {
        beads_.push_back({gap, room});
        return;
      }
    beads_.push_back({{beads_.back().place[0] + beads_.back().room + room, beads_.back().place[1]}, room});
  }
  const std::vector<Bead>& beads() const { return beads_; }

 private:
  double width_;
  std::vector<Bead> beads_;

  double across(double a, double b) const { return b - a - width_ * std::round((b - a) / width_); }
  /// The first bead that can still be touched: gaps fill up in order, so that all is full some rows behind the last bead.
  std::size_t rear() const {
    constexpr double rows = 4;
    const auto reach = 20 + static_cast<std::size_t>(rows * width_ / (2 * beads_.back().room));
    return beads_.size() > reach ? beads_.size() - reach : 0;
  }
  bool free(const Bead& bead) const {
    constexpr double rounding = 1e-9;
    for (std::size_t k = beads_.empty() ? 0 : rear(); k < beads_.size(); ++k) {
      const double reach = (bead.room + beads_[k].room) * (1 - rounding);
      const double dx = bead.place[0] - beads_[k].place[0];
      if (std::abs(dx) >= reach) continue;
      const double dy = across(beads_[k].place[1], bead.place[1]);
      if (dx * dx + dy * dy < reach * reach) return false;
    }
    return true;
  }
  /// Where a bead touches both, on the side away from the edge.
  void resting(const Bead& a, const Bead& b, double room, std::vector<Place>& gaps) const {
    const double dx = b.place[0] - a.place[0], ra = a.room + room, rb = b.room + room;
    if (std::abs(dx) >= ra + rb) return;
    const double dy = across(a.place[1], b.place[1]);
    if (dx * dx + dy * dy >= (ra + rb) * (ra + rb)) return;
    const double d = std::sqrt(dx * dx + dy * dy);
    const double along = (d * d + ra * ra - rb * rb) / (2 * d),
                 h = std::sqrt(std::max(0.0, ra * ra - along * along));
    const double side = dy > 0 ? 1 : -1;  // the normal that points away from the edge
    Place p{a.place[0] + (along * dx + h * side * dy) / d, a.place[1] + (along * dy - h * side * dx) / d};
    p[1] -= width_ * std::floor(p[1] / width_);
    gaps.push_back(p);
  }
};

}  // namespace

Sheet SpreadPlane::arrange(const Site& site) const {
  // Each bead keeps others away by r(1 + u), u even in [0, 2 spare]; what spare makes the beads fill the plane is found by
  // trying.
  const auto rolled = [&](double spare) {
    Front front(width());
    constexpr int edge_tries = 400;
    std::size_t i = 0;
    for (; i < beads(); ++i) {
      Random random(site.seed, Purpose::bed, i);
      const double room = radius() * (1 + 2 * spare * random.uniform());
      bool lies = false;
      for (int k = 0; k < edge_tries && !lies; ++k) {
        const double x = random.uniform(0, 2 * radius());
        lies = front.lie({{x, random.uniform(0, width())}, room});
      }
      if (!lies) break;
    }
    for (; i < beads(); ++i)
      front.roll(radius() * (1 + 2 * spare * Random(site.seed, Purpose::bed, i).uniform()));
    return front.beads();
  };
  const auto reached = [&](const std::vector<Front::Bead>& front) {
    double sum = 0;  // twice the mean place is where the last row lies, on average
    for (const auto& bead : front) sum += bead.place[0] / static_cast<double>(front.size());
    return 2 * sum;
  };
  const double coverage =
      static_cast<double>(count) * std::numbers::pi * radius() * radius() / (length() * width());
  // Discs that are rolled in cover about this.
  constexpr double rolled_coverage = 0.8;
  double spare = std::max(0.0, std::sqrt(rolled_coverage / coverage) - 1);
  auto front = rolled(spare);
  constexpr int most_corrections = 3;
  for (int k = 0; k < most_corrections; ++k) {
    const double ratio = length() / reached(front);
    if (std::abs(ratio - 1) < 2e-3) break;
    spare = std::max(0.0, (1 + spare) * std::sqrt(ratio) - 1);
    front = rolled(spare);
  }
  Crowd crowd(length(), width());
  const double fit = length() / reached(front);
  for (const auto& bead : front) crowd.add({bead.place[0] * fit, bead.place[1]}, radius());
  crowd.draw_in(widest_hole * radius());
  return crowd.sheet();
}

}  // namespace chute::beds
