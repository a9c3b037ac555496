#include "view/between.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <unordered_map>

#include "common/fields.hpp"

namespace chute::view {
namespace {

constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

/// Where each grain of `a` is in `b`, or `nowhere`; empty if that is not known of any.
std::vector<std::size_t> matched(const read::GrainFrame& a, const read::GrainFrame& b) {
  std::vector<std::size_t> where(a.size(), nowhere);
  const auto *before = a.find(fields::id.name), *after = b.find(fields::id.name);
  if (!before || !after) {
    if (a.size() != b.size()) return {};
    std::iota(where.begin(), where.end(), std::size_t{0});
    return where;
  }
  std::unordered_map<double, std::size_t> of;
  for (std::size_t i = 0; i < b.size(); ++i) of[after->at(i)] = i;
  for (std::size_t i = 0; i < where.size(); ++i)
    if (const auto found = of.find(before->at(i)); found != of.end()) where[i] = found->second;
  return where;
}

bool only_names(const read::PointArray& array) {
  return std::ranges::any_of(std::array{fields::id, fields::type, fields::material},
                             [&](const auto& field) { return field.name == array.name; });
}

void turn(read::PointArray& array, const read::PointArray& later, std::span<const std::size_t> where,
          double part) {
  for (std::size_t i = 0; i < where.size(); ++i) {
    if (where[i] == nowhere) continue;
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
  const double wait = a.time && b.time ? part * (*b.time - *a.time) : 0;
  const auto* velocity = a.find(fields::velocity.name);
  const bool goes_on = velocity && velocity->components == 3;
  const auto move = [&](std::vector<double>& place, const std::vector<double>& later, int axis) {
    const double period = a.period(axis), low = a.domain.min()[axis];
    for (std::size_t i = 0; i < where.size(); ++i) {
      if (where[i] == nowhere) {
        if (goes_on) place[i] += wait * velocity->at(i, axis);
      } else {
        double way = later[where[i]] - place[i];
        if (period > 0) way -= period * std::round(way / period);
        place[i] += part * way;
      }
      if (period > 0) place[i] -= period * std::floor((place[i] - low) / period);
    }
  };
  move(now.x, b.x, 0), move(now.y, b.y, 1), move(now.z, b.z, 2);
  for (std::size_t i = 0; i < where.size(); ++i)
    if (where[i] != nowhere) now.radius[i] += part * (b.radius[where[i]] - a.radius[i]);
  if (a.time && b.time) now.time = *a.time + wait;
  for (auto& array : now.arrays) {
    const auto later = std::ranges::find(b.arrays, array.name, &read::PointArray::name);
    if (only_names(array) || later == b.arrays.end() || later->components != array.components) continue;
    if (array.name == fields::orientation.name && array.components == 4) {
      turn(array, *later, where, part);
      continue;
    }
    const auto n = static_cast<std::size_t>(array.components);
    for (std::size_t i = 0; i < where.size(); ++i)
      for (std::size_t c = 0; c < n && where[i] != nowhere; ++c) {
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

/// A contact and the numbers that its grains have in the earlier frame; `nowhere`: no grain, or one that comes later.
struct Joint {
  std::array<Eigen::Vector3d, 2> ends;
  std::array<std::size_t, 2> grains{nowhere, nowhere};
  double force;
  bool is_new = false;  ///< one of its grains is not there yet

  /// The same grains stand at the same ends; of one grain and a wall the grain is the first.
  void put_in_order() {
    if (grains[0] > grains[1]) std::swap(grains[0], grains[1]), std::swap(ends[0], ends[1]);
  }
  bool is_on_wall() const { return grains[0] != nowhere && grains[1] == nowhere; }
};

/// `earlier`: the number that each grain of the network has in the earlier frame. Ends go to where their grains are `now`.
std::vector<Joint> joints_of(const Network& network, std::span<const std::size_t> earlier,
                             const read::GrainFrame& now) {
  std::vector<Joint> joints;
  if (network.links.empty()) return joints;
  const Centres centres(network.grains);
  for (const auto& link : network.links) {
    Joint joint{{link.from, link.to}, {nowhere, nowhere}, link.force};
    for (const std::size_t k : {0u, 1u}) {
      const auto grain = centres.at(joint.ends[k]);
      if (!grain) continue;
      joint.grains[k] = earlier[*grain];
      joint.is_new = joint.is_new || joint.grains[k] == nowhere;
      if (joint.grains[k] != nowhere)
        joint.ends[k] += network.grains.shortest(now.centre(joint.grains[k]) - network.grains.centre(*grain));
    }
    joint.put_in_order();
    joints.push_back(joint);
  }
  return joints;
}

}  // namespace

std::vector<read::ForceLink> between(const Network& a, const Network& b, const read::GrainFrame& now,
                                     double part) {
  const auto where = matched(a.grains, b.grains);
  if (where.empty()) return a.links;
  std::vector<std::size_t> own(a.grains.size()), earlier(b.grains.size(), nowhere);
  std::iota(own.begin(), own.end(), std::size_t{0});
  for (std::size_t i = 0; i < where.size(); ++i)
    if (where[i] != nowhere) earlier[where[i]] = i;
  const auto before = joints_of(a, own, now), after = joints_of(b, earlier, now);

  std::map<std::array<std::size_t, 2>, std::vector<std::size_t>>
      later;  // joints of `b` that have no partner yet
  for (std::size_t i = 0; i < after.size(); ++i)
    if (!after[i].is_new) later[after[i].grains].push_back(i);
  std::vector<read::ForceLink> links;
  for (const auto& joint : before) {
    auto found = later.find(joint.grains);
    if (joint.grains[0] == nowhere || found == later.end() || found->second.empty()) {
      links.push_back({joint.ends[0], joint.ends[1], (1 - part) * joint.force});
      continue;
    }
    const auto way = [&](std::size_t i) -> Eigen::Vector3d {
      return now.shortest(after[i].ends[1] - joint.ends[1]);
    };
    const auto nearest =
        std::ranges::min_element(found->second, {}, [&](std::size_t i) { return way(i).norm(); });
    const auto& other = after[*nearest];
    Eigen::Vector3d end = joint.ends[1];
    if (joint.is_on_wall()) end += part * way(*nearest);
    links.push_back({joint.ends[0], end, joint.force + part * (other.force - joint.force)});
    found->second.erase(nearest);
  }
  for (const auto& [grains, joints] : later)
    for (const auto i : joints) links.push_back({after[i].ends[0], after[i].ends[1], part * after[i].force});
  return links;
}

}  // namespace chute::view
