#include <catch2/catch.hpp>
#include <cmath>

#include "common/error.hpp"
#include "grains.hpp"
#include "view/arrangement.hpp"
#include "view/color_map.hpp"
#include "view/furniture.hpp"
#include "view/lay_over.hpp"

using namespace chute;
using Catch::Matchers::Contains;

namespace style_tests {

TEST_CASE("Colour maps: published ends, even brightness, reversed") {
  const view::ColorMap viridis("viridis"), back("viridis_r");
  CHECK(viridis.at(0) == view::Rgb{.267004, .004874, .329415});
  CHECK(viridis.at(1) == view::Rgb{.993248, .906157, .143936});
  CHECK(viridis.at(0.5).g == Approx(.5658).margin(0.003));  // matplotlib's table at 128: .5670
  CHECK(viridis.at(-3) == viridis.at(0));
  CHECK(viridis.at(7) == viridis.at(1));
  for (const auto& name : view::ColorMap::names()) {
    const view::ColorMap map(name);
    CHECK(map.is_diverging() == (name == "rdbu"));
    for (int i = 0; i < 100 && !map.is_diverging(); ++i)
      CHECK(view::brightness(map.at(0.01 * (i + 1))) >= view::brightness(map.at(0.01 * i)) - 1e-3);
  }
  for (double t : {0.0, 0.3, 1.0}) CHECK(back.at(t).r == Approx(viridis.at(1 - t).r));
  CHECK_THROWS_WITH(view::ColorMap("virdis"), Contains("did you mean \"viridis\""));
}

TEST_CASE("A wrong style is refused") {
  view::FrameStyle style;
  style.check();
  const auto refused = [](auto&& change) {
    view::FrameStyle wrong;
    change(wrong);
    CHECK_THROWS_AS(wrong.check(), InputError);
  };
  refused([](auto& s) { s.width = 10; });
  refused([](auto& s) { s.height = 10000; });
  refused([](auto& s) { s.range = {2, 2}; });
  refused([](auto& s) { s.range = {0, std::nan("")}; });
  refused([](auto& s) { s.map = "jet"; });
  refused([](auto& s) { s.camera.window = {1, 0, 0, 1}; });
  refused([](auto& s) { s.camera.zoom = 0; });
  refused([](auto& s) { s.trail = -1; });
}

TEST_CASE("Every part of a style is part of what a frame is drawn from") {
  const view::FrameStyle plain;
  const auto differs = [&](auto&& change) {
    view::FrameStyle other;
    change(other);
    CHECK(other.describe() != plain.describe());
  };
  differs([](auto& s) { s.width = 1000; });
  differs([](auto& s) { s.color = "force"; });
  differs([](auto& s) { s.map = "batlow"; });
  differs([](auto& s) { s.range = {0, 1}; });
  differs([](auto& s) { s.background = view::Background::dark; });
  differs([](auto& s) { s.trail = 1; });
  differs([](auto& s) { s.camera.window = {0, 1, 0, 1}; });
  differs([](auto& s) { s.camera.azimuth = 1; });
  differs([](auto& s) { s.camera.all = true; });
  differs([](auto& s) { s.title = "a"; });
  differs([](auto& s) { s.time = "none"; });
  differs([](auto& s) { s.time_scale = 1000; });
  differs([](auto& s) { s.font_size = 20; });
  differs([](auto& s) { s.opacity = 0.5; });
  differs([](auto& s) { s.copy_reach = 2; });
  differs([](auto& s) { s.camera_keys.resize(1); });
  for (bool view::FrameStyle::*flag :
       {&view::FrameStyle::tilt, &view::FrameStyle::arrows, &view::FrameStyle::chains,
        &view::FrameStyle::copies, &view::FrameStyle::occlusion, &view::FrameStyle::spin,
        &view::FrameStyle::furniture})
    differs([&](auto& s) { s.*flag = !(s.*flag); });
}

TEST_CASE("Nothing in a frame overlaps or leaves it, whatever its shape") {
  view::FrameStyle style;
  view::Surveyor surveyor(style);
  surveyor.see(grains::small_chute());
  auto survey = surveyor.finish();
  const auto [width, height] =
      GENERATE(table<int, int>({{400, 300}, {320, 240}, {1920, 1080}, {1280, 720}, {800, 800}, {600, 1000}}));
  const double aspect = GENERATE(0.3, 0.8, 1.0, 1.6, 2.5, 5.0, 12.0);
  survey.dimensions = GENERATE(2, 3);
  style.arrows = GENERATE(false, true);
  if (GENERATE(false, true)) style.title = "A flow";
  style.width = width, style.height = height;
  if (GENERATE(false, true)) survey.series.columns = {{"v_x", {}}};
  const double title = 2.6, labels = 1.8;
  view::Arrangement places;
  try {
    places = view::arrange(style, survey, aspect, {title, labels, GENERATE(0.0, 12.0), 0});
  } catch (const InputError& error) {  // a plot beside the grains wants its room
    CHECK_THAT(error.what(), Contains("too small for a plot"));
    CHECK((!survey.series.empty() && width < 400));
    return;
  }
  const double em = places.em;
  CAPTURE(width, height, aspect, places.upright_bar);
  const plot::Rect page{0, 0, double(width), double(height)};
  std::vector<plot::Rect> boxes{places.scene, places.gravity};
  boxes.push_back(
      {places.time.x(), places.time.y() - 0.8 * em, places.time.x() + 6 * em, places.time.y() + 0.25 * em});
  boxes.push_back({places.title.x(), places.title.y() - 0.8 * em, places.title.x() + title * em,
                   places.title.y() + 0.3 * em});
  const auto& bar = places.bar;
  boxes.push_back(
      places.upright_bar
          ? plot::Rect{bar.left, bar.top - 0.6 * em, bar.right + (0.5 + labels) * em, bar.bottom + 0.45 * em}
          : plot::Rect{bar.left - 0.6 * em, bar.top, bar.right + 0.6 * em, bar.bottom + 1.3 * em});
  if (survey.dimensions == 2)
    boxes.push_back({places.scale.x(), places.scale.y() - 0.4 * em,
                     places.scale.x() + view::longest_scale(places.scene, em) + 2.5 * em,
                     places.scale.y() + 0.4 * em});
  if (!style.title.empty())
    boxes.push_back({0, places.headline.y() - 1.1 * em, double(width), places.headline.y() + 0.4 * em});
  REQUIRE(places.has_plot == !survey.series.empty());
  if (places.has_plot) boxes.push_back(places.plot);
  const std::vector<double> keys{GENERATE(5.0, 11.0) * em, 6 * em};
  if (places.has_key) {
    const auto ends =
        view::key_places(places, keys, 6 * em, style.title.empty() ? 0 : places.headline.y() + 0.4 * em);
    // both are there where no title stands above and no plot beside
    if (style.title.empty() && !places.has_plot) CHECK((ends[0] && ends[1]));
    for (std::size_t i = 0; i < keys.size(); ++i)
      if (ends[i])
        boxes.push_back(
            {ends[i]->x() - keys[i], ends[i]->y() - 0.8 * em, ends[i]->x(), ends[i]->y() + 0.25 * em});
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    CAPTURE(i, boxes[i].left, boxes[i].top, boxes[i].right, boxes[i].bottom);
    CHECK(page.contains(boxes[i]));
    for (std::size_t k = 0; k < i; ++k) {
      CAPTURE(k, boxes[k].left, boxes[k].top, boxes[k].right, boxes[k].bottom);
      CHECK_FALSE(boxes[i].overlaps(boxes[k]));
    }
  }
  CHECK(places.scene.width() / places.scene.height() == Approx(aspect));
}

TEST_CASE("Labels: time, lengths, fields") {
  view::Survey survey;
  survey.units = "reduced", survey.time_decimals = 2;
  CHECK(view::time_text({}, survey, 12.5) == "$t = 12.50\\,\\sqrt{d/g}$");
  survey.units = "SI";
  CHECK(view::time_text({}, survey, 12.5) == "$t = 12.50\\,\\mathrm{s}$");
  view::FrameStyle own;
  own.time = "$t = {}\\,\\mathrm{ms}$", own.time_scale = 1000;
  CHECK(view::time_text(own, survey, 0.0125) ==
        "$t = 12\\,\\mathrm{ms}$");  // a scale of 1000 spares three digits
  own.time = "after {:.1f} ms";
  CHECK(view::time_text(own, survey, 0.0125) == "after 12.5 ms");
  CHECK_NOTHROW(own.check());
  own.time = "none";
  CHECK_NOTHROW(own.check());
  for (const char* wrong : {"t", "{} {}", "{:d}", "{:.2}", "{0}"}) {
    own.time = wrong;
    CHECK_THROWS_WITH(own.check(), Contains("where the time stands"));
  }
  own.time.clear(), own.title = "$\\thta$";
  CHECK_THROWS_AS(own.check(), InputError);
  CHECK(view::plain_length(7) == 5);
  CHECK(view::plain_length(0.03) == Approx(0.02));
  CHECK(view::length_text(5, "reduced") == "$5\\,d$");
  CHECK(view::length_text(0.05, "SI") == "5 cm");
  CHECK(view::length_text(0.002, "SI") == "2 mm");
  const auto frame = grains::small_chute();
  const auto title = [&](const char* name, const char* units) {
    return view::find_field(name, frame).title(units);
  };
  CHECK(title("velocity", "reduced") == "$v / \\sqrt{gd}$");
  CHECK(title("velocity:x", "reduced") == "$v_x / \\sqrt{gd}$");
  CHECK(title("velocity:x", "SI") == "$v_x$ (m/s)");
  CHECK(title("", "SI") == "$v$ (m/s)");
  CHECK(title("radius", "reduced") == "$R / d$");
  CHECK(title("type", "SI") == "type");
  CHECK_THROWS_WITH(view::find_field("velocty", frame), Contains("did you mean \"velocity\""));
  CHECK_THROWS_AS(view::find_field("velocity:w", frame), InputError);
  CHECK_THROWS_AS(view::find_field("type:x", frame), InputError);
}

TEST_CASE("A picture laid over another") {
  image::Image bottom(2, 1, 100), top(2, 1, 200);
  bottom.pixel(0, 0)[3] = 255, bottom.pixel(1, 0)[3] = 0;
  top.pixel(0, 0)[3] = top.pixel(1, 0)[3] = 51;  // a fifth
  view::lay_over(bottom, top);
  CHECK(bottom.pixel(0, 0)[0] == 120);
  CHECK(bottom.pixel(0, 0)[3] == 255);
  CHECK(bottom.pixel(1, 0)[0] == 200);
  CHECK(bottom.pixel(1, 0)[3] == 51);
}

}  // namespace style_tests
