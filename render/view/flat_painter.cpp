#include <algorithm>
#include <cmath>

#include "common/fields.hpp"
#include "view/flat_scene.hpp"
#include "view/furniture.hpp"
#include "view/painter.hpp"

namespace chute::view {
namespace {

using plot::Point;
using plot::Rect;

constexpr double copy_alpha = 0.5;
constexpr double edge_shade = 0.55;    ///< how much darker the rim of a grain is, 1: black
constexpr double impact_share = 0.09;  ///< radius of a mark where a grain was hit, in mean diameters

/// From the files' plane to pixels: turned if the picture is tilted, then scaled.
struct Map {
  Eigen::Rotation2Dd turn{0};
  Point origin{0, 0};  ///< lower left corner of what is seen, in the turned plane
  double scale = 1;
  Rect rect;

  Point turned(double x, double y) const { return turn * Point(x, y); }
  Point operator()(double x, double y) const {
    const Point t = scale * (turned(x, y) - origin);
    return {rect.left + t.x(), rect.bottom - t.y()};
  }
  Point operator()(const Eigen::Vector3d& place) const { return (*this)(place.x(), place.y()); }
  Point direction(double x, double y) const {
    const Point t = turned(x, y);
    return {t.x(), -t.y()};
  }
};

class FlatPainter : public Painter {
 public:
  FlatPainter(const Studio& studio, std::unique_ptr<Furniture>& furniture)
      : studio_(studio),
        scene_(studio.style.width, studio.style.height, studio.palette.ground, studio.palette.ground_alpha) {
    const auto& survey = studio_.survey;
    map_.turn = Eigen::Rotation2Dd(survey.turn);
    const auto window = seen(studio_.style.camera);
    const Point size = window.sizes();
    // while the camera moves, everything else stands where it stands at its first place
    const auto& keys = studio_.style.camera_keys;
    const Point shape = keys.empty() ? size : seen(keys.front().camera).sizes();
    furniture = std::make_unique<Furniture>(studio_, shape.x() / shape.y());
    map_.rect = furniture->places().scene;
    map_.scale = std::min(map_.rect.width() / size.x(), map_.rect.height() / size.y());
    map_.origin = window.center() - plot::Point(map_.rect.width(), map_.rect.height()) / (2 * map_.scale);
    // arrows may reach a little beyond what was fitted
    scene_.clip(studio_.style.camera.window
                    ? map_.rect
                    : map_.rect.grown(survey.cropped ? 1 : 1.3 * furniture->places().em));
    Directions directions;
    const auto& g = survey.gravity;
    if (const double strength = g.head<2>().norm(); strength > 0)
      directions.gravity = map_.direction(g[0] / strength, g[1] / strength);
    directions.normal = map_.direction(0, -1);
    furniture->stand(furniture->flat_scale(map_.scale), directions, studio_.arrow_length() * map_.scale,
                     studio_.widest_chain() * map_.scale);
  }

  void paint(const FrameData& data, image::Image& into) override {
    add_all(data);
    scene_.draw(into);
  }

  plot::DisplayList page(const FrameData& data) override {
    scene_.remember();
    add_all(data);
    return scene_.page();
  }

 private:
  void add_all(const FrameData& data) {
    scene_.clear();
    const auto colors = studio_.colors(data.frame);
    for (const auto& wall : data.walls) add_wall(wall);
    if (studio_.style.trail) add_trails(data, colors);
    if (copies()) add_borders();
    for (const bool bed : {true, false})
      for (std::size_t i = 0, next = 0; i < data.frame.size(); i = next) {
        next = end_of_body(data.frame, i);
        if (studio_.is_bed(data.frame, i) != bed || studio_.is_cut(data.frame.centre(i))) continue;
        if (next - i > 1)
          add_body(data.frame, i, next, colors[i]);
        else
          add_grain(data.frame, i, colors[i]);
      }
    if (studio_.style.impacts) add_impacts(data.impacts);
    if (studio_.style.chains) add_chains(data.links);
    if (studio_.style.arrows) add_arrows(data.frame);
  }

  Studio studio_;
  FlatScene scene_;
  Map map_;

  double period() const { return studio_.survey.domain.sizes().x(); }
  bool copies() const { return studio_.style.copies && period() > 0; }

