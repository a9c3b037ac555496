#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "common/fields.hpp"
#include "view/furniture.hpp"
#include "view/lay_over.hpp"
#include "view/painter.hpp"
#include "view/solid_scene.hpp"
#include "view/walls.hpp"

namespace chute::view {
namespace {

using Eigen::Vector3d;

SolidLook look_of(const Studio& studio) {
  SolidLook look;
  look.ground = studio.palette.ground, look.ground_alpha = studio.palette.ground_alpha;
  look.ink = {.06, .06, .07}, look.spot = studio.palette.mark;
  look.occlusion = studio.style.occlusion ? studio.survey.diameter / 2 : 0;
  look.outlines = studio.style.outlines.value_or(false);
  return look;
}

class SolidPainter : public Painter {
 public:
  SolidPainter(const Studio& studio, std::unique_ptr<Furniture>& furniture)
      : studio_(studio), scene_(studio.style.width, studio.style.height, look_of(studio)) {
    const auto& survey = studio_.survey;
    const auto& camera = studio_.style.camera;
    normal_ = survey.up;
    const double strength = survey.gravity.norm();
    const Vector3d down = strength > 0 ? Vector3d(survey.gravity / strength) : Vector3d(Vector3d::Zero());
    const auto axes = axes_at(camera);

    box_ = survey.bounds;
    if (has_box()) box_.extend(box_of_space(survey));  // it is to be seen whole
    const double reach = studio_.style.copy_reach * period();
    if (copies()) box_.min().x() -= reach, box_.max().x() += reach;
    // while the camera moves, everything else stands where it stands at its first place
    const auto& keys = studio_.style.camera_keys;
    furniture = std::make_unique<Furniture>(
        studio_, Eye::aspect(box_, keys.empty() ? axes : axes_at(keys.front().camera)));
    eye_ = Eye::on_box(box_, axes, furniture->places().scene, camera.zoom);
    scene_place_ = furniture->places().scene;
    if (!keys.empty()) keep_distance();
    scene_.look(eye_);

    Directions directions;
    directions.gravity = eye_.seen_direction(down);
    for (int c = 0; c < 3; ++c) directions.axes.col(c) = eye_.seen_direction(Vector3d::Unit(c));
    ScaleBar scale = scale_bar(furniture->places().em);
    shown_ = furniture->places().scene;
    if (goes_near() && !(shown_.contains(scale.from) && shown_.contains(scale.to))) scale.to = scale.from;
    furniture->stand(scale, directions, studio_.arrow_length() * eye_.focal / eye_.distance,
                     studio_.widest_chain() * eye_.focal / eye_.distance);
  }

  void paint(const FrameData& data, image::Image& into) override {
    content_ = {};
    const auto& frame = data.frame;
    const auto colors = studio_.colors(frame);
    const auto* orientation = frame.find(fields::orientation.name);
    orientation_ = studio_.style.spin && orientation && orientation->components == 4 ? orientation : nullptr;
    content_.balls.reserve(frame.size());
    for (std::size_t i = 0, end = 0; i < frame.size(); ++i) {
      const bool alone = i >= end && (end = end_of_body(frame, i)) == i + 1;
      const auto body = alone ? Ball::alone : static_cast<std::uint32_t>(end);
      if (!studio_.is_cut(frame.centre(i))) add_grain(frame, i, colors[i], body);
    }
    if (studio_.style.impacts) add_impacts(data);
    if (studio_.style.trail) add_trails(data, colors);
    if (studio_.style.chains) add_chains(data.links);
    if (studio_.style.arrows) add_arrows(frame);
    if (has_box()) add_box();
    if (studio_.style.floor.value_or(false)) add_floor();
    add_walls(data.walls);
    scene_.draw(content_, into);
    if (overflows() && studio_.style.furniture) keep_inside(into);
  }

  plot::DisplayList page(const FrameData& data) override {
    plot::PictureItem item;
    paint(data, item.picture);
    divide_by_alpha(item.picture);
    item.rect = {0, 0, static_cast<double>(item.picture.width), static_cast<double>(item.picture.height)};
    plot::DisplayList list;
    list.width = item.rect.right, list.height = item.rect.bottom;
    list.background.a = 0;  // the pixels have the ground
    list.items.emplace_back(std::move(item));
    return list;
  }

 private:
  Studio studio_;
  SolidScene scene_;
  Eye eye_;
  Vector3d normal_;  ///< of the incline
  Eigen::AlignedBox3d box_;
  plot::Rect shown_, scene_place_;  ///< pixels
  SolidContent content_;
  const read::PointArray* orientation_ = nullptr;

