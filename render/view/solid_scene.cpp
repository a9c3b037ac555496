#include "view/solid_scene.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "view/floor_shadow.hpp"
#include "view/occlusion.hpp"
#include "view/solid_shading.hpp"
#include "view/solid_tile.hpp"

namespace chute::view {
namespace {

using Eigen::Vector3f, Eigen::Vector4f;

constexpr float floor_darkness = 0.42f;  // of a full shadow

/// A thing's number in each tile that it may be seen in: those of tile t are names[first[t]] … names[first[t + 1]].
struct Bins {
  int columns, rows;
  std::vector<std::uint32_t> first, names;

  Bins(int width, int height)
      : columns((samples * width + Tile::width - 1) / Tile::width),
        rows((samples * height + Tile::height - 1) / Tile::height) {}

  /// Calls with every tile that the box of samples touches.
  template <class Use>
  void each(const std::array<int, 4>& box, Use&& use) const {
    for (int row = box[1] / Tile::height; row <= (box[3] - 1) / Tile::height; ++row)
      for (int column = box[0] / Tile::width; column <= (box[2] - 1) / Tile::width; ++column)
        use(static_cast<std::size_t>(row * columns + column));
  }

  /// `order`: numbers of the things that are in view.
  template <class Thing>
  void fill(const std::vector<Thing>& things, const std::vector<std::uint32_t>& order) {
    first.assign(static_cast<std::size_t>(columns * rows) + 1, 0);
    for (const auto i : order) each(things[i].box, [&](std::size_t tile) { ++first[tile + 1]; });
    std::partial_sum(first.begin(), first.end(), first.begin());
    names.resize(first.back());
    auto next = first;
    for (const auto i : order) each(things[i].box, [&](std::size_t tile) { names[next[tile]++] = i; });
  }
};

template <class Thing>
std::vector<std::uint32_t> in_view(const std::vector<Thing>& things) {
  std::vector<std::uint32_t> order;
  for (std::size_t i = 0; i < things.size(); ++i)
    if (things[i].is_in_view()) order.push_back(static_cast<std::uint32_t>(i));
  return order;
}

/// A pane as the eye has it.
struct SeenPane {
  std::vector<Eigen::Vector2d> corners;  ///< pixels, y down
  Eigen::Vector3d normal;                ///< right, up, depth; inside the pane, normal . place = offset
  double offset, depth;
  Vector3f color;
  float alpha;

