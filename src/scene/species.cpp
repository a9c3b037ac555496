#include "scene/species.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/error.hpp"
#include "common/toml_reader.hpp"
#include "core/sphere.hpp"

namespace chute::scene {
namespace {

/// That of the species' own, or of all grains.
double mean_diameter(const Scene& scene, const std::optional<Diameter>& own) {
  if (own) return own->average();
  return scene.grains.diameter ? scene.grains.diameter->average()
                               : *scene.grains.size_ratio * scene.bed->diameter;
}
}  // namespace

double density_of(const Scene& scene, int material) {
  if (scene.materials.empty()) return scene.grains.density;
  return scene.materials.at(static_cast<std::size_t>(material)).density.value_or(scene.grains.density);
}

int material_of(const Scene& scene, const std::optional<std::string>& name) {
  return name ? number_of(scene.materials, *name).value() : 0;
}

std::optional<MeanGrain> mean_grain(const Scene& scene) {
  if (scene.grains.start->brings_grains() || scene.engine->brings_grains()) return {};
  const auto of = [&](int material, const std::optional<Diameter>& own) {
    const double d = mean_diameter(scene, own);
    return MeanGrain{d, sphere_mass(density_of(scene, material), d / 2)};
  };
  if (scene.materials.empty()) return of(0, {});
  const auto shares = shares_of(scene.materials);
  MeanGrain mean{0, 0};
  for (std::size_t k = 0; k < shares.size(); ++k) {
    if (shares[k] == 0) continue;
    const auto one = of(static_cast<int>(k), scene.materials[k].diameter);
    mean.diameter += shares[k] * one.diameter, mean.mass += shares[k] * one.mass;
  }
  return mean;
}

std::vector<int> materials_of(const Scene& scene) {
  const auto count = static_cast<std::size_t>(scene.grains.count);
  if (scene.materials.empty()) return std::vector<int>(count, 0);
  return draw_materials(scene.materials, count, seed_of(scene));
}

std::vector<double> radii_of(const Scene& scene) {
  const auto materials = materials_of(scene);
  std::vector<double> radii;
  for (std::size_t i = 0; i < materials.size(); ++i) radii.push_back(radius_of(scene, materials[i], i));
  return radii;
}

double radius_of(const Scene& scene, int material, std::uint64_t item) {
  const auto& own = scene.materials.empty() ? scene.grains.diameter
                                            : scene.materials[static_cast<std::size_t>(material)].diameter;
  const auto& spread = own ? own : scene.grains.diameter;
  Random random(seed_of(scene), Purpose::sizes, item);
  return (spread ? spread->draw(random) : mean_diameter(scene, {})) / 2;
}

std::optional<Refusal> refusal_of_materials(const Scene& scene) {
  const bool brought = scene.grains.start->brings_grains();
  if (auto wrong = misfit(scene.materials, brought)) return wrong;
  if (scene.materials.empty() && !scene.contact.between.empty())
    return Refusal{"contact.between", "there is no [[material]] that it could be between"};
  std::vector<std::string> names;
  for (const auto& material : scene.materials) names.push_back(material.name);
  const auto unknown = [&](const std::optional<std::string>& name,
                           const std::string& key) -> std::optional<Refusal> {
    if (!name || number_of(scene.materials, *name)) return {};
    const auto hint = nearest(*name, names);
    return Refusal{
        key, names.empty() ? fmt::format("\"{}\": there is no [[material]]", *name)
             : hint.empty()
                 ? fmt::format("\"{}\" is no [[material]], there are: {}", *name, fmt::join(names, ", "))
                 : fmt::format("\"{}\" is no [[material]], did you mean {}?", *name, hint)};
  };
  if (auto wrong = unknown(scene.bed_material, "bed.material")) return wrong;
  const auto shares = shares_of(scene.materials);
  for (std::size_t k = 0; k < scene.grains.shapes.size(); ++k) {
    const auto& name = scene.grains.shapes[k].material;
    const auto key = fmt::format("grains.shape[{}].material", k);
    if (auto wrong = unknown(name, key)) return wrong;
    if (name && shares[static_cast<std::size_t>(material_of(scene, name))] == 0)
      return Refusal{key, fmt::format("no grain is of \"{}\", its share is 0", *name)};
  }
  for (std::size_t w = 0; w < scene.walls.size(); ++w)
    if (auto wrong = unknown(scene.walls[w].material, fmt::format("wall[{}].material", w))) return wrong;
  for (std::size_t k = 0; k < scene.contact.between.size(); ++k)
    for (const auto& name : scene.contact.between[k].materials)
      if (auto wrong = unknown(name, fmt::format("contact.between[{}].materials", k))) return wrong;
  return {};
}

void check_material(const Scene& scene, std::size_t grain, int material) {
  const auto known = static_cast<int>(scene.materials.size());
  if (known > 0 && (material < 0 || material >= known))
    throw InputError(
        fmt::format("grains.start: grain {} is of material {}, counted from 0, and there are {} [[material]]",
                    grain, material, known));
}

}  // namespace chute::scene
