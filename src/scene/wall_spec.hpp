#pragma once
#include <optional>
#include <string>
#include <vector>

#include "common/keys.hpp"
#include "core/wall.hpp"

namespace chute::scene {

/// A sin 2πft along a wall's normal.
struct Oscillation {
  double amplitude = 0, frequency = 0;
};

/// [[wall]], as it is written.
struct WallSpec {
  using Place = std::vector<double>;
  std::optional<Place> point, normal, from, to, axis, velocity;
  std::optional<std::vector<Place>> corners;
  std::optional<double> radius, spin;
  WallSurface surface;
  std::optional<std::string> material;
  std::optional<Oscillation> oscillation;

  bool is_plane() const { return normal.has_value(); }
  /// A plane that bears what falls on it straight down.
  bool is_level() const {
    return normal && normal->back() > 0 && (*normal)[0] == 0 && (*normal)[normal->size() - 2] == 0;
  }
  bool is_segment() const { return from.has_value() || to.has_value(); }
  bool moves() const { return velocity || oscillation || spin; }
};

template <class Archive>
void describe(Archive& a, Oscillation& oscillation) {
  a.required("amplitude", oscillation.amplitude, non_negative, "A");
  a.required("frequency", oscillation.frequency, non_negative, "f");
}

template <class Archive>
void describe(Archive& a, WallSpec& wall) {
  a.value("point", wall.point, any_number, "of a plane; or of a cylinder's axis, default the origin");
  a.value("normal", wall.normal, any_number, "of a plane, into the grains; of any length");
  a.value("from", wall.from, any_number, "one end of a segment (2D)");
  a.value("to", wall.to, any_number, "the other end");
  a.value("corners", wall.corners, "of a flat convex polygon (3D), in order");
  a.value("radius", wall.radius, positive, "of a cylinder with the grains inside; in 2D a circle");
  a.value("axis", wall.axis, any_number, "direction of a cylinder's axis (3D)");
  a.value("spin", wall.spin, any_number, "of a cylinder about its axis, anticlockwise");
  a.value("material", wall.material, "its name in [[material]]; default the first");
  a.value("friction", wall.surface.friction, non_negative,
          "μ of contacts with it; default as between grains");
  a.value("static_friction", wall.surface.static_friction, non_negative, "μ_s of contacts at rest with it");
  a.value("restitution", wall.surface.restitution, unit_interval, "e_n of contacts with it");
  a.value("tangential_restitution", wall.surface.tangential_restitution, between(-1, 1),
          "β of contacts with it");
  a.value("temperature", wall.surface.temperature, non_negative,
          "T, an energy: grains leave it as if they came from a gas at rest with it");
  a.value("velocity", wall.velocity, any_number, "with which it moves steadily");
  a.section("oscillation", wall.oscillation);
}

/// What is wrong with the wall, which has this path in the scene.
std::optional<Refusal> misfit(const WallSpec& wall, const std::string& path, int dimensions);

/// The wall of a specification that has no misfit.
template <int D>
Wall<D> make_wall(const WallSpec& spec);

}  // namespace chute::scene
