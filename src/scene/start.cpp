#include "scene/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/error.hpp"
#include "core/random.hpp"

namespace chute::scene {
namespace {

/// Centres of the bed along x, and the length after which they repeat.
std::pair<std::vector<double>, double> bed_line(const Scene& scene) {
  const Bed& bed = scene.bed;
  if (bed.kind == Bed::Kind::none) return {{}, *bed.length};
  const double r = bed.diameter / 2;
  Random random(static_cast<std::uint64_t>(scene.seed), Purpose::bed);
  std::vector<double> centres;
  double x = r;
  for (std::int64_t i = 0; i < bed.count; ++i) {
    centres.push_back(x);
    const double eps = bed.kind == Bed::Kind::row ? bed.gap : random.uniform(0, bed.gap_max);
    x += 2 * r * (1 + eps);
  }
  return {centres, x - r};
}

void add_sphere(Grains<2>& grains, Vec<2> place, double radius, double density, bool moves) {
  const double mass = density * 4 / 3 * std::numbers::pi * radius * radius * radius;
  grains.add(place, radius, mass, 0.4 * mass * radius * radius, moves);
}

std::vector<double> radii_of(const Scene& scene) {
  Random sizes(static_cast<std::uint64_t>(scene.seed), Purpose::sizes);
  const double d = scene.mean_diameter(), std = scene.grains.diameter ? scene.grains.diameter->std : 0;
  std::vector<double> radii;
  while (radii.size() < static_cast<std::size_t>(scene.grains.count)) {
    const double z = std > 0 ? sizes.normal() : 0;
    if (std::abs(z) <= 3) radii.push_back((d + std * z) / 2);
  }
  return radii;
}

double lattice_spacing(const Scene& scene) {
  return scene.grains.start.spacing.value_or(1.25 * scene.mean_diameter());
}
std::int64_t lattice_columns(const Scene& scene, double length) {
  return static_cast<std::int64_t>(std::floor(length / lattice_spacing(scene) * (1 + 1e-12)));
}

void start_lattice(const Scene& scene, const std::vector<double>& radii, double length, Grains<2>& grains) {
  const auto columns = lattice_columns(scene, length);
  const double lowest =
      scene.grains.start.height.value_or(scene.bed.diameter / 2 + 1.5 * scene.mean_diameter());
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const auto column = static_cast<std::int64_t>(i) % columns, row = static_cast<std::int64_t>(i) / columns;
    const Vec<2> place{{(static_cast<double>(column) + 0.5) * length / static_cast<double>(columns),
                        lowest + static_cast<double>(row) * lattice_spacing(scene)}};
    add_sphere(grains, place, radii[i], scene.grains.density, true);
  }
}

/// A single grain, or many that do not feel each other.
void start_alone(const Scene& scene, const std::vector<double>& radii, const std::vector<double>& bed,
                 double length, Grains<2>& grains) {
  const double r_bed = scene.bed.diameter / 2, gap = bed.size() > 1 ? (bed[0] + bed[1]) / 2 : length / 2;
  const auto n = static_cast<double>(radii.size());
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double evenly = std::fmod(gap + static_cast<double>(i) * length / n, length);
    add_sphere(grains,
               {{scene.grains.start.x.value_or(evenly),
                 scene.grains.start.height.value_or(r_bed + radii[i] + 0.05 * r_bed)}},
               radii[i], scene.grains.density, true);
  }
}

}  // namespace

std::optional<Misfit> misfit(const Scene& scene) {
  const double length = bed_line(scene).second, d = scene.mean_diameter();
  const double needed = 2 * std::max(d, scene.bed.diameter) * 1.7;
  if (length < needed)
    return Misfit{
        scene.bed.length ? "bed.length" : "bed.count",
        fmt::format("a periodic line of length {:.4g} is too short for grains of diameter {:.4g}: a grain "
                    "would touch its own image; needed {:.4g}",
                    length, d, needed)};
  if (scene.grains.start.lattice != Start::Lattice::square) return {};
  const auto radii = radii_of(scene);
  const double largest = *std::max_element(radii.begin(), radii.end()), spacing = lattice_spacing(scene);
  if (lattice_columns(scene, length) < 1 || 2 * largest > spacing)
    return Misfit{
        "grains.start.spacing",
        fmt::format("{:.4g} is too small for grains of diameter {:.4g} or too large for a line of length "
                    "{:.4g}",
                    spacing, 2 * largest, length)};
  return {};
}

Start2D make_start(const Scene& scene) {
  if (const auto wrong = misfit(scene)) throw InputError(wrong->key + ": " + wrong->message);
  Start2D made;
  const auto [bed, length] = bed_line(scene);
  const double r_bed = scene.bed.diameter / 2;
  made.domain.length[0] = length;
  Random velocities(static_cast<std::uint64_t>(scene.seed), Purpose::start);
  const auto radii = radii_of(scene);
  made.grains.reserve(radii.size() + bed.size());
  const Start& start = scene.grains.start;
  if (start.lattice == Start::Lattice::square) {
    start_lattice(scene, radii, length, made.grains);
  } else {
    start_alone(scene, radii, bed, length, made.grains);
  }
  made.grains.independent = scene.grains.independent;
  if (!scene.grains.rotation)
    std::fill(made.grains.inverse_inertia.begin(), made.grains.inverse_inertia.end(), 0.0);
  for (std::size_t i = 0; i < made.grains.moving; ++i) {
    made.grains.velocity[0][i] = start.velocity + start.spread * velocities.normal();
    made.grains.velocity[1][i] = start.velocity_up + start.spread * velocities.normal();
  }
  for (double x : bed) add_sphere(made.grains, {{x, 0}}, r_bed, scene.grains.density, false);
  return made;
}

}  // namespace chute::scene
