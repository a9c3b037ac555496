#include "engines/kind/deep_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "search/pairs.hpp"

namespace chute::engines {

template <int D>
void refuse_deep_start(const Grains<D>& grains, const Surroundings<D>& around, double deepest,
                       std::span<const int> body) {
  for (const auto& x :
       grains.position)  // no cell has a place that is no number; methods tell of it as they go
    if (!std::all_of(x.begin(), x.end(), [](double at) { return std::isfinite(at); })) return;
  const auto& R = grains.radius;
  const auto name = [&](std::size_t i) { return body.empty() ? i : static_cast<std::size_t>(body[i]); };
  const auto refuse = [&](std::size_t i, const std::string& other, double depth) {
    throw InputError(fmt::format(
        "grains.start: grain {} overlaps {} by {:.3g} of the smaller radius at the start; grains of this method may by {:.2g}",
        name(i), other, depth, deepest));
  };
  for (std::size_t w = 0; w < around.walls.size(); ++w)
    for (std::size_t i = 0; i < grains.moving; ++i) {
      const double height = around.walls[w].nearest(grains.place(i), 0, around.domain).height;
      if (height < R[i] * (1 - deepest)) refuse(i, fmt::format("wall[{}]", w), (R[i] - height) / R[i]);
    }
  search::PairNames pairs;
  search::CellGrid<D>().find(grains, around.domain, 0, pairs);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto i = static_cast<std::size_t>(pairs.i[p]), j = static_cast<std::size_t>(pairs.j[p]);
    if (!body.empty() && body[i] == body[j]) continue;
    const double overlap = R[i] + R[j] - norm(around.domain.way(grains.place(i), grains.place(j)));
    if (overlap > deepest * std::min(R[i], R[j]))
      refuse(i, fmt::format("grain {}", name(j)), overlap / std::min(R[i], R[j]));
  }
}

namespace {

/// Moves a pair, or a grain and a wall, so that a little room is left between them. True if it had to.
template <int D>
class Pusher {
 public:
  Pusher(Grains<D>& grains, const Surroundings<D>& around, double touching)
      : grains_(grains), around_(around), touching_(touching) {}

  bool apart(std::size_t i, std::size_t j) {
    const Vec<D> way = around_.domain.way(grains_.place(i), grains_.place(j));
    const double far = norm(way), least = std::min(grains_.radius[i], grains_.radius[j]);
    const double overlap = grains_.radius[i] + grains_.radius[j] - far;
    if (overlap <= touching_ * least || far == 0) return false;
    const double push = (1 + room) * overlap / far;
    const double part = j < grains_.moving ? 0.5 : 1;  // what is fixed stays
    move(i, -part * push * way);
    if (j < grains_.moving) move(j, part * push * way);
    return true;
  }
  bool off(std::size_t i, const Wall<D>& wall) {
    const auto near = wall.nearest(grains_.place(i), 0, around_.domain);
    const double overlap = grains_.radius[i] - near.height;
    if (overlap <= touching_ * grains_.radius[i]) return false;
    move(i, (1 + room) * overlap * near.normal);
    return true;
  }

 private:
  static constexpr double room = 0.2;  // of the overlap: without it a packing would need sweeps without end
  Grains<D>& grains_;
  const Surroundings<D>& around_;
  double touching_;

  void move(std::size_t i, const Vec<D>& by) {
    for (std::size_t k = 0; k < D; ++k) grains_.position[k][i] += by[static_cast<int>(k)];
  }
};

}  // namespace

template <int D>
void push_apart(Grains<D>& grains, const Surroundings<D>& around, double touching) {
  constexpr int most_sweeps = 20000;  // a settled layer of N grains above each other needs about N²
  for (const auto& x : grains.position)
    if (!std::all_of(x.begin(), x.end(), [](double at) { return std::isfinite(at); })) return;
  if (grains.moving == 0) return;
  const double skin =
      0.05 * *std::min_element(grains.radius.begin(),
                               grains.radius.begin() + static_cast<std::ptrdiff_t>(grains.moving));
  // Sweeps from one list of neighbours to the next; what comes near meanwhile is found then.
  constexpr int often = 20;
  Pusher<D> pusher(grains, around, touching);
  search::PairNames pairs;
  for (int sweep = 0; sweep < most_sweeps;) {
    search::CellGrid<D>().find(grains, around.domain, skin, pairs);
    for (int k = 0; k < often; ++k, ++sweep) {
      bool moved = false;
      for (std::size_t p = 0; p < pairs.size(); ++p) {
        const auto i = static_cast<std::size_t>(pairs.i[p]), j = static_cast<std::size_t>(pairs.j[p]);
        moved = pusher.apart(std::min(i, j), std::max(i, j)) || moved;
      }
      for (const auto& wall : around.walls)
        for (std::size_t i = 0; i < grains.moving; ++i) moved = pusher.off(i, wall) || moved;
      if (!moved && k == 0) return;
      if (!moved) break;
    }
  }
  throw InputError(
      "grains.start: the grains overlap and lie too tight to be pushed apart; grains of this method may not overlap");
}

template void push_apart(Grains<2>&, const Surroundings<2>&, double);
template void push_apart(Grains<3>&, const Surroundings<3>&, double);
template void refuse_deep_start(const Grains<2>&, const Surroundings<2>&, double, std::span<const int>);
template void refuse_deep_start(const Grains<3>&, const Surroundings<3>&, double, std::span<const int>);

}  // namespace chute::engines
