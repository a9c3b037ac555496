#include "view/between.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <unordered_map>

#include "common/fields.hpp"

namespace chute::view {
namespace {

/// Where each grain of `a` is in `b`; empty if some came or went.
std::vector<std::size_t> matched(const read::GrainFrame& a, const read::GrainFrame& b) {
  if (a.size() != b.size()) return {};
  std::vector<std::size_t> where(a.size());
  const auto *before = a.find(fields::id.name), *after = b.find(fields::id.name);
  if (!before || !after) {
    for (std::size_t i = 0; i < where.size(); ++i) where[i] = i;
    return where;
  }
  std::unordered_map<double, std::size_t> of;
  for (std::size_t i = 0; i < b.size(); ++i) of[after->at(i)] = i;
  for (std::size_t i = 0; i < where.size(); ++i) {
    const auto found = of.find(before->at(i));
    if (found == of.end()) return {};
    where[i] = found->second;
  }
  return where;
}

bool only_names(const read::PointArray& array) {
  return std::ranges::any_of(std::array{fields::id, fields::type, fields::material},
                             [&](const auto& field) { return field.name == array.name; });
}

void turn(read::PointArray& array, const read::PointArray& later, std::span<const std::size_t> where,
          double part) {
  for (std::size_t i = 0; i < where.size(); ++i) {
    const auto quaternion = [](const read::PointArray& of, std::size_t k) {
      return Eigen::Quaterniond(of.at(k, 0), of.at(k, 1), of.at(k, 2), of.at(k, 3));
    };
    const auto q = quaternion(array, i).slerp(part, quaternion(later, where[i]));
    const std::array values{q.w(), q.x(), q.y(), q.z()};
    std::ranges::copy(values, array.values.begin() + static_cast<std::ptrdiff_t>(4 * i));
  }
}

}  // namespace

read::GrainFrame between(const read::GrainFrame& a, const read::GrainFrame& b, double part) {
  const auto where = matched(a, b);
  read::GrainFrame now = a;
  if (where.empty()) return now;
  const auto move = [&](std::vector<double>& place, const std::vector<double>& later, int axis) {
    const double period = a.period(axis), low = a.domain.min()[axis];
    for (std::size_t i = 0; i < where.size(); ++i) {
      double way = later[where[i]] - place[i];
      if (period > 0) way -= period * std::round(way / period);
      place[i] += part * way;
      if (period > 0) place[i] -= period * std::floor((place[i] - low) / period);
    }
  };
  move(now.x, b.x, 0), move(now.y, b.y, 1), move(now.z, b.z, 2);
  for (std::size_t i = 0; i < where.size(); ++i) now.radius[i] += part * (b.radius[where[i]] - a.radius[i]);
  if (a.time && b.time) now.time = *a.time + part * (*b.time - *a.time);
  for (auto& array : now.arrays) {
    const auto later = std::ranges::find(b.arrays, array.name, &read::PointArray::name);
    if (only_names(array) || later == b.arrays.end() || later->components != array.components) continue;
    if (array.name == fields::orientation.name && array.components == 4) {
      turn(array, *later, where, part);
      continue;
    }
    const auto n = static_cast<std::size_t>(array.components);
    for (std::size_t i = 0; i < where.size(); ++i)
      for (std::size_t c = 0; c < n; ++c) {
        double& value = array.values[n * i + c];
        value += part * (later->values[n * where[i] + c] - value);
      }
  }
  return now;
}

namespace {

/// Finds the grain whose centre is at a place, modulo the periods.
class Centres {
 public:
  explicit Centres(const read::GrainFrame& frame) : frame_(frame), order_(frame.size()) {
    for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = i;
    std::ranges::sort(order_, {}, [&](std::size_t i) { return wrapped(frame.x[i]); });
  }

  std::optional<std::size_t> at(const Eigen::Vector3d& place) const {
    constexpr double same =
        1e-3;  // radii: files with fewer digits than the grains' still say whose centre it is
    const double x = wrapped(place.x()), period = frame_.period(0);
    for (const double shift : {0.0, -period, period}) {
      const double near = same * largest();
      auto k = std::ranges::lower_bound(order_, x + shift - near, {},
                                        [&](std::size_t i) { return wrapped(frame_.x[i]); });
      for (; k != order_.end() && wrapped(frame_.x[*k]) <= x + shift + near; ++k)
        if (frame_.shortest(place - frame_.centre(*k)).norm() <= same * frame_.radius[*k]) return *k;
      if (period == 0) break;
    }
    return {};
  }

 private:
  const read::GrainFrame& frame_;
  std::vector<std::size_t> order_;  // of grains, by x

  double wrapped(double x) const {
    const double period = frame_.period(0), low = frame_.domain.min()[0];
    return period > 0 ? x - period * std::floor((x - low) / period) : x;
  }
  double largest() const { return frame_.radius.empty() ? 0 : std::ranges::max(frame_.radius); }
};

}  // namespace

void move_ends(std::vector<read::ForceLink>& links, const read::GrainFrame& a, const read::GrainFrame& now) {
  if (links.empty()) return;
  const Centres centres(a);
  for (auto& link : links)
    for (Eigen::Vector3d* end : {&link.from, &link.to})
      if (const auto grain = centres.at(*end)) *end += a.shortest(now.centre(*grain) - a.centre(*grain));
}

}  // namespace chute::view
