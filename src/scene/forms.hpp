#pragma once
#include <vector>

#include "core/world.hpp"
#include "scene/scene.hpp"

/// The forms of grains that are not round.
namespace chute::scene {

/// Those of [[grains.shape]], and that of one sphere if there are materials without a shape; empty where all grains are
/// round.
template <int D>
std::vector<Clump<D>> forms_of(const Scene& scene);

/// Which of them a grain of that material has: drawn by the shares.
std::size_t form_of(const Scene& scene, std::size_t grain, int material);

/// The orientation that a grain of form `which` begins with.
template <int D>
Orientation<D> first_orientation(const Scene& scene, std::size_t grain, std::size_t which,
                                 const Clump<D>& form);

/// What others must know of a form, in any dimension, for a grain of the volume of a sphere of radius 1. Empty where a shape
/// cannot be: others are asked before that is told.
struct FormSizes {
  double reach = 1;     ///< of its farthest point from the centre of mass
  double smallest = 1;  ///< radius of a sphere
  double lightest = 1;  ///< see Clump
  std::int64_t spheres = 1;
};
std::vector<FormSizes> sizes_of_forms(const Scene& scene);
/// Which of them grains of a material can have.
std::vector<std::size_t> forms_for(const Scene& scene, int material);

/// How much room a grain takes to either side at the start, over the radius of the sphere of its volume.
double widest_reach(const std::vector<FormSizes>& forms);

/// Adds a grain that is not round, for which the start has left room to `reach` on all sides.
template <int D>
void add_clump(const Scene& scene, const Vec<D>& place, double reach, int material, World<D>& world);

/// What of [[grains.shape]] cannot be, whatever the method.
std::optional<Refusal> refusal_of_shapes(const Scene& scene);

}  // namespace chute::scene
