#include "engines/restructuring/columns.hpp"

#include <numeric>

namespace chute::restructuring {

template <int D>
Columns<D>::Columns(const Grains<D>& grains, const Domain<D>& domain) : domain_(domain) {
  const double mean =
      std::accumulate(grains.radius.begin(),
                      grains.radius.begin() + static_cast<std::ptrdiff_t>(grains.moving), 0.0) /
      static_cast<double>(grains.moving);
  const auto larger = [&](double r) { return r > giant * mean; };
  const auto giants = std::ranges::count_if(grains.radius, larger);
  if (giants <= static_cast<std::ptrdiff_t>(most_giants)) giant_from_ = giant * mean;
  for (const double r : grains.radius)
    if (!(r > giant_from_)) largest_ordinary_ = std::max(largest_ordinary_, r);
  std::size_t total = 1;
  for (int k = 0; k + 1 < D; ++k) {
    double length = domain.length[k];
    lower_[k] = domain.lower[k];
    if (!domain.periodic(k)) {
      // An unbounded line: a heap of n grains is so wide, roughly. What lies farther out shares the last column.
      const auto [low, high] = std::minmax_element(grains.position[k].begin(), grains.position[k].end());
      const double heap = 2 * 2 * mean * std::pow(static_cast<double>(grains.moving), 1.0 / D);
      lower_[k] = *low - heap;
      length = *high - *low + 2 * heap;
    }
    count_[k] = std::max(1, static_cast<int>(length / (2 * mean)));
    width_[k] = length / count_[k];
    total *= static_cast<std::size_t>(count_[k]);
  }
  columns_.resize(total);
}

template <int D>
void Columns<D>::clear() {
  for (auto& column : columns_) column.clear();
  giants_.clear();
}

template <int D>
void Columns<D>::lay(const Placed<D>& grain) {
  if (grain.radius > giant_from_) {
    giants_.push_back(grain);
    return;
  }
  auto& column = columns_[column_at(grain.place)];
  auto where = column.end();
  while (where != column.begin() && (where - 1)->place[D - 1] > grain.place[D - 1]) --where;
  column.insert(where, grain);
}

template <int D>
void Columns<D>::take(const Placed<D>& grain) {
  const auto same = [&](const Placed<D>& other) { return other.id == grain.id; };
  if (grain.radius > giant_from_)
    std::erase_if(giants_, same);
  else
    std::erase_if(columns_[column_at(grain.place)], same);
}

template class Columns<2>;
template class Columns<3>;

}  // namespace chute::restructuring
