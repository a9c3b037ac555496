#include "view/hidden.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

namespace chute::view {
namespace {

struct Seen {
  float depth, x, y;     ///< depth of the centre; its place in cells
  float inside, around;  ///< radii in cells of circles that lie inside the outline, and around it
};

/// A grid of cells over the picture that knows how near the nearest full cover is.
class Cover {
 public:
  Cover(int width, int height)
      : width_(width),
        height_(height),
        depth_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
               std::numeric_limits<float>::infinity()) {}

  /// True if every cell that the ball may touch is covered by something nearer than its nearest point.
  bool hides(const Seen& ball, float nearest) const {
    const float reach = ball.around + 0.5f;
    const int left = clamp(ball.x - reach, width_), right = clamp(ball.x + reach, width_);
    const int top = clamp(ball.y - reach, height_), bottom = clamp(ball.y + reach, height_);
    for (int y = top; y <= bottom; ++y) {
      const float* row = &depth_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_)];
      for (int x = left; x <= right; ++x)
        if (!(row[x] < nearest)) return false;
    }
    return true;
  }

  /// Covers the cells that lie inside `share` of the ball's outline with something at least as near as
  /// `depth`.
  void add(const Seen& ball, float share, float depth) {
    const float reach = share * ball.inside;
    if (reach < 0.8f) return;
    const int top = std::max(0, static_cast<int>(std::ceil(ball.y - reach)));
    const int bottom = std::min(height_ - 1, static_cast<int>(std::floor(ball.y + reach)) - 1);
    for (int y = top; y <= bottom; ++y) {
      // the farther edge of the row of cells decides
      const float dy =
          std::max(std::abs(static_cast<float>(y) - ball.y), std::abs(static_cast<float>(y + 1) - ball.y));
      const float half = reach * reach - dy * dy;
      if (half <= 0) continue;
      const float dx = std::sqrt(half);
      const int left = std::max(0, static_cast<int>(std::ceil(ball.x - dx)));
      const int right = std::min(width_ - 1, static_cast<int>(std::floor(ball.x + dx)) - 1);
      float* row = &depth_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_)];
      for (int x = left; x <= right; ++x) row[x] = std::min(row[x], depth);
    }
  }

 private:
  int width_, height_;
  std::vector<float> depth_;

  static int clamp(float x, int size) { return std::clamp(static_cast<int>(std::floor(x)), 0, size - 1); }
};

}  // namespace

std::vector<Ball> visible(const std::vector<Ball>& balls, const Eye& eye, int width, int height) {
  // axes of the eye; Eye keeps `towards` and `up` square and of length 1
  const Vector& t = eye.towards;
  const Vector& u = eye.up;
  const Vector r{u[1] * t[2] - u[2] * t[1], u[2] * t[0] - u[0] * t[2], u[0] * t[1] - u[1] * t[0]};
  std::vector<Seen> seen(balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i) {
    double along = 0, across = 0, above = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double d = balls[i].centre[c] - eye.centre[c];
      along += d * t[c], across += d * r[c], above += d * u[c];
    }
    const double depth = eye.distance - along, scale = eye.focal / depth;
    // off the axis the outline is an ellipse, longer by 1 / cos of the angle, its middle a little farther out
    const double longer = std::sqrt(1 + (across * across + above * above) / (depth * depth));
    const double radius = scale * balls[i].radius, shift = balls[i].radius / depth;
    seen[i] = {static_cast<float>(depth), static_cast<float>(eye.at.x + scale * across),
               static_cast<float>(eye.at.y - scale * above), static_cast<float>(radius * (1 - shift)),
               static_cast<float>(radius * longer * longer * (1 + shift))};
  }
  std::vector<std::uint32_t> order(balls.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return seen[a].depth != seen[b].depth ? seen[a].depth < seen[b].depth : a < b;
  });
  Cover cover(width, height);
  std::vector<char> keep(balls.size(), 0);
  for (const auto i : order) {
    const auto radius = static_cast<float>(balls[i].radius);
    if (cover.hides(seen[i], seen[i].depth - radius)) continue;
    keep[i] = 1;
    // The surface inside the whole outline is nearer than the centre, inside 0.75 of it by sqrt(1 - 0.75²) =
    // 0.66 radii and inside 0.95 by 0.31; a little less, for the rays that spread.
    cover.add(seen[i], 0.95f, seen[i].depth - 0.28f * radius);
    cover.add(seen[i], 0.75f, seen[i].depth - 0.62f * radius);
  }
  std::vector<Ball> result;
  for (std::size_t i = 0; i < balls.size(); ++i)
    if (keep[i]) result.push_back(balls[i]);
  return result;
}

}  // namespace chute::view
