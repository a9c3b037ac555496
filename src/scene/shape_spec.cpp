#include "scene/shape_spec.hpp"

#include <fmt/format.h>

#include <cmath>

#include "clumps/make_clump.hpp"

namespace chute::scene {
namespace {

using clumps::Sphere;

std::int64_t spheres_of_rod(const ShapeSpec& shape) {
  if (*shape.aspect == 1) return 1;
  return shape.spheres.value_or(static_cast<std::int64_t>(std::ceil(2 * (*shape.aspect - 1) - 1e-9)) + 1);
}

std::vector<Sphere> spheres_of(const ShapeSpec& shape) {
  std::vector<Sphere> spheres;
  for (const auto& member : shape.members) {
    const auto& at = member.at;
    spheres.push_back({{{at[0], at[1], at.size() > 2 ? at[2] : 0}}, member.radius});
  }
  if (!shape.aspect) return spheres;
  const auto count = spheres_of_rod(shape);
  const double half = *shape.aspect - 1;  // from the middle to the last centre, in radii
  for (std::int64_t k = 0; k < count; ++k) {
    const double part = count == 1 ? 0.5 : static_cast<double>(k) / static_cast<double>(count - 1);
    spheres.push_back({{{(2 * part - 1) * half, 0, 0}}, 1});
  }
  return spheres;
}

/// Can one go from each sphere to each other through spheres that overlap or touch?
bool hang_together(const std::vector<Sphere>& spheres) {
  constexpr double touching = 1 + 1e-9;
  std::vector<std::size_t> reached{0};
  std::vector<bool> seen(spheres.size());
  seen[0] = true;
  for (std::size_t k = 0; k < reached.size(); ++k)
    for (std::size_t j = 0; j < spheres.size(); ++j) {
      const auto &a = spheres[reached[k]], &b = spheres[j];
      if (seen[j] || norm(b.centre - a.centre) > touching * (a.radius + b.radius)) continue;
      seen[j] = true;
      reached.push_back(j);
    }
  return reached.size() == spheres.size();
}

}  // namespace

std::optional<Refusal> misfit(const ShapeSpec& shape, const std::string& path, int dimensions) {
  constexpr std::size_t most = 50;
  const auto n = static_cast<std::size_t>(dimensions);
  if (shape.aspect.has_value() == !shape.members.empty())
    return Refusal{path, shape.aspect
                             ? "is two things at once, give either aspect (a rod) or member (spheres)"
                             : "lacks its shape, give aspect (a rod) or member (spheres)"};
  if (shape.spheres && !shape.aspect)
    return Refusal{path + ".spheres", "belongs to a rod, which has an aspect"};
  if (shape.members.size() > most)
    return Refusal{path + ".member", fmt::format("{} spheres are more than {}", shape.members.size(), most)};
  for (std::size_t k = 0; k < shape.members.size(); ++k)
    if (const auto size = shape.members[k].at.size(); size != n)
      return Refusal{fmt::format("{}.member[{}].at", path, k),
                     fmt::format("has {} numbers, needed {}", size, n)};
  if (shape.aspect) {
    if (spheres_of_rod(shape) > static_cast<std::int64_t>(most))
      return Refusal{path + ".aspect",
                     fmt::format("{:.4g} would take {} spheres, more than {}: give fewer spheres",
                                 *shape.aspect, spheres_of_rod(shape), most)};
    const double needed = *shape.aspect > 1 ? std::max(2.0, std::ceil(*shape.aspect - 1e-9)) : 1;
    if (static_cast<double>(spheres_of_rod(shape)) < needed)
      return Refusal{path + ".spheres", fmt::format("{} leave gaps in a rod of aspect {:.4g}, needed {:.0f}",
                                                    spheres_of_rod(shape), *shape.aspect, needed)};
  } else if (!hang_together(spheres_of(shape))) {
    return Refusal{path + ".member", "the spheres do not hang together"};
  }
  return {};
}

template <int D>
Clump<D> make_form(const ShapeSpec& shape) {
  return clumps::make_clump<D>(spheres_of(shape));
}

template Clump<2> make_form(const ShapeSpec&);
template Clump<3> make_form(const ShapeSpec&);

}  // namespace chute::scene
