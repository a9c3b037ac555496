#include "view/floor_shadow.hpp"

#include <algorithm>
#include <cmath>

#include "view/solid_tile.hpp"

namespace chute::view {
namespace {

constexpr int cells_per_radius = 3, most_cells = 1024;  // along each side: 4 MiB
/// Where the shadow falls: the key lamp's direction (right, up, towards the eye), lifted so that shadows stay short.
const Eigen::Vector3d lamp(-0.55, 0.9, 1);
constexpr double lift = 1.2;

/// Averages over 2 half + 1 cells along one axis, with a running sum.
void blur(std::vector<float>& cells, int size, int half, std::ptrdiff_t along, std::ptrdiff_t across) {
  std::vector<float> line(static_cast<std::size_t>(size));
  for (int row = 0; row < size; ++row) {
    float* const first = cells.data() + row * across;
    for (int i = 0; i < size; ++i) line[static_cast<std::size_t>(i)] = first[i * along];
    const auto get = [&](int i) { return i >= 0 && i < size ? line[static_cast<std::size_t>(i)] : 0.f; };
    float sum = 0;
    for (int i = -half; i < half; ++i) sum += get(i);
    for (int i = 0; i < size; ++i) {
      sum += get(i + half);
      first[i * along] = sum / static_cast<float>(2 * half + 1);
      sum -= get(i - half);
    }
  }
}

}  // namespace

FloorShadow::FloorShadow(const Floor& floor, const std::vector<Ball>& balls, const Eye& eye)
    : floor_(floor), eye_(eye), u_(floor.normal.unitOrthogonal()), v_(floor.normal.cross(u_)) {
  double radii = 0, count = 0;
  for (const Ball& ball : balls)
    if (ball.has_shadow) radii += ball.radius, ++count;
  if (count == 0) return;
  const double radius = radii / count;
  if (!std::isfinite(radius) || !std::isfinite(floor.radius)) return;  // grains beyond what squares can be of
  cell_ = std::max(radius / cells_per_radius, 2 * floor.radius / most_cells);
  size_ = static_cast<int>(std::ceil(2 * floor.radius / cell_));
  dark_.assign(static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_), 0);
  const Eigen::Vector3d light = (eye.axes.transpose() * lamp).normalized() + lift * floor.normal;
  Eigen::Vector3d fall = light / light.dot(floor.normal);  // upwards by 1
  const Eigen::Vector3d aside = fall - floor.normal;
  if (aside.norm() > floor.reach) fall = floor.normal + floor.reach * aside.normalized();
  for (const Ball& ball : balls) {
    if (!ball.has_shadow) continue;
    const Eigen::Vector3d p = ball.centre - floor.centre;
    const Eigen::Vector3d at = p - p.dot(floor.normal) * fall;
    const double x = at.dot(u_) / cell_ + size_ / 2.0, y = at.dot(v_) / cell_ + size_ / 2.0,
                 r = ball.radius / cell_;
    const auto cell = [&](double c) { return std::clamp(static_cast<int>(std::floor(c)), 0, size_ - 1); };
    const int first = cell(x - r), last = cell(x + r);
    for (int j = cell(y - r); j <= cell(y + r); ++j) {
      const double dy = j + 0.5 - y, left = r * r - dy * dy;
      for (int i = first; i <= last; ++i) {
        const double dx = i + 0.5 - x;
        if (dx * dx < left) {
          float& dark = dark_[static_cast<std::size_t>(j * size_ + i)];
          dark += static_cast<float>(ball.opacity) * (1 - dark);  // glass lets light through
        }
      }
    }
  }
  const int half = std::max(1, static_cast<int>(std::lround(radius / cell_)));
  for (int pass = 0; pass < 2; ++pass) blur(dark_, size_, half, 1, size_), blur(dark_, size_, half, size_, 1);
}

float FloorShadow::at(double x, double y) const {
  // an orthogonal turn keeps products: all in the eye's coordinates
  const Eigen::Vector3d d = eye_.axes.transpose() * sight(eye_, x, y).cwiseProduct(Eigen::Vector3d(1, 1, -1));
  const Eigen::Vector3d start = eye_.centre + eye_.distance * eye_.towards();
  const double sinks = d.dot(floor_.normal);
  if (size_ == 0 || sinks >= 0) return 0;  // above the horizon, or seen from below
  const Eigen::Vector3d p = start - (start - floor_.centre).dot(floor_.normal) / sinks * d - floor_.centre;
  const double i = p.dot(u_) / cell_ + size_ / 2.0 - 0.5, j = p.dot(v_) / cell_ + size_ / 2.0 - 0.5;
  if (i < 0 || j < 0 || i >= size_ - 1 || j >= size_ - 1) return 0;
  const auto ci = static_cast<std::size_t>(i), cj = static_cast<std::size_t>(j),
             size = static_cast<std::size_t>(size_);
  const auto fi = static_cast<float>(i - static_cast<double>(ci)),
             fj = static_cast<float>(j - static_cast<double>(cj));
  const float* row = &dark_[cj * size + ci];
  return (1 - fj) * ((1 - fi) * row[0] + fi * row[1]) + fj * ((1 - fi) * row[size] + fi * row[size + 1]);
}

}  // namespace chute::view
