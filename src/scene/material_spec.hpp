#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scene/diameter.hpp"

namespace chute::scene {

/// [[material]]: a species of grains, or what the bed or walls are made of.
struct MaterialSpec {
  std::string name;
  std::optional<double> density;  ///< else that of [grains]
  std::optional<double>
      share;  ///< of the grains, by number; of all together 1, or none is given: all are of the first
  std::optional<Diameter> diameter;  ///< of its grains; else that of [grains]
};

template <class Archive>
void describe(Archive& a, MaterialSpec& material) {
  a.required("name", material.name, "by which bed, walls, [[contact.between]] and legends call it");
  a.value("density", material.density, positive, "default that of [grains]");
  a.value(
      "share", material.share, unit_interval,
      "of the grains, by number; all shares together are 1; default 0, or if no material has one, 1 of the first");
  if constexpr (std::same_as<Archive, KeyLister>) {
    std::optional<double> any;
    a.value("diameter.…", any, "of its grains, with the keys of grains.diameter; default that");
  } else {
    a.section("diameter", material.diameter);
  }
}

/// Has every species of grains a diameter of its own?
bool all_have_diameters(const std::vector<MaterialSpec>& materials);

/// The part of the grains that each material has.
std::vector<double> shares_of(const std::vector<MaterialSpec>& materials);

/// Which material each of `count` grains is of: as many of each as its share says, to the nearest whole number, in an order that
/// is drawn by chance.
std::vector<int> draw_materials(const std::vector<MaterialSpec>& materials, std::size_t count,
                                std::uint64_t seed);

/// What of [[material]] cannot be; `brought`: the grains come with their sizes from elsewhere.
std::optional<Refusal> misfit(const std::vector<MaterialSpec>& materials, bool brought);

/// The number of the material of this name; nothing if there is none.
std::optional<int> number_of(const std::vector<MaterialSpec>& materials, const std::string& name);

}  // namespace chute::scene