  /// Depth beyond that of the eye's centre where the line of sight meets it, infinite where it does not.
  float at(const Eye& eye, double x, double y) const {
    constexpr float far = std::numeric_limits<float>::infinity();
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
};

std::uint8_t byte(float x) { return static_cast<std::uint8_t>(std::clamp(255 * x + 0.5f, 0.f, 255.f)); }

/// One picture while it is drawn.
class Drawing {
 public:
  Drawing(const SolidContent& content, const Eye& eye, const SolidLook& look, int width, int height)
      : content_(content),
        eye_(eye),
        look_(look),
        width_(width),
        height_(height),
        ball_bins_(width, height),
        rod_bins_(width, height),
        colors_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), Vector4f::Zero()) {
    balls_.reserve(content.balls.size());
    for (const Ball& ball : content.balls) balls_.emplace_back(ball, eye, width, height);
    for (const Rod& rod : content.rods) rods_.emplace_back(rod, eye, width, height);
    auto order = in_view(balls_);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return balls_[a].nearest != balls_[b].nearest ? balls_[a].nearest < balls_[b].nearest : a < b;
    });
    ball_bins_.fill(balls_, order);
    rod_bins_.fill(rods_, in_view(rods_));
    if (look.occlusion > 0) surfaces_.emplace(width, height);
    if (!content.panes.empty()) see_panes();
  }

  void draw(bool all) {
    const Shading shading(content_, balls_, rods_, eye_, look_);
    const auto tile = std::make_unique<Tile>(eye_);
    for (int row = 0; row < ball_bins_.rows; ++row)
      for (int column = 0; column < ball_bins_.columns; ++column) {
        const auto number = static_cast<std::size_t>(row * ball_bins_.columns + column);
        tile->start(column * Tile::width, row * Tile::height);
        for (auto k = ball_bins_.first[number]; k < ball_bins_.first[number + 1]; ++k) {
          const auto name = ball_bins_.names[k];
          if (!all && tile->is_full(balls_[name].nearest)) break;  // those that follow are farther
          tile->add(balls_[name], name, all);
        }
        for (auto k = rod_bins_.first[number]; k < rod_bins_.first[number + 1]; ++k)
          tile->add(rods_[rod_bins_.names[k]],
                    static_cast<std::uint32_t>(balls_.size()) + rod_bins_.names[k]);
        shade(*tile, shading, column * Tile::width / samples, row * Tile::height / samples);
      }
  }

  void finish(image::Image& into) const {
    if (into.width != width_ || into.height != height_) into = image::Image(width_, height_);
    std::vector<float> light;
    if (surfaces_) {
      constexpr double reach = 2.2;  // radii: across a gap between grains, to the next grain's far side
      light = ambient_light(*surfaces_, eye_, reach * look_.occlusion);
    }
    std::optional<FloorShadow> shadow;
    if (content_.floor) shadow.emplace(*content_.floor, content_.balls, eye_);
    const auto alpha = static_cast<float>(look_.ground_alpha);
    const Vector4f ground{static_cast<float>(look_.ground.r) * alpha,
                          static_cast<float>(look_.ground.g) * alpha,
                          static_cast<float>(look_.ground.b) * alpha, alpha};
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        const std::size_t i = index(x, y);
        Vector4f below = ground;
        if (shadow && colors_[i].w() < 1) {
          const float dark = floor_darkness * shadow->at(x + 0.5, y + 0.5);
          below = (1 - dark) * below + Vector4f(0, 0, 0, dark);
        }
        Vector4f color = colors_[i];
        if (!light.empty()) color.head<3>() *= light[i];
        color += (1 - color.w()) * below;
        if (!before_.empty()) color = before_[i] + (1 - before_[i].w()) * color;
        std::uint8_t* to = into.pixel(x, y);
        for (int c = 0; c < 4; ++c) to[c] = byte(color[c]);
      }
  }

 private:
  const SolidContent& content_;
  const Eye& eye_;
  const SolidLook& look_;
  int width_, height_;
  std::vector<SeenBall> balls_;
  std::vector<SeenRod> rods_;
  std::vector<SeenPane> panes_;  ///< the farthest first
  Bins ball_bins_, rod_bins_;
  std::vector<Vector4f> colors_;  ///< of balls and rods; alpha multiplied in
  std::vector<Vector4f> before_;  ///< of panes, which cover the rest
  std::optional<Surfaces> surfaces_;

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  void see_panes() {
    before_.assign(colors_.size(), Vector4f::Zero());
    for (const Pane& pane : content_.panes) {
      if (pane.corners.size() < 3) continue;
      SeenPane seen;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      std::vector<Eigen::Vector3d> places;
      for (const auto& corner : pane.corners) {
        seen.corners.push_back(eye_.seen(corner));
        places.push_back(eye_.coordinates(corner));
        sum += places.back();
      }
      seen.normal = (places[1] - places[0]).cross(places[2] - places[0]);
      seen.offset = seen.normal.dot(places[0]), seen.depth = sum.z() / static_cast<double>(places.size());
      seen.color = Eigen::Vector3d(pane.color.r, pane.color.g, pane.color.b).cast<float>();
      seen.alpha = static_cast<float>(pane.alpha);
      panes_.push_back(std::move(seen));
    }
    std::stable_sort(panes_.begin(), panes_.end(),
                     [](const SeenPane& a, const SeenPane& b) { return a.depth > b.depth; });
  }

  /// The pixels of a tile whose first is (left, top).
  void shade(const Tile& tile, const Shading& shading, int left, int top) {
    const int right = std::min(width_, left + Tile::width / samples),
              bottom = std::min(height_, top + Tile::height / samples);
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x) {
        std::array<std::uint32_t, samples * samples> names;
        std::array<float, samples * samples> depths;
        for (int k = 0; k < samples * samples; ++k) {
          const int sx = samples * (x - left) + k % samples, sy = samples * (y - top) + k / samples;
          names[static_cast<std::size_t>(k)] = tile.name(sx, sy);
          depths[static_cast<std::size_t>(k)] = tile.depth(sx, sy);
        }
        shade_pixel(names, shading, x, y);
        if (!panes_.empty()) cover_pixel(depths, x, y);
      }
  }

  void shade_pixel(const std::array<std::uint32_t, samples * samples>& names, const Shading& shading, int x,
                   int y) {
    const std::size_t i = index(x, y);
    const auto keep = [&](const Shaded& s) {
      if (surfaces_ && s.depth < surfaces_->depths[i])
        surfaces_->depths[i] = s.depth, surfaces_->normals[i] = s.normal;
    };
    if (std::all_of(names.begin(), names.end(), [&](auto name) { return name == names[0]; })) {
      if (names[0] == Tile::nothing) return;
      const auto s = shading.at(names[0], x + 0.5, y + 0.5);
      colors_[i] = Vector4f(s.color.x(), s.color.y(), s.color.z(), 1);
      return keep(s);
    }
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (names[k] == Tile::nothing) continue;
      const double sx = (static_cast<double>(k % samples) + 0.5) / samples,
                   sy = (static_cast<double>(k / samples) + 0.5) / samples;
      const auto s = shading.at(names[k], x + sx, y + sy);
      colors_[i] += Vector4f(s.color.x(), s.color.y(), s.color.z(), 1) / static_cast<float>(names.size());
      keep(s);
    }
  }

  void cover_pixel(const std::array<float, samples * samples>& depths, int x, int y) {
    for (const SeenPane& pane : panes_) {
      float seen = 0;
      for (std::size_t k = 0; k < depths.size(); ++k)
        if (pane.at(eye_, x + (static_cast<double>(k % samples) + 0.5) / samples,
                    y + (static_cast<double>(k / samples) + 0.5) / samples) < depths[k])
          seen += 1.f / static_cast<float>(depths.size());
      if (seen == 0) continue;
      const float alpha = seen * pane.alpha;
      auto& below = before_[index(x, y)];
      below = (1 - alpha) * below + alpha * Vector4f(pane.color.x(), pane.color.y(), pane.color.z(), 1);
    }
  }
};

}  // namespace

void SolidScene::draw(const SolidContent& content, image::Image& into, bool all) const {
  Drawing drawing(content, eye_, look_, width_, height_);
  drawing.draw(all);
  drawing.finish(into);
}

}  // namespace chute::view
