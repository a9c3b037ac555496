#include "view/flat_scene.hpp"

#include <algorithm>
#include <cmath>

namespace chute::view {
namespace {

/// One corner: pixel place (y up) and what flat::attributes has for it.
void add_corner(flat::Corners& corners, double x, double y, float z, const float (&place)[2],
                const float (&shape)[4], const float (&paint)[4], const float (&extra)[4],
                const float (&mark)[4]) {
  auto& [at, shapes, paints, extras, marks] = corners.values;
  corners.places.insert(corners.places.end(), {static_cast<float>(x), static_cast<float>(y), z});
  at.insert(at.end(), place, place + 2);
  shapes.insert(shapes.end(), shape, shape + 4);
  paints.insert(paints.end(), paint, paint + 4);
  extras.insert(extras.end(), extra, extra + 4);
  marks.insert(marks.end(), mark, mark + 4);
}

}  // namespace

/// Shapes that are not in the picture are left out: one that is far away would spoil the precision of all,
/// for VTK scales coordinates by their bounds.
bool FlatScene::shows(double left, double right, double low, double high) const {
  return right > 0 && left < width_ && high > 0 && low < height_;
}

/// How near the next shape is: each a little nearer than the one before, for the depth test. One step is
/// about ten of the depth buffer's, and half a million shapes fit before the eye.
float FlatScene::height_of_next() const {
  return 1e-5f * static_cast<float>(std::min<std::size_t>(corners_.count() / 4, 800'000));
}

FlatScene::FlatScene(int width, int height, Rgb ground, double ground_alpha)
    : surface_(flat::make_surface(
          width, height,
          {ground.r * ground_alpha, ground.g * ground_alpha, ground.b * ground_alpha, ground_alpha})),
      width_(width),
      height_(height),
      ground_(ground),
      ground_alpha_(ground_alpha) {
  clip({0, 0, static_cast<double>(width), static_cast<double>(height)});
}

void FlatScene::clip(const plot::Rect& rect) {
  clip_ = rect;
  surface_->clip({static_cast<float>(rect.left), static_cast<float>(height_ - rect.bottom),
                  static_cast<float>(rect.right), static_cast<float>(height_ - rect.top)});
}

void FlatScene::clear() {
  corners_.clear();
  remembered_.clear();
}

void FlatScene::add(const Disc& disc) {
  const auto f = [](double x) { return static_cast<float>(x); };
  const double x = disc.centre.x(), y = height_ - disc.centre.y(), reach = disc.radius + 1;
  if (!shows(x - reach, x + reach, y - reach, y + reach)) return;
  if (remembers_) remembered_.emplace_back(disc);
  const float shape[4] = {f(disc.radius), f(disc.edge_width), f(disc.mark.x()), f(-disc.mark.y())};
  const float paint[4] = {f(disc.fill.r), f(disc.fill.g), f(disc.fill.b), f(disc.alpha)};
  const float extra[4] = {f(disc.edge.r), f(disc.edge.g), f(disc.edge.b), f(disc.mark_radius)};
  const float mark[4] = {f(disc.mark_color.r), f(disc.mark_color.g), f(disc.mark_color.b), 1};
  const float z = height_of_next();
  for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    add_corner(corners_, x + u * reach, y + v * reach, z, {f(u * reach), f(v * reach)}, shape, paint, extra,
               mark);
}

void FlatScene::add(const Bar& bar) {
  const auto f = [](double x) { return static_cast<float>(x); };
  const plot::Point a{bar.from.x(), height_ - bar.from.y()}, b{bar.to.x(), height_ - bar.to.y()};
  const double length = (b - a).norm();
  if (!(length > 0)) return;
  const plot::Point u = (b - a) / length, n = u.unitOrthogonal();
  const double reach = std::max(bar.width_from, bar.width_to) / 2 + 1.5;
  if (!shows(std::min(a.x(), b.x()) - reach, std::max(a.x(), b.x()) + reach, std::min(a.y(), b.y()) - reach,
             std::max(a.y(), b.y()) + reach))
    return;
  if (remembers_) remembered_.emplace_back(bar);
  const float shape[4] = {f(length), f(bar.width_from / 2), f(bar.width_to / 2), -1};
  const float none[4] = {0, 0, 0, 0};
  const float z = height_of_next();
  for (const auto& [end, side] : {std::pair{0, -1}, {1, -1}, {1, 1}, {0, 1}}) {
    const double along = end ? length + 1 : -1, across = side * reach;
    const float paint[4] = {f(bar.color.r), f(bar.color.g), f(bar.color.b),
                            f(end ? bar.alpha_to : bar.alpha_from)};
    add_corner(corners_, a.x() + along * u.x() + across * n.x(), a.y() + along * u.y() + across * n.y(), z,
               {f(along), f(across)}, shape, paint, none, none);
  }
}

namespace {

plot::Color color_of(Rgb c, double alpha) { return {c.r, c.g, c.b, alpha}; }

/// The rim lies around the filled inside, not over it, so that both have the disc's alpha.
void add_curves(plot::DisplayList& list, const Disc& disc) {
  const double rim = std::min(disc.edge_width, disc.radius);
  list.fill(plot::Path().circle(disc.centre, disc.radius - rim), color_of(disc.fill, disc.alpha));
  if (disc.mark_radius > 0)
    list.fill(plot::Path().circle(disc.centre + disc.mark, disc.mark_radius),
              color_of(disc.mark_color, disc.alpha));
  if (rim > 0)
    list.stroke(plot::Path().circle(disc.centre, disc.radius - rim / 2),
                {rim, {}, plot::Cap::butt, plot::Join::round}, color_of(disc.edge, disc.alpha));
}

/// A bar that fades is so many pieces of one alpha each.
void add_curves(plot::DisplayList& list, const Bar& bar) {
  const int pieces = bar.alpha_from == bar.alpha_to ? 1 : 6;
  const plot::Point way = bar.to - bar.from;
  const plot::Point across = way.norm() > 0 ? way.unitOrthogonal() : plot::Point{0, 0};
  for (int k = 0; k < pieces; ++k) {
    const double t0 = static_cast<double>(k) / pieces, t1 = static_cast<double>(k + 1) / pieces;
    const auto corner = [&](double t, double side) -> plot::Point {
      return bar.from + t * way + side / 2 * (bar.width_from + t * (bar.width_to - bar.width_from)) * across;
    };
    list.fill(plot::Path()
                  .move(corner(t0, 1))
                  .line(corner(t1, 1))
                  .line(corner(t1, -1))
                  .line(corner(t0, -1))
                  .close(),
              color_of(bar.color, bar.alpha_from + (t0 + t1) / 2 * (bar.alpha_to - bar.alpha_from)));
  }
}

}  // namespace

plot::DisplayList FlatScene::page() const {
  plot::DisplayList list;
  list.width = width_, list.height = height_;
  list.background = color_of(ground_, ground_alpha_);
  list.items.emplace_back(plot::ClipBegin{clip_});
  for (const auto& shape : remembered_) std::visit([&](const auto& one) { add_curves(list, one); }, shape);
  list.items.emplace_back(plot::ClipEnd{});
  return list;
}

void FlatScene::draw(image::Image& into) { surface_->draw(corners_, into); }

}  // namespace chute::view
