#include "view/camera_path.hpp"

#include <boost/math/interpolators/cubic_hermite.hpp>
#include <cmath>
#include <utility>

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
  // Boost's own pchip wants four points at least, and is not level at the ends.
  std::vector<double> slopes;
  for (std::size_t k = 0; k < t.size(); ++k) slopes.push_back(slope_at(t, y, k));
  auto times = t, values = y;
  return boost::math::interpolators::cubic_hermite(std::move(times), std::move(values),
                                                   std::move(slopes))(at);
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
