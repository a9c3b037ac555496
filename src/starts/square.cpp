#include "starts/square.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace chute::starts {

std::optional<Refusal> below_the_bed(const Opening& o, const std::optional<double>& height) {
  if (!height || (!o.ground.smooth && o.ground.beads.empty())) return {};
  if (o.ground.smooth && *height <= 0)
    return Refusal{"grains.start.height", fmt::format("{:.4g} lies below the bed, which is at 0", *height)};
  double lowest = std::numeric_limits<double>::infinity();
  for (const auto& bead : o.ground.beads) lowest = std::min(lowest, bead.above);
  if (o.ground.smooth || *height >= lowest) return {};
  return Refusal{"grains.start.height",
                 fmt::format("{:.4g} lies below the bed, whose beads are at {:.4g}", *height, lowest)};
}

std::int64_t Square::columns(double length, double step) const {
  return static_cast<std::int64_t>(std::floor(length / step * (1 + 1e-12)));
}

std::optional<Refusal> Square::misfit(const Opening& o) const {
  if (auto wrong = misfit_of_spin(o)) return wrong;
  if (auto wrong = below_the_bed(o, height)) return wrong;
  if (o.length == 0 || (o.dimensions == 3 && o.width == 0))
    return Refusal{"grains.start",
                   "a lattice fills a bounded domain: give domain.size, or a bed that has a size"};
  const double largest = *std::max_element(o.radii.begin(), o.radii.end()), d = step(o);
  const double narrowest = o.dimensions == 3 ? std::min(o.length, o.width) : o.length;
  if (columns(narrowest, d) >= 1 && 2 * largest <= d) return {};
  return Refusal{
      "grains.start.spacing",
      fmt::format(
          "{:.4g} is too small for grains of diameter {:.4g} or too large for a line of length {:.4g}", d,
          2 * largest, narrowest)};
}

std::vector<Launch> Square::begin(const Opening& o) const {
  const auto nx = columns(o.length, step(o)), ny = o.dimensions == 3 ? columns(o.width, step(o)) : 1;
  const double lowest = height.value_or(o.bead_diameter / 2 + 1.5 * o.mean_diameter);
  const auto middle = [](std::int64_t k, std::int64_t of, double length) {
    return (static_cast<double>(k) + 0.5) * length / static_cast<double>(of);
  };
  std::vector<Launch> launches;
  for (std::size_t i = 0; i < o.radii.size(); ++i) {
    const auto k = static_cast<std::int64_t>(i), layer = k / (nx * ny);
    launches.push_back(launch_at(o, middle(k % nx, nx, o.length), middle(k / nx % ny, ny, o.width),
                                 lowest + static_cast<double>(layer) * step(o), o.radii[i]));
  }
  set_velocities(o, launches);
  return launches;
}

std::optional<Refusal> Alone::misfit(const Opening& o) const {
  if (auto wrong = misfit_of_spin(o)) return wrong;
  if (auto wrong = below_the_bed(o, height)) return wrong;
  if (o.radii.size() != 1 && !o.independent)
    return Refusal{
        "grains.start",
        "lattice = \"none\" starts a single grain, or independent ones; use lattice = \"square\" for more"};
  if (y && o.dimensions == 2) return Refusal{"grains.start.y", "there is no place across in 2D"};
  if (!x && o.length == 0)
    return Refusal{"grains.start.x", "missing: where along an unbounded domain? Or give domain.size"};
  return {};
}

std::vector<Launch> Alone::begin(const Opening& o) const {
  const auto& beads = o.ground.beads;
  const double r = o.bead_diameter / 2;
  const double gap = beads.size() > 1 ? (beads[0].along + beads[1].along) / 2 : o.length / 2;
  const auto n = static_cast<double>(o.radii.size());
  std::vector<Launch> launches;
  for (std::size_t i = 0; i < o.radii.size(); ++i) {
    const double evenly = o.length > 0 ? std::fmod(gap + static_cast<double>(i) * o.length / n, o.length) : 0;
    // Beds of one row lie at y = 0; on a plane balls begin in the middle of it.
    const double across = y.value_or(o.ground.width ? *o.ground.width / 2 : 0);
    launches.push_back(
        launch_at(o, x.value_or(evenly), across, height.value_or(r + o.radii[i] + 0.05 * r), o.radii[i]));
  }
  set_velocities(o, launches);
  return launches;
}

}  // namespace chute::starts
