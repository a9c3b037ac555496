#include "view/occlusion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace chute::view {
namespace {

using Eigen::Vector3f;

// M. McGuire, M. Mara, D. Luebke, Scalable Ambient Obscurance (HPG 2012): places on a spiral about the pixel, which
// starts at another angle in each pixel of a 4 x 4 block, and an average over such blocks.
constexpr int places = 12, turns = 5, side = 4;
/// More makes crevices darker; chosen so that a dense packing's grains keep two thirds of their brightness.
constexpr float strength = 1.7f;
/// Slopes that count as flat, so that a sphere does not darken itself; a share of the reach.
constexpr float flat = 0.012f;
/// Never more than so many pixels from the pixel: near grains would cost more than far ones.
constexpr float farthest = 160;

struct Place {
  float x, y;  ///< shares of the reach
};
using Spiral = std::array<Place, places>;

/// The spirals of a block's pixels, row by row.
std::array<Spiral, side * side> spirals() {
  // each angle once, in an order in which neighbours differ much
  constexpr int order[side * side] = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
  std::array<Spiral, side * side> result;
  for (std::size_t k = 0; k < result.size(); ++k)
    for (std::size_t i = 0; i < places; ++i) {
      const double far = (static_cast<double>(i) + 0.5) / places;
      const double angle = 2 * std::numbers::pi * (far * turns + order[k] / double{side * side});
      result[k][i] = {static_cast<float>(far * std::cos(angle)), static_cast<float>(far * std::sin(angle))};
    }
  return result;
}

/// Averages along one axis (`step` in the array) over a block, of pixels about as far away.
void smooth(const Surfaces& s, std::vector<float>& light, std::size_t step, float slack) {
  const std::vector<float> before = light;
  for (int y = side; y < s.height - side; ++y)
    for (int x = side; x < s.width - side; ++x) {
      const std::size_t i = s.index(x, y);
      const float depth = s.depths[i];
      if (depth == std::numeric_limits<float>::infinity()) continue;
      float sum = 0, count = 0;
      for (int k = -side / 2; k < side / 2; ++k) {
        const std::size_t j = i + static_cast<std::size_t>(k) * step;
        const float near = std::abs(s.depths[j] - depth) < slack ? 1.f : 0.f;
        sum += near * before[j], count += near;
      }
      light[i] = count > 0 ? sum / count : before[i];
    }
}

}  // namespace

Surfaces::Surfaces(int w, int h)
    : width(w),
      height(h),
      depths(static_cast<std::size_t>(w) * static_cast<std::size_t>(h),
             std::numeric_limits<float>::infinity()),
      normals(depths.size(), Vector3f::Zero()) {}

std::vector<float> ambient_light(const Surfaces& s, const Eye& eye, double reach) {
  static const auto patterns = spirals();
  const auto far = std::numeric_limits<float>::infinity();
  const auto focal = static_cast<float>(eye.focal), middle = static_cast<float>(eye.distance);
  const auto R = static_cast<float>(reach), atx = static_cast<float>(eye.at.x()),
             aty = static_cast<float>(eye.at.y());
  // right and up from the line through the pixel (cx, cy), so that no large numbers cancel
  std::vector<float> light(s.depths.size(), 1);
  for (int y = 0; y < s.height; ++y)
    for (int x = 0; x < s.width; ++x) {
      const std::size_t i = s.index(x, y);
      const float depth = s.depths[i];
      if (depth == far) continue;
      const Vector3f& n = s.normals[i];
      const float z = middle + depth, pixels = std::min(farthest, focal * R / z), world = pixels * z / focal;
      if (pixels < 1) continue;
      const float u = (static_cast<float>(x) + 0.5f - atx) / focal,
                  v = (aty - static_cast<float>(y) - 0.5f) / focal;
      const auto& spiral = patterns[static_cast<std::size_t>(side * (y % side) + x % side)];
      float dark = 0;
      for (const auto& place : spiral) {
        const int dx = static_cast<int>(pixels * place.x), dy = static_cast<int>(pixels * place.y);
        const int px = std::clamp(x + dx, 0, s.width - 1), py = std::clamp(y + dy, 0, s.height - 1);
        const float other = s.depths[s.index(px, py)];
        if (other == far) continue;
        const float along = other - depth, z2 = middle + other;
        const float a = along * u + z2 * static_cast<float>(px - x) / focal;
        const float b = along * v - z2 * static_cast<float>(py - y) / focal;
        const float square = a * a + b * b + along * along;
        const float above = a * n.x() + b * n.y() + along * n.z() - flat * world;
        const float nearby = std::max(0.f, 1 - square / (world * world));
        if (above > 0) dark += nearby * above / std::sqrt(square + 1e-4f * world * world);
      }
      light[i] = std::max(0.f, 1 - strength * 2 * dark / places);
    }
  const auto slack = static_cast<float>(0.3 * reach);
  smooth(s, light, 1, slack);
  smooth(s, light, static_cast<std::size_t>(s.width), slack);
  return light;
}

}  // namespace chute::view