  /// The eye's axes: azimuth counts from the direction from which x points to the right, or y if x is up.
  Eigen::Matrix3d axes_at(const Camera& camera) const {
    const auto& survey = studio_.survey;
    const Vector3d along = survey.up_axis == 0 ? Vector3d::UnitY() : Vector3d::UnitX();
    const Vector3d right = (along - along.dot(normal_) * normal_).normalized(), side = right.cross(normal_);
    const double azimuth = camera.azimuth * std::numbers::pi / 180,
                 elevation = camera.elevation * std::numbers::pi / 180;
    const Vector3d towards = std::cos(elevation) * (std::sin(azimuth) * right + std::cos(azimuth) * side) +
                             std::sin(elevation) * normal_;
    const bool tilted = studio_.style.tilt && !survey.gravity.isZero(0);
    return Eye::axes_of(towards, tilted ? Vector3d(-survey.gravity.normalized()) : normal_);
  }

  /// A camera that goes round is as near everywhere as lets it see all from each of its places; else what it sees would grow
  /// and shrink on the way.
  void keep_distance() {
    constexpr int between = 8;  // places that are looked at from one key to the next
    const auto& keys = studio_.style.camera_keys;
    const double own = eye_.focal / studio_.style.camera.zoom;
    double least = own;
    for (std::size_t k = 0; k < keys.size(); ++k)
      for (int part = 0; part < (k + 1 < keys.size() ? between : 1); ++part) {
        const double t = static_cast<double>(part) / between;
        Camera camera = keys[k].camera;
        if (k + 1 < keys.size()) {
          camera.azimuth += t * (keys[k + 1].camera.azimuth - camera.azimuth);
          camera.elevation += t * (keys[k + 1].camera.elevation - camera.elevation);
        }
        least = std::min(least, Eye::on_box(box_, axes_at(camera), scene_place_, 1).focal);
      }
    // about the middle of what is seen
    const plot::Point middle = scene_place_.centre();
    eye_.at = middle + least / own * (eye_.at - middle);
    eye_.focal = studio_.style.camera.zoom * least;
  }

  double period() const { return studio_.survey.domain.sizes().x(); }
  bool copies() const { return studio_.style.copies && period() > 0; }
  bool has_box() const { return studio_.style.box.value_or(false); }
  /// The length that is one pixel where the eye looks.
  double pixel() const { return eye_.distance / eye_.focal; }

  /// Grains may lie beyond the scene's place, and would run under the texts beside it.
  bool goes_near() const {
    const auto& style = studio_.style;
    return style.camera.zoom > 1 || style.camera.follow || !style.camera_keys.empty();
  }
  bool overflows() const { return goes_near() || studio_.survey.cropped; }
  void keep_inside(image::Image& picture) const {
    const auto& p = studio_.palette;
    const auto byte = [&](double v) {
      return static_cast<std::uint8_t>(std::lround(255 * v * p.ground_alpha));
    };
    const std::array<std::uint8_t, 4> ground{byte(p.ground.r), byte(p.ground.g), byte(p.ground.b), byte(1)};
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x)
        if (!shown_.contains(plot::Point{x + 0.5, y + 0.5}))
          std::copy(ground.begin(), ground.end(), picture.pixel(x, y));
  }

  /// Along a lower edge of the box that is near to the eye, a little outside: lengths are true there. Of the
  /// two, the one that is seen less from its end.
  ScaleBar scale_bar(double em) const {
    const int n = studio_.survey.up_axis, first = n == 0 ? 1 : 0, side = 3 - n - first;
    ScaleBar best;
    double largest = 0;  // pixels per unit
    for (const int along : {first, side}) {
      const int other = along == first ? side : first;
      Vector3d a = box_.min();
      if (studio_.survey.up[n] < 0) a[n] = box_.max()[n];
      Vector3d b = a;
      const double outside = 0.9 * studio_.survey.diameter;
      a[other] = b[other] =
          eye_.towards()[other] > 0 ? box_.max()[other] + outside : box_.min()[other] - outside;
      b[along] = box_.max()[along];
      const plot::Point whole = eye_.seen(b) - eye_.seen(a);
      const double pixels = whole.norm(), scale = pixels / (b[along] - a[along]);
      if (scale <= largest) continue;
      largest = scale;
      best.length = plain_length((b[along] - a[along]) * std::min(0.5, std::max(4 * em / pixels, 0.3)));
      (whole.x() >= 0 ? b : a)[along] = whole.x() >= 0 ? a[along] + best.length : b[along] - best.length;
      best.from = eye_.seen(whole.x() >= 0 ? a : b), best.to = eye_.seen(whole.x() >= 0 ? b : a);
    }
    best.label_below = true;
    return best;
  }

