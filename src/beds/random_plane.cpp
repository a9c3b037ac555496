#include <algorithm>
#include <cmath>

#include "beds/crowd.hpp"
#include "beds/planes.hpp"
#include "core/random.hpp"

namespace chute::beds {
namespace {

using Place = std::array<double, 2>;

/// Discs of one size that lie where there was room. Cells are so small that each holds the centre of one disc at most.
class Adsorption {
 public:
  Adsorption(double length, double width, double radius)
      : sheet_{length, width, {}}, reach_(2 * radius), nx_(cells(length)), ny_(cells(width)) {
    in_.assign(static_cast<std::size_t>(nx_ * ny_), none);
  }
  bool lie(const Place& place) {
    const auto x = static_cast<std::int64_t>(place[0] / sheet_.length * static_cast<double>(nx_));
    const auto y = static_cast<std::int64_t>(place[1] / sheet_.width * static_cast<double>(ny_));
    constexpr std::int64_t around = 2;  // cells are wider than half a disc's reach
    for (std::int64_t p = -around; p <= around; ++p)
      for (std::int64_t q = -around; q <= around; ++q) {
        const auto other = in_[cell(x + p, y + q)];
        if (other == none) continue;
        const auto way = sheet_.way(sheet_.place[other], place);
        if (std::hypot(way[0], way[1]) < reach_) return false;
      }
    in_[cell(x, y)] = sheet_.place.size();
    sheet_.place.push_back(place);
    return true;
  }

 private:
  static constexpr auto none = static_cast<std::size_t>(-1);
  Sheet sheet_;
  double reach_;
  std::int64_t nx_, ny_;
  std::vector<std::size_t> in_;

  std::int64_t cells(double size) const {
    return static_cast<std::int64_t>(std::ceil(size / (reach_ * std::sqrt(0.5))));
  }
  std::size_t cell(std::int64_t x, std::int64_t y) const {
    return static_cast<std::size_t>((x + nx_) % nx_ * ny_ + (y + ny_) % ny_);
  }
};

}  // namespace

Sheet RandomPlane::arrange(const Site& site) const {
  // A bead that finds no room in so many tries finds one in the largest hole: by then the plane is as good as saturated,
  // which random sequential adsorption is at a coverage of 0.547.
  constexpr int most_tries = 100000;
  Adsorption adsorption(length(), width(), radius());
  Crowd crowd(length(), width());
  for (bool lies = true; lies && crowd.size() < beads();) {
    Random random(site.seed, Purpose::bed, crowd.size());
    lies = false;
    for (int tries = 0; tries < most_tries && !lies; ++tries) {
      const double x = random.uniform(0, length());
      const Place place{x, random.uniform(0, width())};
      lies = adsorption.lie(place);
      if (lies) crowd.add(place, radius());
    }
  }
  crowd.add_in_holes(beads(), radius());
  crowd.draw_in(widest_hole * radius());
  return crowd.sheet();
}

}  // namespace chute::beds
