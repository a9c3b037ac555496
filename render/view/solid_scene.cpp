#include "view/solid_scene.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "view/floor_shadow.hpp"
#include "view/occlusion.hpp"
#include "view/see_through.hpp"
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
        glass_bins_(width, height),
        colors_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), Vector4f::Zero()) {
    balls_.reserve(content.balls.size());
    for (const Ball& ball : content.balls) balls_.emplace_back(ball, eye, width, height);
    for (const Rod& rod : content.rods) rods_.emplace_back(rod, eye, width, height);
    auto order = in_view(balls_);
    const auto glass = std::stable_partition(order.begin(), order.end(),
                                             [&](std::uint32_t i) { return !content.balls[i].is_glass(); });
    glass_bins_.fill(balls_, {glass, order.end()});
    order.erase(glass, order.end());
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return balls_[a].nearest != balls_[b].nearest ? balls_[a].nearest < balls_[b].nearest : a < b;
    });
    ball_bins_.fill(balls_, order);
    rod_bins_.fill(rods_, in_view(rods_));
    if (look.occlusion > 0) surfaces_.emplace(width, height);
  }

  void draw(bool all) {
    const Shading shading(content_, balls_, rods_, eye_, look_);
    SeeThrough before(content_, balls_, shading, eye_);
    if (!before.is_empty()) before_.assign(colors_.size(), Vector4f::Zero());
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
        const int left = column * Tile::width / samples, top = row * Tile::height / samples;
        before.start(left, top);
        for (auto k = glass_bins_.first[number]; k < glass_bins_.first[number + 1]; ++k)
          before.add(glass_bins_.names[k]);
        shade(*tile, shading, before, left, top);
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
        Vector4f color = colors_[i];
        if (!light.empty()) color.head<3>() *= light[i];
        if (!before_.empty()) color += before_[i];
        if (shadow && color.w() < 1) {
          const float dark = floor_darkness * shadow->at(x + 0.5, y + 0.5);
          below = (1 - dark) * below + Vector4f(0, 0, 0, dark);
        }
        color += (1 - color.w()) * below;
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
  Bins ball_bins_, rod_bins_, glass_bins_;
  std::vector<Vector4f>
      colors_;  ///< of what is solid, as much as glass before it lets through; alpha multiplied in
  std::vector<Vector4f> before_;  ///< of that glass, and of panes
  std::optional<Surfaces> surfaces_;

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  /// The pixels of a tile whose first is (left, top).
  void shade(const Tile& tile, const Shading& shading, SeeThrough& before, int left, int top) {
    const int right = std::min(width_, left + Tile::width / samples),
              bottom = std::min(height_, top + Tile::height / samples);
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x) {
        std::array<std::uint32_t, samples_of_pixel> names;
        std::array<float, samples_of_pixel> depths;
        for (std::size_t k = 0; k < samples_of_pixel; ++k) {
          const int sample = static_cast<int>(k);
          const int sx = samples * (x - left) + sample % samples, sy = samples * (y - top) + sample / samples;
          names[k] = tile.name(sx, sy), depths[k] = tile.depth(sx, sy);
        }
        std::array<float, samples_of_pixel> through;
        through.fill(1);
        if (!before_.empty()) {
          const Veil veil = before.at(x, y, depths);
          before_[index(x, y)] = veil.color, through = veil.through;
        }
        shade_pixel(names, through, shading, x, y);
      }
  }

  /// `through`: the share of what is solid that is seen at each sample.
  void shade_pixel(const std::array<std::uint32_t, samples_of_pixel>& names,
                   const std::array<float, samples_of_pixel>& through, const Shading& shading, int x, int y) {
    const std::size_t i = index(x, y);
    const auto keep = [&](const Shaded& s, float share) {
      colors_[i] += share * Vector4f(s.color.x(), s.color.y(), s.color.z(), 1);
      if (surfaces_ && s.depth < surfaces_->depths[i])
        surfaces_->depths[i] = s.depth, surfaces_->normals[i] = s.normal;
    };
    constexpr float one = 1.f / samples_of_pixel;  // a power of two: shares of 1 add up to 1
    if (std::all_of(names.begin(), names.end(), [&](auto name) { return name == names[0]; })) {
      if (names[0] == Tile::nothing) return;
      return keep(shading.at(names[0], x + 0.5, y + 0.5),
                  one * std::accumulate(through.begin(), through.end(), 0.f));
    }
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (names[k] == Tile::nothing) continue;
      const double sx = (static_cast<double>(k % samples) + 0.5) / samples,
                   sy = (std::floor(static_cast<double>(k) / samples) + 0.5) / samples;
      keep(shading.at(names[k], x + sx, y + sy), one * through[k]);
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
