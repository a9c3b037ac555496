#pragma once
#include "scene/scene.hpp"

/// What a scene says of its grains' materials and sizes, whether it names materials or not.
namespace chute::scene {

inline std::uint64_t seed_of(const Scene& scene) { return static_cast<std::uint64_t>(scene.seed); }

double density_of(const Scene& scene, int material);
/// The number of a material by its name; without one the first.
int material_of(const Scene& scene, const std::optional<std::string>& name);

/// InputError if a start gives a grain a material that the scene does not have; without materials nobody asks.
void check_material(const Scene& scene, std::size_t grain, int material);

/// What the scene says of a mean grain: of all species, each with its share. Nothing where it does not say the grains.
struct MeanGrain {
  double diameter, mass;
};
std::optional<MeanGrain> mean_grain(const Scene& scene);

/// Materials and radii of the grains that the scene describes, in the order of their ids.
std::vector<int> materials_of(const Scene& scene);
std::vector<double> radii_of(const Scene& scene);
/// The radius of one grain of a material, drawn for that item.
double radius_of(const Scene& scene, int material, std::uint64_t item);

/// What of its materials cannot be; all above wants it to be nothing.
std::optional<Refusal> refusal_of_materials(const Scene& scene);

}  // namespace chute::scene
