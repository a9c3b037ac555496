#include "scene/forms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "core/sphere.hpp"
#include "scene/species.hpp"
#include "starts/scattered.hpp"

namespace chute::scene {
namespace {

/// Steps of Random, so that these draws are not those of the sizes and the velocities.
constexpr std::uint64_t drawing_forms = 1, drawing_orientations = 2;

ShapeSpec round_shape() {
  ShapeSpec shape;
  shape.aspect = 1;
  return shape;
}

std::optional<Refusal> misfit_of_shapes(const Scene& scene) {
  const auto& shapes = scene.grains.shapes;
  for (std::size_t k = 0; k < shapes.size(); ++k)
    if (auto wrong = misfit(shapes[k], fmt::format("grains.shape[{}]", k), scene.dimensions)) return wrong;
  return {};
}

bool some_are_round(const Scene& scene) {
  const auto shares = shares_of(scene.materials);
  for (std::size_t k = 0; k < shares.size(); ++k)
    if (shares[k] > 0 && forms_for(scene, static_cast<int>(k)).front() == scene.grains.shapes.size())
      return true;
  return false;
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
  if (!forms.empty() && some_are_round(scene)) forms.push_back(make_form<D>(round_shape()));
  return forms;
}

std::vector<std::size_t> forms_for(const Scene& scene, int material) {
  const auto& shapes = scene.grains.shapes;
  std::vector<std::size_t> own, open;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    if (!shapes[k].material)
      open.push_back(k);
    else if (number_of(scene.materials, *shapes[k].material) == material)
      own.push_back(k);
  }
  if (!own.empty()) return own;
  if (open.empty()) open.push_back(shapes.size());
  return open;
}

std::size_t form_of(const Scene& scene, std::size_t grain, int material) {
  const auto known = forms_for(scene, material);
  if (known.size() == 1) return known.front();
  const auto& shapes = scene.grains.shapes;
  double sum = 0;
  for (const auto k : known) sum += shapes[k].share;
  double left = sum * Random(seed_of(scene), Purpose::sizes, grain, drawing_forms).uniform();
  for (const auto k : known)
    if ((left -= shapes[k].share) < 0) return k;
  return known.back();
}

template <int D>
Orientation<D> first_orientation(const Scene& scene, std::size_t grain, std::size_t which,
                                 const Clump<D>& form) {
  const auto& shapes = scene.grains.shapes;
  if (which >= shapes.size() || shapes[which].orientation == Turned::written) return form.written;
  Random random(seed_of(scene), Purpose::start, grain, drawing_orientations);
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
  if (const auto* start = grains.start.as<starts::Scattered>();
      start && start->intruder && !scene.materials.empty())
    return Refusal{"grains.start.intruder",
                   "with [[material]] only round grains have an intruder among them"};
  return {};
}

double widest_reach(const std::vector<FormSizes>& forms) {
  double reach = 1;
  for (const auto& form : forms) reach = std::max(reach, form.reach);
  return reach;
}

template <int D>
void add_clump(const Scene& scene, const Vec<D>& place, double reach, int material, World<D>& world) {
  const std::size_t i = world.grains.size(), form = form_of(scene, i, material);
  const Clump<D>& clump = world.clumps.forms[form];
  const double scale = reach / clump.reach, mass = sphere_mass(density_of(scene, material), scale);
  world.grains.add(place, scale * clump.radius, mass, clump.inertia(mass, scale), true);
  const auto orientation = first_orientation(scene, i, form, clump);
  for (int k = 0; k < orientation_numbers<D>; ++k) world.grains.orientation[k].back() = orientation[k];
  world.clumps.form.push_back(static_cast<int>(form));
  world.clumps.scale.push_back(scale);
}

template std::vector<Clump<2>> forms_of(const Scene&);
template std::vector<Clump<3>> forms_of(const Scene&);
template Orientation<2> first_orientation(const Scene&, std::size_t, std::size_t, const Clump<2>&);
template Orientation<3> first_orientation(const Scene&, std::size_t, std::size_t, const Clump<3>&);
template void add_clump(const Scene&, const Vec<2>&, double, int, World<2>&);
template void add_clump(const Scene&, const Vec<3>&, double, int, World<3>&);

}  // namespace chute::scene
