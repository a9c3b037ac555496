#include "starts/pressed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/error.hpp"
#include "core/sphere.hpp"

namespace chute::starts {
namespace {

/// Grains on their way apart.
class Crush {
 public:
  Crush(const Opening& opening, double low, double high, std::vector<Launch>& grains)
      : up_(static_cast<std::size_t>(opening.dimensions) - 1),
        low_(low),
        high_(high),
        period_{opening.length, opening.width},
        grains_(grains),
        order_(grains.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    for (const auto& g : grains) widest_ = std::max(widest_, 2 * g.radius);
  }
  /// Every pair moves apart by half of what it overlaps by. The largest overlap that there was, in the smaller radius.
  double push() {
    std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(grains_[a].place[up_], a) < std::pair(grains_[b].place[up_], b);
    });
    double deepest = 0;
    for (std::size_t a = 0; a < order_.size(); ++a) {
      const auto i = order_[a];
      for (std::size_t b = a + 1; b < order_.size(); ++b) {
        const auto j = order_[b];
        // Others move meanwhile, so that the order is not quite that of heights: a little farther.
        if (grains_[j].place[up_] - grains_[i].place[up_] > 1.5 * widest_) break;
        deepest = std::max(deepest, part(grains_[i], grains_[j]));
      }
      hold(grains_[i]);
    }
    return deepest;
  }

 private:
  std::size_t up_;
  double low_, high_;
  std::array<double, 2> period_;
  std::vector<Launch>& grains_;
  std::vector<std::size_t> order_;
  double widest_ = 0;

  double part(Launch& a, Launch& b) const {
    std::array<double, 3> way{};
    double square = 0;
    for (std::size_t k = 0; k <= up_; ++k) {
      way[k] = b.place[k] - a.place[k];
      if (k < up_) way[k] -= period_[k] * std::round(way[k] / period_[k]);
      square += way[k] * way[k];
    }
    const double far = std::sqrt(square), overlap = a.radius + b.radius - far;
    if (overlap <= 0) return 0;
    for (std::size_t k = 0; k <= up_; ++k) {
      const double shift = far > 0 ? overlap / 2 * way[k] / far : (k == 0 ? overlap / 2 : 0);
      a.place[k] -= shift, b.place[k] += shift;
    }
    return overlap / std::min(a.radius, b.radius);
  }
  void hold(Launch& g) const {
    g.place[up_] = std::clamp(g.place[up_], low_ + g.radius, high_ - g.radius);
    for (std::size_t k = 0; k < up_; ++k) g.place[k] -= period_[k] * std::floor(g.place[k] / period_[k]);
  }
};

}  // namespace

std::optional<Refusal> Pressed::misfit(const Opening& o) const {
  if (o.length == 0 || (o.dimensions == 3 && o.width == 0))
    return Refusal{"grains.start",
                   "pressed grains fill a bounded domain: give domain.size, or a bed that has a size"};
  // Beyond these random close packings no pushing helps.
  const bool flat = o.dimensions == 2;
  const double densest = flat ? 0.84 : 0.63;
  double filled = 0;
  for (const double r : o.radii) filled += filled_by(r, o.dimensions);
  const double fraction = filled / ((high - low) * o.length * (flat ? 1 : o.width));
  if (fraction > densest)
    return Refusal{"grains.start.high",
                   fmt::format("grains would fill {:.3g} of the space, and at random they "
                               "find room up to {:.3g}; take fewer or more space",
                               fraction, densest)};
  return {};
}

std::vector<Launch> Pressed::begin(const Opening& o) const {
  std::vector<Launch> launches;
  for (std::size_t i = 0; i < o.radii.size(); ++i) {
    Random random(o.seed, Purpose::start, i, 1);  // step 0 are the velocities
    const double R = o.radii[i], along = random.uniform(0, o.length),
                 across = o.dimensions == 2 ? 0 : random.uniform(0, o.width);
    launches.push_back(launch_at(o, along, across, random.uniform(low + R, high - R), R));
  }
  Crush crush(o, low, high, launches);
  constexpr double shallow = 1e-3;  // overlap that is left, of a radius
  constexpr int most = 20000;
  int pushes = 0;
  while (crush.push() > shallow)
    if (++pushes == most)
      throw InputError(
          "grains.start.high: grains find no room between low and high; take fewer or more space");
  set_velocities(o, launches);
  return launches;
}

}  // namespace chute::starts