  /// What the picture shows of the turned plane.
  Eigen::AlignedBox2d seen(const Camera& camera) const {
    if (!camera.window && !camera.follow) return studio_.survey.turned;
    const auto& bounds = studio_.survey.bounds;
    const auto window = camera.window.value_or(
        std::array{bounds.min().x(), bounds.max().x(), bounds.min().y(), bounds.max().y()});
    Eigen::AlignedBox2d box;
    for (const double x : {window[0], window[1]})
      for (const double y : {window[2], window[3]}) box.extend(map_.turned(x, y));
    return box;
  }

  void add_grain(const read::GrainFrame& frame, std::size_t i, Rgb color) {
    const auto& style = studio_.style;
    const double own = studio_.is_bed(frame, i) ? 1 : style.opacity;
    add_disc(frame, i, color, 0, own);
    if (!copies()) return;
    for (const double shift : copy_shifts(style, period())) {
      const double beyond = beyond_domain(studio_.survey.domain, frame.x[i] + shift, style.copy_reach);
      if (beyond < 1) add_disc(frame, i, color, shift, own * copy_alpha * std::min(1.0, 1.15 * (1 - beyond)));
    }
  }

  /// Discs [first, end) that are one grain, in one colour and with one rim around all: first all of them in the rim's colour,
  /// then their insides. What shines through is mixed with the ground instead, for the discs overlap.
  void add_body(const read::GrainFrame& frame, std::size_t first, std::size_t end, Rgb color) {
    const auto add = [&](double shift, double alpha) {
      const Rgb fill = mix(studio_.palette.ground, color, alpha);
      for (const bool inside : {false, true})
        for (std::size_t i = first; i < end; ++i) {
          Disc disc;
          disc.centre = map_(frame.x[i] + shift, frame.y[i]);
          disc.radius = frame.radius[i] * map_.scale;
          if (inside) disc.radius -= edge_width(disc.radius);
          disc.fill = disc.edge =
              inside ? fill : mix(studio_.palette.ground, mix(color, {0, 0, 0}, edge_shade), alpha);
          scene_.add(disc);
        }
    };
    add(0, studio_.style.opacity);
    if (!copies()) return;
    for (const double shift : copy_shifts(studio_.style, period())) {
      const double beyond =
          beyond_domain(studio_.survey.domain, frame.x[first] + shift, studio_.style.copy_reach);
      if (beyond < 1) add(shift, studio_.style.opacity * copy_alpha * std::min(1.0, 1.15 * (1 - beyond)));
    }
  }

  static double edge_width(double radius) { return std::clamp(0.055 * radius, 0.45, 2.0); }

  void add_disc(const read::GrainFrame& frame, std::size_t i, Rgb color, double shift, double alpha) {
    constexpr Rgb black{0, 0, 0}, white{1, 1, 1};
    const bool bed = studio_.is_bed(frame, i);
    Disc disc;
    disc.centre = map_(frame.x[i] + shift, frame.y[i]);
    disc.radius = frame.radius[i] * map_.scale;
    disc.fill = color;
    disc.edge = mix(disc.fill, black, bed ? 0.3 : edge_shade);
    disc.edge_width = edge_width(disc.radius);
    disc.alpha = alpha;
    const auto* angle = frame.find(fields::angle.name);
    if (studio_.style.spin && !studio_.style.arrows && angle && angle->components == 1 && !bed &&
        disc.radius > 3) {
      // a diameter: how far it turned between two frames is read off a line more surely than off a point
      const double turned = angle->at(i);
      const Point end = 0.86 * disc.radius * map_.direction(std::cos(turned), std::sin(turned));
      const Rgb ink = brightness(disc.fill) > 0.45 ? mix(disc.fill, black, 0.5) : mix(disc.fill, white, 0.62);
      const double width = std::max(0.9, 0.13 * disc.radius);
      scene_.add(disc);
      scene_.add(Bar{disc.centre - end, disc.centre + end, width, width, ink, alpha, alpha});
      return;
    }
    scene_.add(disc);
  }

  /// Where the periodic ends are.
  void add_borders() {
    const auto &box = studio_.survey.bounds, &domain = studio_.survey.domain;
    const double dash = 0.006 * studio_.style.width;
    for (const double x : {domain.min().x(), domain.max().x()}) {
      const Point from = map_(x, box.min().y()), to = map_(x, box.max().y()), along = to - from;
      const double length = along.norm();
      for (double at = 0; at + dash < length; at += 2 * dash)
        scene_.add(Bar{from + (at / length) * along, from + ((at + dash) / length) * along, 1, 1,
                       studio_.palette.quiet, 1, 1});
    }
  }