  /// Chains run inside the grains: those shrink so that they show.
  double seen_radius(const read::GrainFrame& frame, std::size_t i) const {
    constexpr double shrunk = 0.4;
    return frame.radius[i] *
           (studio_.style.chains && !studio_.is_glassy() && !studio_.is_bed(frame, i) ? shrunk : 1);
  }

  /// Of a sphere that is part of a grain its form shows how it turns: it needs no marks.
  void add_grain(const read::GrainFrame& frame, std::size_t i, Rgb color, std::uint32_t body) {
    const bool bed = studio_.is_bed(frame, i);
    Ball ball{frame.centre(i), seen_radius(frame, i), color};
    ball.opacity = bed ? 1 : studio_.style.opacity, ball.body = body;
    if (orientation_ && !bed && body == Ball::alone)
      ball.orientation = Eigen::Quaterniond(orientation_->at(i, 0), orientation_->at(i, 1),
                                            orientation_->at(i, 2), orientation_->at(i, 3))
                             .cast<float>();
    content_.balls.push_back(ball);
    if (!copies()) return;
    Ball copy = ball;
    for (const double shift : copy_shifts(studio_.style, period())) {
      copy.centre.x() = ball.centre.x() + shift;
      if (body != Ball::alone) copy.body += static_cast<std::uint32_t>(frame.size());  // a body of its own
      const double beyond = beyond_domain(studio_.survey.domain, copy.centre.x(), studio_.style.copy_reach);
      if (beyond >= 1) continue;
      copy.color = mix(color, studio_.palette.ground, 0.6 + 0.3 * std::max(0.0, beyond));
      content_.balls.push_back(copy);
    }
  }

  /// Spots on beads of the bed, which stay where they were hit. Grains that move would have turned away since.
  void add_impacts(const FrameData& data) {
    const auto* ids = data.frame.find(fields::id.name);
    std::unordered_map<long long, std::size_t> beads;
    std::size_t ball = 0;
    for (std::size_t i = 0; i < data.frame.size(); ++i) {
      if (studio_.is_cut(data.frame.centre(i))) continue;
      // copies come behind their ball
      while (content_.balls[ball].centre != data.frame.centre(i)) ++ball;
      if (data.frame.is_fixed(i)) beads[ids ? std::llround(ids->at(i)) : static_cast<long long>(i)] = ball;
    }
    for (const auto& impact : data.impacts) {
      const auto bead = beads.find(impact.bead);
      if (bead == beads.end()) continue;
      Vector3d out = impact.place - content_.balls[bead->second].centre;
      for (int c = 0; c < 3; ++c)
        if (const double period = studio_.survey.domain.sizes()[c]; period > 0)
          out[c] -= period * std::round(out[c] / period);
      if (out.norm() > 0) content_.spots.push_back({bead->second, out.normalized()});
    }
    std::stable_sort(content_.spots.begin(), content_.spots.end(),
                     [](const Spot& a, const Spot& b) { return a.ball < b.ball; });
  }

  void add_trails(const FrameData& data, const std::vector<Rgb>& colors) {
    const auto trail = trails(data);
    for (std::size_t i = 0; i < trail.paths.size(); ++i) {
      const auto& path = trail.paths[i];
      if (studio_.is_cut(data.frame.centre(i))) continue;
      const double radius = 0.16 * data.frame.radius[i], steps = static_cast<double>(studio_.style.trail);
      for (std::size_t k = 0; k + 1 < path.size(); ++k) {
        const double near = 1 - static_cast<double>(k) / steps, far = 1 - static_cast<double>(k + 1) / steps;
        content_.rods.push_back({path[k], path[k + 1], radius * near, radius * far, colors[i]});
      }
    }
  }

