#include "view/extent.hpp"

#include <algorithm>
#include <cmath>

namespace chute::view {
namespace {

// Kept of a sequence, moving and fixed each; beyond that every second one, and so on. 32 MB.
constexpr std::size_t most_places = 1'000'000;
// Share of the grains that may lie outside at each end of each axis.
constexpr double tail = 0.005;
// Grains beyond an end are shown all the same if they lie within this share of the box's length from it: evenly spread ones
// would be cut off at every edge otherwise, and one that hops above a layer belongs to the picture.
constexpr double near = 0.5;
// Along an axis that counts as thin, grains spread less than this share of what they do along each other one.
constexpr double thin = 0.5;

}  // namespace

void Extent::Places::add(const Place& place) {
  if (seen++ % stride) return;
  kept.push_back(place);
  if (kept.size() < most_places) return;
  for (std::size_t i = 0; 2 * i < kept.size(); ++i) kept[i] = kept[2 * i];
  kept.resize((kept.size() + 1) / 2);
  stride *= 2;
}

void Extent::add(const Eigen::Vector3d& place, double radius, bool fixed) {
  low_ = low_.cwiseMin((place.array() - radius).matrix());
  high_ = high_.cwiseMax((place.array() + radius).matrix());
  (fixed ? fixed_ : moving_).add({place, radius});
}

Eigen::AlignedBox3d Extent::box_of(const std::vector<Place>& places, const Eigen::Matrix3d& turn,
                                   double left_out) const {
  Eigen::AlignedBox3d box;
  std::vector<double> ends(places.size());
  for (int axis = 0; axis < 3; ++axis)
    for (const bool high : {false, true}) {
      for (std::size_t i = 0; i < places.size(); ++i)
        ends[i] = turn.row(axis).dot(places[i].centre) + (high ? places[i].radius : -places[i].radius);
      const auto rank = std::lround(left_out * static_cast<double>(ends.size() - 1));
      const auto k = ends.begin() + (high ? static_cast<std::ptrdiff_t>(ends.size()) - 1 - rank : rank);
      std::nth_element(ends.begin(), k, ends.end());
      (high ? box.max() : box.min())[axis] = *k;
    }
  return box;
}

Extent::View Extent::view(int up, const Eigen::Matrix3d& turn, double shape, bool all) const {
  View view;
  // Without thinned samples and turns the ends are known exactly.
  const bool straight = turn.isIdentity(0);
  Eigen::AlignedBox3d whole;
  for (const auto* places : {&moving_.kept, &fixed_.kept})
    if (!places->empty()) whole.extend(box_of(*places, turn, 0));
  if (straight) whole = {low_, high_};
  view.box = whole;
  if (all || moving_.kept.empty()) return view;

  auto box = box_of(moving_.kept, turn, tail);
  const Eigen::Vector3d slack = near * box.sizes();
  const Eigen::AlignedBox3d reach(box.min() - slack, box.max() + slack);
  for (const auto& grain : moving_.kept) {
    const Eigen::Vector3d at = turn * grain.centre;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = at[axis] - grain.radius, high = at[axis] + grain.radius;
      if (low >= reach.min()[axis]) box.min()[axis] = std::min(box.min()[axis], low);
      if (high <= reach.max()[axis]) box.max()[axis] = std::max(box.max()[axis], high);
    }
  }
  const auto grains_above = box;
  for (const auto& bead : fixed_.kept) {
    const Eigen::Vector3d at = turn * bead.centre;
    bool below = true;
    for (int axis = 0; axis < 3; ++axis)
      below = below && (axis == up || (at[axis] >= grains_above.min()[axis] - bead.radius &&
                                       at[axis] <= grains_above.max()[axis] + bead.radius));
    if (below) box.extend((at.array() - bead.radius).matrix()).extend((at.array() + bead.radius).matrix());
  }
  if (shape > 0 && !fixed_.kept.empty()) {
    const auto bed = box_of(fixed_.kept, turn, 0);
    const bool wide = box.sizes().x() > shape * box.sizes().y();
    const int axis = wide ? 1 : 0;
    const double length = wide ? box.sizes().x() / shape : box.sizes().y() * shape;
    const double middle = box.center()[axis];
    box.min()[axis] = std::min(box.min()[axis], std::max(bed.min()[axis], middle - length / 2));
    box.max()[axis] = std::max(box.max()[axis], std::min(bed.max()[axis], middle + length / 2));
  }
  for (const auto& grain : moving_.kept)
    if (!box.contains(turn * grain.centre)) view.outside += moving_.stride;
  view.cropped = !box.contains(whole);
  view.about = view.outside > 0 && moving_.stride > 1;
  view.box = box;
  return view;
}

int Extent::thinnest() const {
  const auto& places = moving_.kept.empty() ? fixed_.kept : moving_.kept;
  if (places.empty()) return -1;
  const Eigen::Vector3d size = box_of(places, Eigen::Matrix3d::Identity(), tail).sizes();
  Eigen::Index axis = 0;
  const double least = size.minCoeff(&axis);
  const bool clear = (size.array() > least / thin).count() == 2;
  return clear ? static_cast<int>(axis) : -1;
}

}  // namespace chute::view