  void add_trails(const FrameData& data, const std::vector<Rgb>& colors) {
    const auto trail = trails(data);
    for (std::size_t i = 0; i < trail.paths.size(); ++i) {
      const auto& path = trail.paths[i];
      if (studio_.is_cut(data.frame.centre(i))) continue;
      const double width = std::clamp(0.16 * data.frame.radius[i] * map_.scale, 1.0, 4.0);
      const double steps = static_cast<double>(studio_.style.trail);
      for (std::size_t k = 0; k + 1 < path.size(); ++k)
        scene_.add(Bar{map_(path[k]), map_(path[k + 1]), width, width, colors[i],
                       0.75 * (1 - static_cast<double>(k) / steps),
                       0.75 * (1 - static_cast<double>(k + 1) / steps)});
    }
  }

  /// A wall in the plane is a line, or several.
  void add_wall(const read::WallPiece& wall) {
    const double width = std::max(1.5, 0.0016 * studio_.style.width);
    for (std::size_t i = 0; i + 1 < wall.corners.size(); ++i)
      scene_.add(Bar{map_(wall.corners[i]), map_(wall.corners[i + 1]), width, width, studio_.palette.quiet});
  }

  void add_impacts(std::span<const read::Impact> impacts) {
    Disc spot;
    spot.radius = std::clamp(impact_share * studio_.survey.diameter * map_.scale, 1.2, 6.0);
    spot.fill = spot.edge = studio_.palette.mark, spot.alpha = 0.8;
    for (const auto& impact : impacts) {
      spot.centre = map_(impact.place);
      if (!studio_.is_cut(impact.place)) scene_.add(spot);
    }
  }

  void add_chains(std::span<const read::ForceLink> links) {
    if (studio_.survey.force <= 0) return;
    const double widest = studio_.widest_chain() * map_.scale, L = period();
    for (const auto& link : links) {
      const double width = widest * std::min(strongest_link, link.force / studio_.survey.force);
      if (width < 0.25 || studio_.is_cut(link.from) || studio_.is_cut(link.to)) continue;
      const auto draw = [&](double shift) {
        const auto& a = link.from;
        double dx = link.to.x() - a.x();
        if (L > 0) dx -= L * std::round(dx / L);  // a contact through the periodic ends
        const Bar bar{map_(a.x() + shift, a.y()), map_(a.x() + shift + dx, link.to.y()), width, width,
                      studio_.chain_color(link.force)};
        scene_.add(bar);
        Disc joint;
        joint.radius = width / 2, joint.fill = joint.edge = bar.color;
        for (const Point& end : {bar.from, bar.to}) {
          joint.centre = end;
          if (width > 1) scene_.add(joint);
        }
        return a.x() + dx;
      };
      const double end = draw(0);
      if (L > 0 && end < studio_.survey.domain.min().x()) draw(L);
      if (L > 0 && end > studio_.survey.domain.max().x()) draw(-L);
    }
  }

  void add_arrows(const read::GrainFrame& frame) {
    const auto* velocity = frame.find(fields::velocity.name);
    if (!velocity || velocity->components != 3) return;
    const double unit = studio_.arrow_length() * map_.scale;
    const double width = std::clamp(0.075 * studio_.survey.diameter * map_.scale, 1.0, 4.0);
    for (const double casing : {1.0, 0.0})  // a thin light rim first, so that arrows show on dark discs
      for (std::size_t i = 0; i < frame.size(); ++i) {
        if (studio_.is_bed(frame, i) || studio_.is_cut(frame.centre(i))) continue;
        const Point along = unit * map_.direction(velocity->at(i, 0), velocity->at(i, 1));
        const double length = along.norm();
        if (length < 1.5 * width) continue;
        const Point u = (1 / length) * along, from = map_(frame.centre(i)), to = from + along;
        const double head = std::min(5 * width, 0.6 * length);
        const Rgb color = casing > 0 ? studio_.palette.ground : studio_.palette.ink;
        const double alpha = casing > 0 ? 0.55 : 1, rim = casing * std::max(0.8, 0.35 * width);
        const Point neck = to - head * u;
        scene_.add(
            Bar{from - rim * u, neck + 0.5 * u, width + 2 * rim, width + 2 * rim, color, alpha, alpha});
        scene_.add(Bar{neck - rim * u, to + 2 * rim * u, 0.75 * head + 3 * rim, 0, color, alpha, alpha});
      }
  }
};

}  // namespace

std::unique_ptr<Painter> make_flat_painter(const Studio& studio, std::unique_ptr<Furniture>& furniture) {
  return std::make_unique<FlatPainter>(studio, furniture);
}

}  // namespace chute::view
