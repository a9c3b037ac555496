#include "view/solid_shading.hpp"

#include <algorithm>
#include <cmath>

namespace chute::view {
namespace {

using Eigen::Vector3f;

/// Light from all sides, what surfaces scatter, and how they shine: shares of 1.
constexpr float ambient = 0.26f, diffuse = 0.82f, shine = 0.12f;

struct Lamp {
  Vector3f direction;  ///< towards the lamp; right, up, depth
  float strength;
};
/// The key from the upper left behind the eye, and a weak lamp from the other side that opens the shadows.
const Lamp lamps[] = {{Vector3f(-0.55f, 0.9f, -1).normalized(), 0.88f},
                      {Vector3f(0.9f, 0.1f, -0.7f).normalized(), 0.25f}};

Vector3f vector(const Rgb& c) { return Eigen::Vector3d(c.r, c.g, c.b).cast<float>(); }

/// How much of a pixel lies on the inner side of an edge at `distance` pixels.
float cover(float distance) { return std::clamp(distance + 0.5f, 0.f, 1.f); }

}  // namespace

Shading::Shading(const SolidContent& content, const std::vector<SeenBall>& balls,
                 const std::vector<SeenRod>& rods, const Eye& eye, const SolidLook& look)
    : content_(content), balls_(balls), rods_(rods), eye_(eye), look_(look) {
  if (content.spots.empty()) return;
  first_spot_.resize(content.balls.size() + 1);
  for (const Spot& spot : content.spots) ++first_spot_[spot.ball + 1];
  for (std::size_t i = 1; i < first_spot_.size(); ++i) first_spot_[i] += first_spot_[i - 1];
}

Vector3f Shading::lit(const Vector3f& color, const Vector3f& normal, const Vector3f& towards) const {
  float light = ambient, glint = 0;
  for (const Lamp& lamp : lamps) {
    const float straight = normal.dot(lamp.direction);
    if (straight <= 0) continue;
    light += diffuse * lamp.strength * straight;
    const float mirrored = std::max(0.f, (2 * straight * normal - lamp.direction).dot(towards));
    const float power8 =
        std::pow(mirrored, 2) * std::pow(mirrored, 2) * std::pow(mirrored, 2) * std::pow(mirrored, 2);
    glint += shine * lamp.strength * power8 * power8 * power8;  // Phong's exponent is 24
  }
  return (light * color + Vector3f::Constant(glint)).cwiseMin(1);
}

/// Bands on three great circles that turn with the ball, and spots.
void Shading::mark(Vector3f& color, std::size_t i, const Vector3f& normal, float facing) const {
  const Ball& ball = content_.balls[i];
  const bool is_turned = ball.orientation.coeffs() != Eigen::Vector4f::Zero();
  const bool has_spots = !first_spot_.empty() && first_spot_[i] != first_spot_[i + 1];
  if (!is_turned && !has_spots) return;
  const auto pixels = static_cast<float>(eye_.focal * ball.radius / balls_[i].centre.z());
  // what a pixel on the surface is in units of the radius, where it is seen at a slant
  const float pixel = 1 / (pixels * std::max(facing, 0.2f));
  const Vector3f out = eye_.axes.transpose().cast<float>() * Vector3f(normal.x(), normal.y(), -normal.z());
  if (is_turned) {
    constexpr float half_width = 0.075f, strength = 0.62f;  // of a band, in radii; how much it differs
    constexpr float least = 7, enough = 14;  // pixels of radius at which bands can be told apart
    const Vector3f own = (ball.orientation.conjugate() * out).cwiseAbs();
    const float band = cover((half_width - own.minCoeff()) / pixel) *
                       std::clamp((pixels - least) / (enough - least), 0.f, 1.f);
    const bool is_light = brightness(ball.color) > 0.45;
    color +=
        strength * (is_light ? 1 : 0.9f) * band * ((is_light ? Vector3f::Zero() : Vector3f::Ones()) - color);
  }
  if (has_spots) {
    constexpr float radius = 0.17f;  // of a spot, in radii of its ball
    float spot = 0;
    for (auto k = first_spot_[i]; k < first_spot_[i + 1]; ++k)
      spot =
          std::max(spot, cover((radius - (out - content_.spots[k].direction.cast<float>()).norm()) / pixel));
    color += spot * (vector(look_.spot) - color);
  }
}

Shaded Shading::at(std::uint32_t name, double x, double y) const {
  const Vector3f towards = -sight(eye_, x, y).normalized().cast<float>();
  const bool is_ball = name < balls_.size();
  const auto rod = name - balls_.size();
  Hit surface;
  Vector3f color;
  double radius;  // that it shows here
  if (is_ball) {
    surface = hit(balls_[name], eye_, x, y);
    color = vector(content_.balls[name].color), radius = content_.balls[name].radius;
  } else {
    // the middle of a pixel may just miss what all of its samples hit
    surface = hit(rods_[rod], eye_, x, y)
                  .value_or(Hit{rods_[rod].from.z() - eye_.distance, -Eigen::Vector3d::UnitZ()});
    color = vector(content_.rods[rod].color), radius = rods_[rod].radius_from;
  }
  Shaded result{color, surface.normal.cast<float>(), static_cast<float>(surface.depth)};
  const float facing = std::clamp(result.normal.dot(towards), 0.f, 1.f);
  if (is_ball) mark(result.color, name, result.normal, facing);
  result.color = lit(result.color, result.normal, towards);
  if (look_.outlines) {
    // the distance from the rim, in pixels, of a ball so large
    const auto pixels = static_cast<float>(eye_.focal * radius / (eye_.distance + surface.depth));
    const float inside = pixels * (1 - std::sqrt(1 - facing * facing));
    const float width = std::clamp(0.07f * pixels, 0.7f, 2.5f);
    result.color +=
        0.85f * std::min(1.f, pixels / 3) * cover(width - inside - 0.5f) * (vector(look_.ink) - result.color);
  }
  return result;
}

}  // namespace chute::view
