#include "view/camera_path.hpp"

#include <algorithm>
#include <cmath>

namespace chute::view {
namespace {

/// Slope at an inner point: the weighted harmonic mean of the slopes of its two pieces, 0 where these differ in sign.
double slope_at(const std::vector<double>& t, const std::vector<double>& y, std::size_t k) {
  if (k == 0 || k + 1 == t.size()) return 0;
  const double before = t[k] - t[k - 1], after = t[k + 1] - t[k];
  const double a = (y[k] - y[k - 1]) / before, b = (y[k + 1] - y[k]) / after;
  if (a * b <= 0) return 0;
  const double w = 2 * after + before, v = after + 2 * before;
  return (w + v) / (w / a + v / b);
}

}  // namespace

double smooth_through(const std::vector<double>& t, const std::vector<double>& y, double at) {
  if (at <= t.front()) return y.front();
  if (at >= t.back()) return y.back();
  const auto k = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), at) - t.begin()) - 1;
  const double length = t[k + 1] - t[k], u = (at - t[k]) / length;
  const double from = slope_at(t, y, k) * length, to = slope_at(t, y, k + 1) * length;
  // Hermite's cubic
  return (1 + 2 * u) * (1 - u) * (1 - u) * y[k] + u * (1 - u) * (1 - u) * from +
         u * u * (3 - 2 * u) * y[k + 1] + u * u * (u - 1) * to;
}

Camera camera_at(const FrameStyle& style, double time) {
  Camera camera = style.camera;
  const auto& keys = style.camera_keys;
  if (keys.empty()) return camera;
  std::vector<double> times;
  for (const auto& key : keys) times.push_back(key.time);
  const auto through = [&](auto value_of) {
    std::vector<double> values;
    for (const auto& key : keys) values.push_back(value_of(key.camera));
    return smooth_through(times, values, time);
  };
  camera.azimuth = through([](const Camera& c) { return c.azimuth; });
  camera.elevation = through([](const Camera& c) { return c.elevation; });
  camera.zoom = std::exp(through([](const Camera& c) { return std::log(c.zoom); }));
  if (keys.front().camera.window) {
    camera.window.emplace();
    for (std::size_t edge = 0; edge < 4; ++edge)
      (*camera.window)[edge] = through([&](const Camera& c) { return (*c.window)[edge]; });
  }
  return camera;
}

}  // namespace chute::view
