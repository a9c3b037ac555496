#pragma once
#include <optional>
#include <string>
#include <vector>

#include "common/keys.hpp"
#include "core/clump.hpp"

namespace chute::scene {

/// A sphere of a grain that is not round.
struct MemberSpec {
  std::vector<double> at;
  double radius = 1;
};

enum class Turned { random, written };
inline constexpr std::array<std::string_view, 2> turned_words{"random", "written"};

/// [[grains.shape]], as it is written: a rod, or spheres one by one. Only proportions count: a grain is as large as the sphere
/// of its diameter.
struct ShapeSpec {
  std::optional<double> aspect;
  std::optional<std::int64_t> spheres;
  std::vector<MemberSpec> members;
  Turned orientation = Turned::random;
  double share = 1;
  std::optional<std::string>
      material;  ///< of the grains that have it; else those for whose material none is told
};

template <class Archive>
void describe(Archive& a, MemberSpec& member) {
  a.required("at", member.at, any_number, "where the sphere lies: [x, y] in 2D, [x, y, z] in 3D");
  a.required("radius", member.radius, positive, "of the sphere");
}

template <class Archive>
void describe(Archive& a, ShapeSpec& shape) {
  a.value("aspect", shape.aspect, at_least(1), "of a rod along x, rounded at its ends: length over width");
  a.value("spheres", shape.spheres, between(1, 50),
          "of the rod, in a row; default so many that neighbours are a radius apart, or less");
  a.sections("member", shape.members);
  a.choice("orientation", shape.orientation, turned_words, "of the grains at the start");
  a.value("share", shape.share, positive, "of the grains, by number: so many parts of the sum of all shares");
  a.value(
      "material", shape.material,
      "only its grains have this shape, and shares count among theirs; default those of materials that no shape "
      "names; where all name another, grains are round");
}

/// What is wrong with the shape, which has this path in the scene.
std::optional<Refusal> misfit(const ShapeSpec& shape, const std::string& path, int dimensions);

/// The form of a specification that has no misfit.
template <int D>
Clump<D> make_form(const ShapeSpec& shape);

}  // namespace chute::scene
