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

template void refuse_deep_start(const Grains<2>&, const Surroundings<2>&, double, std::span<const int>);
template void refuse_deep_start(const Grains<3>&, const Surroundings<3>&, double, std::span<const int>);

}  // namespace chute::engines
