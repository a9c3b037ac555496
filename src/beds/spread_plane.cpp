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
  Front(double length, double width) : length_(length), width_(width) {}

  struct Bead {
    Place place;
    double room;  ///< the radius that it keeps others away with
  };

  /// The first beads lie at the edge, wherever there was room.
  bool lie(const Bead& bead) {
    if (!free(bead)) return false;
    add(bead);
    return true;
  }
  /// Rolls a bead into the gap that is nearest to the edge. False if there is none left before the edge's own image.
  bool roll(double room) {
    std::vector<Place> gaps;
    for (std::size_t a = 0; a < recent_.size(); ++a)
      for (std::size_t b = a + 1; b < recent_.size(); ++b)
        resting(beads_[recent_[a]], beads_[recent_[b]], room, gaps);
    std::sort(gaps.begin(), gaps.end());
    for (const auto& gap : gaps)
      if (gap[0] > line_ - look_back * room && gap[0] < length_ && free({gap, room})) {
        add({gap, room});
        return true;
      }
    return false;
  }
  const std::vector<Bead>& beads() const { return beads_; }

 private:
  double length_, width_;
  std::vector<Bead> beads_;
  double line_ = 0;                  // how far the farthest bead has come
  std::vector<std::size_t> recent_;  // beads near that line: those behind lie among others

  // Gaps are looked for so far behind the line, and beads remembered somewhat farther, or a gap at the rear would
  // not know of beads behind it; in radii.
  static constexpr double look_back = 6, remembered = 10;

  double across(double a, double b) const { return b - a - width_ * std::round((b - a) / width_); }
  void add(const Bead& bead) {
    line_ = std::max(line_, bead.place[0]);
    recent_.push_back(beads_.size());
    beads_.push_back(bead);
    std::erase_if(recent_,
                  [&](std::size_t k) { return beads_[k].place[0] < line_ - remembered * bead.room; });
  }
  bool apart(const Bead& a, const Bead& b, double shift) const {
    constexpr double rounding = 1e-9;
    const double reach = (a.room + b.room) * (1 - rounding);
    const double dx = a.place[0] - b.place[0] - shift, dy = across(b.place[1], a.place[1]);
    return dx * dx + dy * dy >= reach * reach;
  }
  bool free(const Bead& bead) const {
    for (const auto k : recent_)
      if (!apart(bead, beads_[k], 0)) return false;
    // The image of the first rows lies behind the last.
    constexpr double rows = 4;
    if (bead.place[0] < length_ - rows * bead.room) return true;
    for (std::size_t k = 0; k < beads_.size() && beads_[k].place[0] < rows * bead.room; ++k)
      if (!apart(bead, beads_[k], length_)) return false;
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
  // Each bead keeps others away by r(1 + u), u even in [0, 2 spare]; discs that are rolled in cover about this of a plane.
  constexpr double rolled_coverage = 0.8;
  const double coverage =
      static_cast<double>(count) * std::numbers::pi * radius() * radius() / (length() * width());
  const double spare = std::max(0.0, std::sqrt(rolled_coverage / coverage) - 1);
  Front front(length(), width());
  bool at_edge = true, lies = true;
  for (std::uint64_t i = 0; lies; ++i) {
    Random random(site.seed, Purpose::bed, i);
    const double room = radius() * (1 + 2 * spare * random.uniform());
    constexpr int edge_tries = 400;
    lies = false;
    for (int k = 0; at_edge && k < edge_tries && !lies; ++k) {
      const double x = random.uniform(0, 2 * radius());
      lies = front.lie({{x, random.uniform(0, width())}, room});
    }
    at_edge = lies && at_edge;
    if (!lies) lies = front.roll(room);
  }
  // Some beads too many or too few have come in: they are taken away here and there, or laid into the largest holes.
  std::vector<Place> places;
  for (const auto& bead : front.beads()) places.push_back(bead.place);
  Random lot(site.seed, Purpose::bed, places.size());
  while (places.size() > beads()) {
    const auto k = static_cast<std::size_t>(lot.uniform() * static_cast<double>(places.size()));
    places[k] = places.back();
    places.pop_back();
  }
  Crowd crowd(length(), width());
  for (const auto& place : places) crowd.add(place, radius());
  crowd.add_in_holes(beads(), radius());
  crowd.draw_in(widest_hole * radius());
  return crowd.sheet();
}

}  // namespace chute::beds