  void add_chains(std::span<const read::ForceLink> links) {
    if (studio_.survey.force <= 0) return;
    for (const auto& link : links) {
      const double radius =
          studio_.widest_chain() / 2 * std::min(strongest_link, link.force / studio_.survey.force);
      constexpr double thinnest = 0.004;  // mean diameters; thinner ones are not seen
      if (radius < thinnest * studio_.survey.diameter || studio_.is_cut(link.from) || studio_.is_cut(link.to))
        continue;
      Vector3d to = link.to;
      for (int c = 0; c < 3; ++c)
        if (const double L = studio_.survey.domain.sizes()[c]; L > 0)
          to[c] -= L * std::round((to[c] - link.from[c]) / L);  // a contact through the periodic ends
      content_.rods.push_back({link.from, to, radius, radius, studio_.chain_color(link.force)});
      if (!studio_.is_glassy()) continue;
      // round ends, which grains that are not seen through would hide
      for (const Vector3d& end : {link.from, to}) {
        Ball joint{end, radius, studio_.chain_color(link.force)};
        joint.has_shadow = false;
        content_.balls.push_back(joint);
      }
    }
  }

  /// They begin where they leave the grain, which would hide a part of their length otherwise.
  void add_arrows(const read::GrainFrame& frame) {
    const auto* velocity = frame.find(fields::velocity.name);
    if (!velocity || velocity->components != 3) return;
    const double unit = studio_.arrow_length(), thin = 0.035 * studio_.survey.diameter;
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (studio_.is_bed(frame, i) || studio_.is_cut(frame.centre(i))) continue;
      const Vector3d along = unit * Vector3d(velocity->at(i, 0), velocity->at(i, 1), velocity->at(i, 2));
      const double length = along.norm(), head = std::min(7 * thin, 0.5 * length);
      if (length < 2 * thin) continue;
      const Vector3d from = frame.centre(i) + seen_radius(frame, i) / length * along, tip = from + along,
                     neck = tip - head / length * along;
      content_.rods.push_back({from, neck, thin, thin, studio_.palette.ink});
      content_.rods.push_back({neck, tip, 0.36 * head, 0, studio_.palette.ink});
    }
  }

  /// A line in space about `pixels` wide, in pieces: each is looked for in the rectangle around it.
  void add_line(const Vector3d& from, const Vector3d& to, double pixels, Rgb color) {
    constexpr int pieces = 32;
    const double radius = 0.5 * pixels * pixel();
    for (int i = 0; i < pieces; ++i) {
      const Vector3d step = (to - from) / pieces;
      content_.rods.push_back({from + i * step, from + (i + 1) * step, radius, radius, color});
    }
  }
  double line_width() const { return std::max(1.2, 0.0011 * studio_.style.width); }

  /// The edges of the box that the file tells; else of that in which the run is periodic, and of all grains along the other axes.
  void add_box() {
    if (const auto& lattice = studio_.survey.lattice) {
      for (int corner = 0; corner < 8; ++corner) {
        const Vector3d steps(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
        const Vector3d from = lattice->origin + lattice->edges * steps;
        for (int edge = 0; edge < 3; ++edge)
          if (steps[edge] == 0)
            add_line(from, from + lattice->edges.col(edge), line_width(), studio_.palette.quiet);
      }
      return;
    }
    const auto box = box_of_space(studio_.survey);
    for (int corner = 0; corner < 8; ++corner)
      for (int c = 0; c < 3; ++c)
        if (const int other = corner | 1 << c; other != corner)
          add_line(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)),
                   box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(other)), line_width(),
                   studio_.palette.quiet);
  }

  void add_floor() {
    Floor floor;
    const Vector3d half = box_.diagonal() / 2;
    floor.centre = box_.center() - half[studio_.survey.up_axis] * normal_, floor.normal = normal_;
    // of a tall column as far as it is wide, or the shadow would run under the texts beside it
    double width = 0;
    for (int c = 0; c < 3; ++c)
      if (c != studio_.survey.up_axis) width = std::max(width, box_.sizes()[c]);
    floor.reach = width / box_.sizes()[studio_.survey.up_axis];
    floor.radius = half.norm() + box_.diagonal()[studio_.survey.up_axis];  // the shadow of the highest grain
    content_.floor = floor;
  }

  void add_walls(std::span<const read::WallPiece> walls) {
    constexpr double alpha = 0.16;
    const Rgb color = mix(studio_.palette.plain, studio_.palette.quiet, 0.5);
    for (const auto& wall : walls)
      if (wall.corners.size() > 2) content_.panes.push_back({wall.corners, color, alpha});
    for (const auto& [from, to] : edges_of(walls)) add_line(from, to, line_width(), color);
  }
};

}  // namespace

std::unique_ptr<Painter> make_solid_painter(const Studio& studio, std::unique_ptr<Furniture>& furniture) {
  return std::make_unique<SolidPainter>(studio, furniture);
}

}  // namespace chute::view
