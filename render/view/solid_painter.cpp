#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/fields.hpp"
#include "view/hidden.hpp"
#include "view/offscreen.hpp"
#include "view/painter.hpp"
#include "view/solid_scene.hpp"

namespace chute::view {
namespace {

class SolidPainter : public Painter {
 public:
  SolidPainter(const Studio& studio, std::unique_ptr<Furniture>& furniture)
      : studio_(studio),
        context_(SolidScene::samples * studio.style.width, SolidScene::samples * studio.style.height),
        scene_(context_, studio.style.width, studio.style.height, studio.palette.ground,
               studio.palette.ground_alpha) {
    const auto& survey = studio_.survey;
    const auto& g = survey.gravity;
    const std::size_t n = static_cast<std::size_t>(survey.up_axis);
    Vector normal{}, side{}, down = g;
    normal[n] = 1;
    side[3 - n] = n == 2 ? -1 : 1;  // from where x points to the right
    const double strength = std::hypot(g[0], g[1], g[2]);
    for (double& x : down) x = strength > 0 ? x / strength : 0;
    Vector up = normal;
    if (studio_.style.tilt && strength > 0) up = {-down[0], -down[1], -down[2]};
    const auto& camera = studio_.style.camera;
    const double azimuth = camera.azimuth * std::numbers::pi / 180,
                 elevation = camera.elevation * std::numbers::pi / 180;
    Vector towards;
    for (std::size_t c = 0; c < 3; ++c)
      towards[c] = std::cos(elevation) * (std::sin(azimuth) * (c == 0) + std::cos(azimuth) * side[c]) +
                   std::sin(elevation) * normal[c];

    box_ = survey.bounds;
    if (copies()) box_[0] -= copy_reach * period(), box_[1] += copy_reach * period();
    furniture =
        std::make_unique<Furniture>(studio_.style, survey, studio_.map, Eye::aspect(box_, towards, up));
    eye_ = Eye::on_box(box_, towards, up, furniture->layout().scene, camera.zoom);
    const double depth = std::hypot(box_[1] - box_[0], box_[3] - box_[2], box_[5] - box_[4]);
    scene_.look(eye_, {eye_.distance - depth, eye_.distance + depth});
    if (studio_.style.occlusion) scene_.occlude(survey.diameter / 2);

    Directions directions;
    directions.gravity = eye_.seen_direction(down);
    for (std::size_t c = 0; c < 3; ++c) {
      Vector axis{};
      axis[c] = 1;
      directions.axes[c] = eye_.seen_direction(axis);
    }
    ScaleBar scale = scale_bar(furniture->layout().em);
    shown_ = furniture->layout().scene;
    if (zoomed() && !(shown_.contains(scale.from) && shown_.contains(scale.to))) scale.to = scale.from;
    furniture->stand(scale, directions, studio_.arrow_length() * eye_.focal / eye_.distance);
  }

  void paint(const FrameData& data, image::Image& into) override {
    balls_.clear(), rods_.clear();
    const auto& frame = data.frame;
    const auto colors = studio_.colors(frame);
    for (std::size_t i = 0; i < frame.size(); ++i) add_grain(frame, i, colors[i]);
    if (studio_.style.trail) add_trails(data, colors);
    if (studio_.style.chains) add_chains(data.contacts);
    if (studio_.style.arrows) add_arrows(frame);
    // rods that end inside balls do not hide them
    scene_.draw(visible(balls_, eye_, studio_.style.width, studio_.style.height), rods_, into);
    if (zoomed() && studio_.style.furniture) keep_inside(into);
  }

 private:
  Studio studio_;
  OffscreenContext context_;
  SolidScene scene_;
  Eye eye_;
  std::array<double, 6> box_{};
  plot::Rect shown_;  ///< pixels
  std::vector<Ball> balls_;
  std::vector<Rod> rods_;

  double period() const { return studio_.survey.domain[1] - studio_.survey.domain[0]; }
  bool copies() const { return studio_.style.copies && period() > 0; }

