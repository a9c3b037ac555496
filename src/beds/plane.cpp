#include "beds/plane.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <mutex>
#include <numbers>
#include <typeinfo>

namespace chute::beds {
namespace {

constexpr double pi = std::numbers::pi;

/// Planes that were made, by what they were made of. A sweep uses the same few again and again, in several threads.
class Remembered {
 public:
  template <class Make>
  Plane::Arranged get(const std::string& recipe, const Make& make) {
    const std::lock_guard lock(mutex_);
    if (const auto known = planes_.find(recipe); known != planes_.end()) return known->second;
    constexpr std::size_t most = 64;  // of some 100 kB each
    if (planes_.size() == most) planes_.clear();
    return planes_[recipe] = make();
  }

 private:
  std::mutex mutex_;
  std::map<std::string, Plane::Arranged> planes_;
};

}  // namespace

PlaneShape shape_of(const Sheet& sheet, double radius) {
  const auto t = tessellate(sheet);
  const auto n = static_cast<double>(sheet.place.size());
  PlaneShape shape{};
  shape.beads = n;
  shape.coverage = n * pi * radius * radius / (sheet.length * sheet.width);
  constexpr double noticeable = 0.01, deep = 1.77;  // the hole of thesis fig. 4.33c: 6 r sin 0.3
  for (const auto& edge : t.edges)
    if (edge.distance < (2 - noticeable) * radius)
      shape.overlapping += 1 / static_cast<double>(t.edges.size());
  for (const auto& v : t.vertices) {
    shape.widest_hole = std::max(shape.widest_hole, v.distance / radius);
    if (v.distance > deep * radius) shape.deep_holes += 1 / static_cast<double>(t.vertices.size());
  }
  std::vector<std::complex<double>> psi(sheet.place.size());
  std::vector<double> bonds(sheet.place.size());
  for (const auto& edge : t.edges) {
    // The other way round the angle is larger by π, which sixfold is a whole number of turns.
    const auto turn = std::polar(1.0, 6 * std::atan2(edge.way[1], edge.way[0]));
    for (const auto i : {edge.a, edge.b}) psi[i] += turn, bonds[i] += 1;
  }
  std::complex<double> sum;
  for (std::size_t i = 0; i < psi.size(); ++i) {
    psi[i] /= bonds[i];
    sum += psi[i];
    shape.hexatic_of_neighbours += std::abs(psi[i]) / n;
  }
  shape.hexatic = std::abs(sum) / n;
  return shape;
}

std::vector<Fact> plane_facts(const Sheet& sheet, double radius) {
  const auto shape = shape_of(sheet, radius);
  return {{"beads", shape.beads, "", "of the plane, in one period"},
          {"coverage", shape.coverage, "", "area of all beads over the area of the plane"},
          {"overlapping", shape.overlapping, "",
           "part of the neighbouring pairs that overlap by more than r/100"},
          {"widest hole", shape.widest_hole, "r", "largest distance of a Voronoi vertex from its beads"},
          {"deep holes", shape.deep_holes, "",
           "part of the Voronoi vertices that are farther than 1.77 r from their beads"},
          {"psi_6", shape.hexatic, "", "sixfold order of the whole plane: 1 on a triangular lattice"},
          {"psi_6 local", shape.hexatic_of_neighbours, "",
           "sixfold order of the neighbours of a bead, on average"}};
}

std::optional<Refusal> Plane::misfit(const Site& site) const {
  if (site.dimensions != 3) return Refusal{"bed.kind", "a plane of beads needs dimensions = 3"};
  // Beads of one size cover no more than 0.907 without overlap, and that only in order; disordered ones some 0.82.
  constexpr double fullest = 0.8;
  const double coverage = static_cast<double>(count) * pi * radius() * radius() / (length() * width());
  if (coverage > fullest)
    return Refusal{"bed.count",
                   fmt::format("these beads would cover {:.4g} of the plane; disordered ones find "
                               "room up to {:g}",
                               coverage, fullest)};
  // There a ball would fall into a gap at once.
  constexpr double emptiest = 0.01;
  if (coverage < emptiest)
    return Refusal{"bed.count", fmt::format("these beads would cover {:.3g} of the plane, less than {:g}",
                                            coverage, emptiest)};
  constexpr double narrowest = 2;  // diameters: or a bead and its own image are neighbours
  if (std::min(length(), width()) < narrowest * diameter)
    return Refusal{"bed.size",
                   fmt::format("{:.4g} is less than {:g} diameters of a bead, which repeats after it",
                               std::min(length(), width()), narrowest)};
  return {};
}

Plane::Arranged Plane::arranged(const Site& site) const {
  // Arranged with beads of diameter 1, so that planes that differ in their size only, as those under balls of several
  // size ratios do, are one.
  const double unit = has_own_lengths() ? 1 : diameter;
  const auto copy = clone();
  auto& plane = dynamic_cast<Plane&>(*copy);
  plane.diameter /= unit;
  if (size)
    for (double& side : *plane.size) side /= unit;
  TomlWriter keys;
  plane.write(keys);
  static Remembered remembered;
  auto found = remembered.get(std::to_string(site.seed) + typeid(*this).name() + keys.text(), [&] {
    Arranged made{plane.arrange(site), 0};
    constexpr std::size_t fewest = 3;  // that divide a plane; files may have fewer, which misfit() refuses
    if (made.sheet.place.size() < fewest) return made;
    for (const auto& v : tessellate(made.sheet).vertices)
      made.widest_hole = std::max(made.widest_hole, v.distance);
    return made;
  });
  found.widest_hole *= unit;
  auto& sheet = found.sheet;
  sheet.length = length(), sheet.width = width();
  for (auto& place : sheet.place) place = sheet.wrapped({unit * place[0], unit * place[1]});
  return found;
}

Sheet Plane::sheet(const Site& site) const { return arranged(site).sheet; }

Ground Plane::lay(const Site& site) const {
  const auto [sheet, widest_hole] = arranged(site);
  Ground ground;
  for (const auto& p : sheet.place) ground.beads.push_back({p[0], p[1], 0, radius()});
  ground.length = sheet.length;
  ground.width = sheet.width;
  ground.spacing = std::sqrt(sheet.length * sheet.width / static_cast<double>(sheet.place.size()));
  ground.widest_spacing = 2 * widest_hole;
  return ground;
}

std::vector<Fact> Plane::facts(const Site& site) const { return plane_facts(sheet(site), radius()); }

}  // namespace chute::beds
