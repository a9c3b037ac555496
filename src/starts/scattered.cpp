#include "starts/scattered.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/error.hpp"

namespace chute::starts {
namespace {

/// Grains put one by one into a box that repeats along and across, with cells to find who is near.
class Box {
 public:
  Box(const Opening& opening, double height, double widest)
      : dimensions_(static_cast<std::size_t>(opening.dimensions)),
        size_{opening.length, opening.width, height} {
    if (dimensions_ == 2) size_[1] = height;
    for (std::size_t k = 0; k < dimensions_; ++k) {
      count_[k] = std::max<std::int64_t>(1, static_cast<std::int64_t>(size_[k] / widest));
      total_ *= count_[k];
    }
    members_.resize(static_cast<std::size_t>(total_));
  }
  bool fits(const Launch& one) const {
    if (!apart(one, large_)) return false;
    bool free = true;
    for_near(one, [&](std::size_t cell) {
      for (const auto& other : members_[cell]) free = free && apart(one, other);
    });
    return free;
  }
  void add(const Launch& one) {
    std::size_t cell = 0;
    for (std::size_t k = 0; k < dimensions_; ++k)
      cell = cell * static_cast<std::size_t>(count_[k]) + static_cast<std::size_t>(index(one, k));
    members_[cell].push_back(one);
  }
  /// One that is wider than a cell.
  void add_large(const Launch& one) { large_ = one; }

 private:
  std::size_t dimensions_;
  std::array<double, 3> size_;
  std::array<std::int64_t, 3> count_{1, 1, 1};
  std::int64_t total_ = 1;
  std::vector<std::vector<Launch>> members_;
  Launch large_;

  std::int64_t index(const Launch& one, std::size_t k) const {
    const auto at = static_cast<std::int64_t>(one.place[k] / size_[k] * static_cast<double>(count_[k]));
    return std::clamp<std::int64_t>(at, 0, count_[k] - 1);
  }
  bool apart(const Launch& a, const Launch& b) const {
    double square = 0;
    for (std::size_t k = 0; k < dimensions_; ++k) {
      double d = a.place[k] - b.place[k];
      if (k + 1 < dimensions_) d -= size_[k] * std::round(d / size_[k]);
      square += d * d;
    }
    return square >= (a.radius + b.radius) * (a.radius + b.radius) || b.radius == 0;
  }
  template <class Visit>
  void for_near(const Launch& one, const Visit& visit) const {
    const std::size_t deep = dimensions_ == 3 ? 3 : 1;
    std::array<std::int64_t, 3> c{};
    for (std::size_t k = 0; k < dimensions_; ++k) c[k] = index(one, k);
    for (std::int64_t w = 0; w < static_cast<std::int64_t>(9 * deep); ++w) {
      const std::array<std::int64_t, 3> step{w % 3 - 1, w / 3 % 3 - 1, w / 9 - 1};
      std::size_t cell = 0;
      bool inside = true;
      for (std::size_t k = 0; k < dimensions_; ++k) {
        auto at = c[k] + step[k];
        if (k + 1 < dimensions_)
          at = (at + count_[k]) % count_[k];
        else
          inside = inside && at >= 0 && at < count_[k];
        cell = cell * static_cast<std::size_t>(count_[k]) +
               static_cast<std::size_t>(std::max<std::int64_t>(at, 0));
      }
      if (inside) visit(cell);
    }
  }
};

}  // namespace

std::optional<Refusal> Scattered::misfit(const Opening& o) const {
  if (auto wrong = misfit_of_spin(o)) return wrong;
  if (o.length == 0 || (o.dimensions == 3 && o.width == 0))
    return Refusal{"grains.start",
                   "scattered grains fill a bounded domain: give domain.size, or a bed that has a size"};
  return {};
}

std::vector<Launch> Scattered::begin(const Opening& o) const {
  const bool flat = o.dimensions == 2;
  const auto up = static_cast<std::size_t>(o.dimensions) - 1;
  auto radii = o.radii;
  if (intruder) radii.front() = *intruder * o.mean_diameter / 2;
  double filled = 0, widest = 0;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    filled +=
        flat ? std::numbers::pi * radii[i] * radii[i] : 4.0 / 3 * std::numbers::pi * std::pow(radii[i], 3);
    if (!(intruder && i == 0)) widest = std::max(widest, 2 * radii[i]);
  }
  const double ground = o.ground.smooth ? 0 : o.bead_diameter / 2;
  const double height = ground + filled / (fraction * o.length * (flat ? 1 : o.width)) + 2 * widest;
  Box box(o, height, std::max(widest, o.mean_diameter));
  std::vector<Launch> launches;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    constexpr int most_tries = 10000;
    if (intruder && i == 0) {
      launches.push_back(launch_at(o, o.length / 2, o.width / 2, ground + radii[i], radii[i]));
      launches.back().material = 1;
      box.add_large(launches.back());
      continue;
    }
    Random random(o.seed, Purpose::start, i, 1);  // step 0 are the velocities
    for (int tries = 0;; ++tries) {
      if (tries == most_tries)
        throw InputError("grains.start.fraction: grains find no room; use a smaller one");
      const double along = random.uniform(0, o.length), across = flat ? 0 : random.uniform(0, o.width);
      const auto one =
          launch_at(o, along, across, random.uniform(ground + radii[i], height - radii[i]), radii[i]);
      if (one.place[up] < ground + radii[i] || !box.fits(one)) continue;
      launches.push_back(one);
      break;
    }
    box.add(launches.back());
  }
  set_velocities(o, launches);
  return launches;
}

}  // namespace chute::starts