  /// Grains from near by fill the picture, and would run under the texts beside the scene.
  bool zoomed() const { return studio_.style.camera.zoom > 1; }
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
    const std::size_t n = static_cast<std::size_t>(studio_.survey.up_axis), side = 3 - n;
    ScaleBar best;
    double largest = 0;  // pixels per unit
    for (const std::size_t along : {std::size_t{0}, side}) {
      const std::size_t other = along == 0 ? side : 0;
      Vector a{}, b{};
      a[n] = b[n] = box_[2 * n];
      const bool far_side = eye_.towards[other] > 0;
      a[other] = b[other] = box_[2 * other + far_side] + (far_side ? 0.9 : -0.9) * studio_.survey.diameter;
      a[along] = box_[2 * along], b[along] = box_[2 * along + 1];
      const auto whole = eye_.seen(b) - eye_.seen(a);
      const double pixels = std::hypot(whole.x, whole.y), scale = pixels / (b[along] - a[along]);
      if (scale <= largest) continue;
      largest = scale;
      best.length = plain_length((b[along] - a[along]) * std::min(0.5, std::max(4 * em / pixels, 0.3)));
      (whole.x >= 0 ? b : a)[along] = whole.x >= 0 ? a[along] + best.length : b[along] - best.length;
      best.from = eye_.seen(whole.x >= 0 ? a : b), best.to = eye_.seen(whole.x >= 0 ? b : a);
    }
    best.label_below = true;
    return best;
  }

  void add_grain(const read::GrainFrame& frame, std::size_t i, Rgb color) {
    // chains run inside the grains: those shrink so that they show
    const bool shrunk = studio_.style.chains && !studio_.is_bed(frame, i);
    const double r = frame.radius[i] * (shrunk ? 0.4 : 1);
    balls_.push_back({{frame.x[i], frame.y[i], frame.z[i]}, r, color});
    if (!copies()) return;
    for (const double shift : {-period(), period()}) {
      const double x = frame.x[i] + shift;
      const double beyond = beyond_domain(studio_.survey.domain, x);
      if (beyond < 1)
        balls_.push_back({{x, frame.y[i], frame.z[i]},
                          r,
                          mix(color, studio_.palette.ground, 0.6 + 0.3 * std::max(0.0, beyond))});
    }
  }

  void add_trails(const FrameData& data, const std::vector<Rgb>& colors) {
    const auto trail = trails(data);
    for (std::size_t i = 0; i < trail.paths.size(); ++i) {
      const auto& path = trail.paths[i];
      const double radius = 0.16 * data.frame.radius[i], steps = static_cast<double>(studio_.style.trail);
      for (std::size_t k = 0; k + 1 < path.size(); ++k) {
        const double near = 1 - static_cast<double>(k) / steps, far = 1 - static_cast<double>(k + 1) / steps;
        rods_.push_back({path[k], path[k + 1], radius * near, radius * far, colors[i]});
      }
    }
  }

  void add_chains(const std::vector<read::Contact>& contacts) {
    if (studio_.survey.force <= 0) return;
    const auto& domain = studio_.survey.domain;
    for (const auto& contact : contacts) {
      const double radius =
          0.22 * studio_.survey.diameter * std::min(1.3, contact.force / studio_.survey.force);
      if (radius < 0.004 * studio_.survey.diameter) continue;
      Vector to = contact.to;
      for (std::size_t c = 0; c < 3; ++c)
        if (const double L = domain[2 * c + 1] - domain[2 * c]; L > 0)
          to[c] -= L * std::round((to[c] - contact.from[c]) / L);  // a contact through the periodic ends
      rods_.push_back(
          {contact.from, to, radius, radius, mix(studio_.palette.ink, studio_.palette.ground, 0.2)});
    }
  }

  void add_arrows(const read::GrainFrame& frame) {
    const auto* velocity = frame.find(fields::velocity.name);
    if (!velocity || velocity->components != 3) return;
    const double unit = studio_.arrow_length(), thin = 0.035 * studio_.survey.diameter;
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (studio_.is_bed(frame, i)) continue;
      const Vector from{frame.x[i], frame.y[i], frame.z[i]};
      Vector neck = from, tip = from;
      double length = 0;
      for (int c = 0; c < 3; ++c) length += std::pow(unit * velocity->at(i, c), 2);
      length = std::sqrt(length);
      if (length < 2 * thin) continue;
      const double head = std::min(7 * thin, 0.5 * length) / length;
      for (std::size_t c = 0; c < 3; ++c) {
        const double v = unit * velocity->at(i, static_cast<int>(c));
        tip[c] += v, neck[c] += (1 - head) * v;
      }
      rods_.push_back({from, neck, thin, thin, studio_.palette.ink});
      rods_.push_back({neck, tip, 0.36 * head * length, 0, studio_.palette.ink});
    }
  }
};

}  // namespace

std::unique_ptr<Painter> make_solid_painter(const Studio& studio, std::unique_ptr<Furniture>& furniture) {
  return std::make_unique<SolidPainter>(studio, furniture);
}

}  // namespace chute::view
