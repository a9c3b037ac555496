#include "view/see_through.hpp"

#include <algorithm>
#include <cmath>

namespace chute::view {
namespace {

using Eigen::Vector3f;

constexpr int tile_columns = Tile::width / samples, tile_rows = Tile::height / samples;
/// What lies behind layers that let less than this through is not looked at: a quarter of a step of 255.
constexpr float least = 1e-3f;

double place(int pixel, std::size_t sample) { return pixel + (static_cast<double>(sample) + 0.5) / samples; }
double sample_x(int x, std::size_t k) { return place(x, k % samples); }
double sample_y(int y, std::size_t k) { return place(y, k / samples); }

}  // namespace

SeeThrough::SeenPane::SeenPane(const Pane& pane, const Eye& eye)
    : color(Eigen::Vector3d(pane.color.r, pane.color.g, pane.color.b).cast<float>()),
      alpha(static_cast<float>(pane.alpha)) {
  std::array<Eigen::Vector3d, 3> first;
  for (std::size_t i = 0; i < pane.corners.size(); ++i) {
    corners.push_back(eye.seen(pane.corners[i]));
    if (i < first.size()) first[i] = eye.coordinates(pane.corners[i]);
  }
  normal = (first[1] - first[0]).cross(first[2] - first[0]);
  offset = normal.dot(first[0]);
}

float SeeThrough::SeenPane::at(const Eye& eye, double x, double y) const {
  bool left = true, right = true;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d a = corners[i], b = corners[(i + 1) % corners.size()];
    const double side = (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
    left = left && side <= 0, right = right && side >= 0;
  }
  const double slant = normal.dot(sight(eye, x, y));
  if ((!left && !right) || slant == 0) return far;
  return static_cast<float>(offset / slant - eye.distance);
}

SeeThrough::SeeThrough(const SolidContent& content, const std::vector<SeenBall>& balls,
                       const Shading& shading, const Eye& eye)
    : content_(content), balls_(balls), shading_(shading), eye_(eye) {
  has_glass_ = std::ranges::any_of(content.balls, &Ball::is_glass);
  for (const Pane& pane : content.panes)
    if (pane.corners.size() >= 3) panes_.emplace_back(pane, eye);
  if (has_glass_) near_.resize(std::size_t{tile_columns} * tile_rows);
}

void SeeThrough::start(int left, int top) {
  left_ = left, top_ = top;
  for (auto& balls : near_) balls.clear();
}

void SeeThrough::add(std::uint32_t ball) {
  const auto& box = balls_[ball].box;
  const int right = std::min(tile_columns, (box[2] - 1) / samples - left_ + 1),
            bottom = std::min(tile_rows, (box[3] - 1) / samples - top_ + 1);
  for (int y = std::max(0, box[1] / samples - top_); y < bottom; ++y)
    for (int x = std::max(0, box[0] / samples - left_); x < right; ++x)
      near_[static_cast<std::size_t>(y * tile_columns + x)].push_back(ball);
}

void SeeThrough::find_layers(int x, int y) {
  layers_.clear();
  const auto add = [&](std::uint32_t ball, float alpha, const Vector3f& color, auto&& depth_at) {
    Layer layer{{}, alpha, ball, true, ball == Tile::nothing, color};
    std::size_t hits = 0;
    for (std::size_t k = 0; k < samples_of_pixel; ++k) {
      layer.depths[k] = depth_at(sample_x(x, k), sample_y(y, k));
      hits += layer.depths[k] < far;
    }
    layer.whole = hits == samples_of_pixel;
    if (hits > 0) layers_.push_back(layer);
  };
  for (const auto& pane : panes_)
    add(Tile::nothing, pane.alpha, pane.color, [&](double sx, double sy) { return pane.at(eye_, sx, sy); });
  if (!has_glass_) return;
  for (const auto ball : near_[static_cast<std::size_t>((y - top_) * tile_columns + x - left_)])
    add(ball, static_cast<float>(content_.balls[ball].opacity), Vector3f::Zero(), [&](double sx, double sy) {
      const auto depth = depth_at(balls_[ball], eye_, sx, sy);
      return depth ? static_cast<float>(*depth) : far;
    });
}

Vector3f SeeThrough::color_of(Layer& layer, int x, int y, std::size_t sample) const {
  if (!layer.whole && layer.ball != Tile::nothing)
    return shading_.at(layer.ball, sample_x(x, sample), sample_y(y, sample)).color;
  if (!layer.has_color) layer.color = shading_.at(layer.ball, x + 0.5, y + 0.5).color;
  layer.has_color = true;
  return layer.color;
}

Veil SeeThrough::at(int x, int y, const std::array<float, samples_of_pixel>& solid) {
  Veil veil;
  find_layers(x, y);
  for (std::size_t k = 0; k < samples_of_pixel; ++k) {
    order_.clear(), bodies_.clear();
    for (std::uint32_t i = 0; i < layers_.size(); ++i)
      if (layers_[i].depths[k] < solid[k]) order_.push_back(i);
    std::ranges::stable_sort(order_, {}, [&](std::uint32_t i) { return layers_[i].depths[k]; });
    float through = 1;
    Vector3f color = Vector3f::Zero();
    for (const auto i : order_) {
      auto& layer = layers_[i];
      if (layer.ball != Tile::nothing) {  // of a grain of several balls the first one that is met
        const auto body = content_.balls[layer.ball].body;
        if (std::ranges::find(bodies_, body) != bodies_.end()) continue;
        if (body != Ball::alone) bodies_.push_back(body);
      }
      color += through * layer.alpha * color_of(layer, x, y, k);
      through *= 1 - layer.alpha;
      if (through < least) break;
    }
    veil.through[k] = through;
    veil.color += Eigen::Vector4f(color.x(), color.y(), color.z(), 1 - through) / float{samples_of_pixel};
  }
  return veil;
}

}  // namespace chute::view
