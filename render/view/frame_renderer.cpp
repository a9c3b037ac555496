#include "view/frame_renderer.hpp"

#include <fmt/format.h>

#include <optional>

#include "common/error.hpp"
#include "view/camera_path.hpp"
#include "view/following.hpp"
#include "view/furniture.hpp"
#include "view/lay_over.hpp"
#include "view/painter.hpp"

namespace chute::view {
struct FrameRenderer::Inside {
  Survey survey;
  std::optional<Following> following;
  Studio studio;
  std::unique_ptr<Furniture> furniture;
  std::unique_ptr<Painter> painter;
  image::Image picture;

  Inside(const FrameStyle& style, const Survey& found)
      : survey(found),
        following(style.camera.follow ? std::optional<Following>(survey) : std::nullopt),
        studio(style, following ? following->around_focus() : survey) {
    if (style.camera_keys.empty()) make_painter();
  }

  void make_painter() {
    painter.reset();  // its context goes first
    painter =
        survey.dimensions == 2 ? make_flat_painter(studio, furniture) : make_solid_painter(studio, furniture);
  }

  /// Where the camera moves, scale bar and arrows change with it: all is made anew for its next place.
  void move_camera(double time) {
    if (studio.style.camera_keys.empty()) return;
    const Camera now = camera_at(studio.style, time);
    const Camera& last = studio.style.camera;
    const bool same = now.azimuth == last.azimuth && now.elevation == last.elevation &&
                      now.zoom == last.zoom && now.window == last.window;
    if (same && painter) return;
    studio.style.camera = now;
    make_painter();
  }
};

FrameRenderer::FrameRenderer(const FrameStyle& style, const Survey& survey)
    : inside_(std::make_unique<Inside>(style, survey)) {}
FrameRenderer::~FrameRenderer() = default;

const image::Image& FrameRenderer::draw(const FrameData& data) {
  auto& in = *inside_;
  in.move_camera(data.time);
  in.painter->paint(in.following ? in.following->moved(data) : data, in.picture);
  if (data.frame.size() > 0 && image::is_blank(in.picture))
    throw WorkError(
        fmt::format("{}: the picture came out blank: no grain is in view", data.frame.file.string()));
  if (in.studio.style.background == Background::transparent) divide_by_alpha(in.picture);
  in.furniture->put_on(in.picture, data.time);
  return in.picture;
}

plot::DisplayList FrameRenderer::page(const FrameData& data) {
  auto& in = *inside_;
  in.move_camera(data.time);
  auto list = in.painter->page(in.following ? in.following->moved(data) : data);
  in.furniture->add_to(list, data.time);
  return list;
}

}  // namespace chute::view
