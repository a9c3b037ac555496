#include "scene/forms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "core/sphere.hpp"

namespace chute::scene {
namespace {

/// Steps of Random, so that these draws are not those of the sizes and the velocities.
constexpr std::uint64_t drawing_forms = 1, drawing_orientations = 2;

std::optional<Refusal> misfit_of_shapes(const Scene& scene) {
  const auto& shapes = scene.grains.shapes;
  for (std::size_t k = 0; k < shapes.size(); ++k)
    if (auto wrong = misfit(shapes[k], fmt::format("grains.shape[{}]", k), scene.dimensions)) return wrong;
  return {};
}

template <int D>
std::vector<FormSizes> sizes_of(const std::vector<Clump<D>>& forms) {
  std::vector<FormSizes> sizes;
  for (const auto& form : forms) {
    const auto smallest = std::ranges::min_element(form.members, {}, &Member<D>::radius);
    sizes.push_back({form.reach, smallest->radius, form.lightest, std::ssize(form.members)});
  }
  return sizes;
}

}  // namespace

template <int D>
std::vector<Clump<D>> forms_of(const Scene& scene) {
  std::vector<Clump<D>> forms;
  for (const auto& shape : scene.grains.shapes) forms.push_back(make_form<D>(shape));
  return forms;
}

std::size_t form_of(const Scene& scene, std::size_t grain) {
  const auto& shapes = scene.grains.shapes;
  double sum = 0;
  for (const auto& shape : shapes) sum += shape.share;
  double left =
      sum * Random(static_cast<std::uint64_t>(scene.seed), Purpose::sizes, grain, drawing_forms).uniform();
  for (std::size_t k = 0; k + 1 < shapes.size(); ++k)
    if ((left -= shapes[k].share) < 0) return k;
  return shapes.size() - 1;
}

template <int D>
Orientation<D> first_orientation(const Scene& scene, std::size_t grain, const Clump<D>& form) {
  if (scene.grains.shapes[form_of(scene, grain)].orientation == Turned::written) return form.written;
  Random random(static_cast<std::uint64_t>(scene.seed), Purpose::start, grain, drawing_orientations);
  Orientation<D> q;
  if constexpr (D == 2) {
    q[0] = random.uniform(0, 2 * std::numbers::pi);
  } else {  // evenly over all orientations
    for (int k = 0; k < 4; ++k) q[k] = random.normal();
    q = (1 / norm(q)) * q;
  }
  return q;
}

std::vector<FormSizes> sizes_of_forms(const Scene& scene) {
  if (misfit_of_shapes(scene)) return {};
  return scene.dimensions == 2 ? sizes_of(forms_of<2>(scene)) : sizes_of(forms_of<3>(scene));
}

std::optional<Refusal> refusal_of_shapes(const Scene& scene) {
  const auto& grains = scene.grains;
  if (auto wrong = misfit_of_shapes(scene)) return wrong;
  if (grains.shapes.empty()) return {};
  if (grains.start->brings_grains())
    return Refusal{"grains.shape", "the grains that grains.start brings are round"};
  if (grains.independent)
    return Refusal{"grains.independent", "only round grains can be told not to feel each other"};
  if (!grains.rotation)
    return Refusal{"grains.rotation", "grains that are not round turn when they are pushed"};
  if (!scene.materials.empty())
    return Refusal{"grains.shape", "grains that are not round are of one material: leave [[material]] out"};
  return {};
}

double widest_reach(const std::vector<FormSizes>& forms) {
  double reach = 1;
  for (const auto& form : forms) reach = std::max(reach, form.reach);
  return reach;
}

template <int D>
void add_clump(const Scene& scene, const Vec<D>& place, double reach, World<D>& world) {
  const std::size_t i = world.grains.size(), form = form_of(scene, i);
  const Clump<D>& clump = world.clumps.forms[form];
  const double scale = reach / clump.reach, mass = sphere_mass(scene.grains.density, scale);
  world.grains.add(place, scale * clump.radius, mass, clump.inertia(mass, scale), true);
  const auto orientation = first_orientation(scene, i, clump);
  for (int k = 0; k < orientation_numbers<D>; ++k) world.grains.orientation[k].back() = orientation[k];
  world.clumps.form.push_back(static_cast<int>(form));
  world.clumps.scale.push_back(scale);
}

template std::vector<Clump<2>> forms_of(const Scene&);
template std::vector<Clump<3>> forms_of(const Scene&);
template Orientation<2> first_orientation(const Scene&, std::size_t, const Clump<2>&);
template Orientation<3> first_orientation(const Scene&, std::size_t, const Clump<3>&);
template void add_clump(const Scene&, const Vec<2>&, double, World<2>&);
template void add_clump(const Scene&, const Vec<3>&, double, World<3>&);

}  // namespace chute::scene
