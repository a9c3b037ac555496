#include "view/frame_renderer.hpp"

#include <fmt/format.h>

#include "common/error.hpp"
#include "view/painter.hpp"

namespace chute::view {
namespace {

/// Colours were multiplied by alpha while shapes were laid over each other; files and blending want them as
/// they are.
void divide_by_alpha(image::Image& picture) {
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    const unsigned alpha = picture.rgba[i + 3];
    if (alpha == 0 || alpha == 255) continue;
    for (std::size_t c = 0; c < 3; ++c)
      picture.rgba[i + c] =
          static_cast<std::uint8_t>(std::min(255u, (picture.rgba[i + c] * 255u + alpha / 2) / alpha));
  }
}

}  // namespace

struct FrameRenderer::Inside {
  Studio studio;
  std::unique_ptr<Furniture> furniture;
  std::unique_ptr<Painter> painter;
  image::Image picture;

  Inside(const FrameStyle& style, const Survey& survey) : studio(style, survey) {
    painter =
        survey.dimensions == 2 ? make_flat_painter(studio, furniture) : make_solid_painter(studio, furniture);
  }
};

FrameRenderer::FrameRenderer(const FrameStyle& style, const Survey& survey)
    : inside_(std::make_unique<Inside>(style, survey)) {}
FrameRenderer::~FrameRenderer() = default;

const image::Image& FrameRenderer::draw(const read::GrainFrame& frame, double time,
                                        const std::vector<read::Contact>& contacts,
                                        const std::vector<const read::GrainFrame*>& earlier) {
  auto& in = *inside_;
  in.painter->paint({frame, contacts, earlier}, in.picture);
  if (image::is_blank(in.picture))
    throw WorkError(fmt::format("{}: the picture came out blank: no grain is in view", frame.file.string()));
  if (in.studio.style.background == Background::transparent) divide_by_alpha(in.picture);
  in.furniture->put_on(in.picture, time);
  return in.picture;
}

}  // namespace chute::view
