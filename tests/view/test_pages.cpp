// Pictures as pages: what a file shows is what the pixels show.
#include <catch2/catch.hpp>
#include <cmath>

#include "grains.hpp"
#include "image/compare.hpp"
#include "plot/draw.hpp"
#include "plot/placed.hpp"

using namespace chute;

namespace pages_tests {

namespace {

/// Both, by the same survey.
std::pair<image::Image, plot::DisplayList> both(const read::GrainFrame& frame,
                                                const view::FrameStyle& style) {
  view::Surveyor surveyor(style);
  surveyor.see(frame);
  surveyor.see_force(2);
  const auto survey = surveyor.finish();
  const read::ForceLink link{frame.centre(frame.size() - 1), frame.centre(frame.size() - 2), 2};
  const view::FrameData data{.frame = frame, .time = 1.5, .links = std::span(&link, 1)};
  view::FrameRenderer renderer(style, survey);
  auto pixels = renderer.draw(data);
  return {std::move(pixels), renderer.page(data)};
}

}  // namespace

TEST_CASE("In the plane a page has the picture's shapes as curves, and its texts as texts") {
  view::FrameStyle style;
  style.width = 600, style.height = 400, style.title = "A chute";
  style.chains = style.copies = true;
  const auto [pixels, page] = both(grains::small_chute(), style);
  CHECK((page.width == 600 && page.height == 400));
  bool has_picture = false;
  std::string texts;
  for (const auto& item : page.items) {
    has_picture = has_picture || std::holds_alternative<plot::PictureItem>(item);
    if (const auto* run = std::get_if<plot::GlyphRun>(&item)) texts += run->text;
  }
  CHECK_FALSE(has_picture);
  CHECK(texts.find("A chute") != std::string::npos);
  const auto drawn = plot::rasterise_by_cairo(page, 72);
  const auto same = image::compare(drawn, pixels);
  INFO(same.summary());
  CHECK(same.ssim > 0.99);
  CHECK(same.rms < 5);
  // and the measure sees one grain less
  auto without = page;
  for (auto item = without.items.end(); item != without.items.begin();)
    if (const auto* fill = std::get_if<plot::FillItem>(&*--item);
        fill && fill->path.bounds().width() > 20 && fill->color.a == 1) {
      without.items.erase(item);
      break;
    }
  CHECK(image::compare(plot::rasterise_by_cairo(without, 72), pixels).rms > 1.2 * same.rms);
}

TEST_CASE("In space a page has the picture's pixels, and its texts as texts") {
  view::FrameStyle style;
  style.width = 300, style.height = 200;
  for (const auto background : {view::Background::white, view::Background::transparent}) {
    style.background = background;
    const auto [pixels, page] = both(grains::cube(3), style);
    REQUIRE(std::holds_alternative<plot::PictureItem>(page.items[0]));
    const auto same = image::compare(plot::rasterise_by_cairo(page, 72), pixels);
    INFO(same.summary());
    CHECK(same.ssim > 0.995);  // texts are set a fraction of a pixel apart
  }
}

TEST_CASE("A list that is put on a page twice as large is the list at twice the resolution") {
  view::FrameStyle style;
  style.width = 300, style.height = 200;
  const auto page = both(grains::small_chute(), style).second;
  plot::DisplayList large;
  large.width = 600, large.height = 400, large.background = page.background;
  plot::place(large, page, 2, {0, 0});
  const auto same = image::compare(plot::rasterise_by_cairo(large, 72), plot::rasterise_by_cairo(page, 144));
  CHECK(same.worst <= 2);
}

}  // namespace pages_tests
