#include "view/frame_style.hpp"

#include <fmt/format.h>

#include <cmath>
#include <regex>

#include "common/error.hpp"
#include "plot/mathtext.hpp"

namespace chute::view {

std::optional<TimePlace> time_place(const std::string& text) {
  static const std::regex place(R"(\{(?::\.([0-9])f)?\})");
  const std::sregex_iterator first(text.begin(), text.end(), place), none;
  if (first == none || std::next(first) != none) return {};
  TimePlace found{static_cast<std::size_t>(first->position()), static_cast<std::size_t>(first->length()), {}};
  if ((*first)[1].matched) found.decimals = std::stoi((*first)[1].str());
  return found;
}

void FrameStyle::check() const {
  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw InputError(what);
  };
  for (int side : {width, height})
    require(side >= 64 && side <= 8192,
            fmt::format("picture size {} x {}: each side must be in [64, 8192]", width, height));
  if (range)
    require(std::isfinite(range->first) && std::isfinite(range->second) && range->first < range->second,
            fmt::format("colour range {}:{}: the first value must be below the second", range->first,
                        range->second));
  if (!map.empty()) ColorMap{map};
  if (up) require(up->allFinite() && up->norm() > 0, "up: needs a direction");
  require(!(up && tilt), "tilt turns gravity down, up another direction up: one of them");
  const auto check_camera = [&](const Camera& c) {
    if (const auto& w = c.window)
      require((*w)[0] < (*w)[1] && (*w)[2] < (*w)[3],
              "camera window X0:X1:Y0:Y1: X0 < X1 and Y0 < Y1 are needed");
    require(c.zoom > 0.01 && c.zoom < 100, fmt::format("camera zoom {}: must be in (0.01, 100)", c.zoom));
    require(std::abs(c.elevation) <= 90,
            fmt::format("camera elevation {}: must be in [-90, 90]", c.elevation));
  };
  check_camera(camera);
  for (std::size_t k = 0; k < camera_keys.size(); ++k) {
    const auto& key = camera_keys[k];
    check_camera(key.camera);
    require(std::isfinite(key.time) && (k == 0 || key.time > camera_keys[k - 1].time),
            "camera keys: each needs a time of its own");
    require(key.camera.window.has_value() == camera_keys[0].camera.window.has_value(),
            "camera keys: all are parts of a plane, or all are directions in space");
  }
  require(opacity > 0 && opacity <= 1, fmt::format("opacity {}: must be in (0, 1]", opacity));
  require(copy_reach > 0 && copy_reach <= 20,
          fmt::format("copies {} periods far: must be in (0, 20]", copy_reach));
  for (const Cut& cut : cuts)
    require(cut.axis >= 0 && cut.axis < 3 && std::isfinite(cut.value),
            "cut: needs a finite place on x, y or z");
  require(font_size == 0 || (font_size >= 6 && font_size <= 200),
          fmt::format("font size {}: must be in [6, 200] pixels", font_size));
  require(std::isfinite(time_scale) && time_scale > 0, fmt::format("time scale {}: must be > 0", time_scale));
  require(time.empty() || time == "none" || time_place(time),
          fmt::format(
              "time \"{}\": where the time stands is {{}} or, with digits behind the point, {{:.2f}}, once",
              time));
  // What TeX does not know is told before anything is drawn.
  if (!title.empty()) plot::set_text(title, 10);
  if (const auto place = time_place(time))
    plot::set_text(std::string(time).replace(place->at, place->length, "0"), 10);
  require(trail >= 0 && trail <= 1000, fmt::format("trail of {} frames: must be in [0, 1000]", trail));
}

std::string FrameStyle::describe() const {
  std::string text = fmt::format("{}x{} color={} map={} background={}", width, height, color, map,
                                 static_cast<int>(background));
  if (range) text += fmt::format(" range={}:{}", range->first, range->second);
  if (camera.window)
    text += fmt::format(" window={}:{}:{}:{}", (*camera.window)[0], (*camera.window)[1], (*camera.window)[2],
                        (*camera.window)[3]);
  if (camera.all) text += " all";
  for (const auto& key : camera_keys) {
    const auto window = key.camera.window.value_or(std::array<double, 4>{});
    text += fmt::format(" key={}:{}:{}:{}:{}:{}:{}:{}", key.time, key.camera.azimuth, key.camera.elevation,
                        key.camera.zoom, window[0], window[1], window[2], window[3]);
  }
  text += fmt::format(" opacity={} reach={}", opacity, copy_reach);
  if (camera.follow)
    text += camera.follow->id ? fmt::format(" follow={}", *camera.follow->id) : std::string(" follow=mean");
  if (up) text += fmt::format(" up={}:{}:{}", up->x(), up->y(), up->z());
  for (const auto& name : species) text += fmt::format(" kind={}:{}", name.size(), name);
  for (const auto* words : {&title, &time}) text += fmt::format(" words={}:{}", words->size(), *words);
  text += fmt::format(" time_scale={} font={}", time_scale, font_size);
  for (const Cut& cut : cuts) text += fmt::format(" cut={}{}{}", cut.axis, cut.above ? '>' : '<', cut.value);
  return text + fmt::format(
                    " eye={}:{}:{} tilt={:d} arrows={:d} chains={:d} copies={:d} impacts={:d} occlusion={:d} "
                    "outlines={:d} floor={:d} box={:d} spin={:d} furniture={:d} trail={}",
                    camera.azimuth, camera.elevation, camera.zoom, tilt, arrows, chains, copies, impacts,
                    occlusion, outlines.value_or(false), floor.value_or(false), box.value_or(false), spin,
                    furniture, trail);
}

const std::array<Rgb, kind_color_count>& kind_colors(Background background) {
  constexpr auto bytes = [](int r, int g, int b) { return Rgb{r / 255., g / 255., b / 255.}; };
  // The first three are Okabe and Ito's blue, vermilion and green. The others were searched for among colours of usual palettes such that
  // all pairs, also with bed and ground, stay as far apart as can be in CIELAB, as seen with all cones, without M and without L cones.
  static constexpr std::array light{bytes(0x00, 0x72, 0xb2), bytes(0xd5, 0x5e, 0x00), bytes(0x00, 0x9e, 0x73),
                                    bytes(0xf0, 0xe4, 0x42), bytes(0x88, 0xcc, 0xee), bytes(0x33, 0x22, 0x88),
                                    bytes(0x66, 0x11, 0x00), bytes(0xaa, 0xf0, 0xa0)};
  static constexpr std::array dark{bytes(0x56, 0xb4, 0xe9), bytes(0xf0, 0x88, 0x3e), bytes(0x2c, 0xc7, 0x9b),
                                   bytes(0xff, 0xc2, 0x0a), bytes(0xff, 0xff, 0xff), bytes(0x1a, 0x85, 0xff),
                                   bytes(0x8c, 0x2d, 0x04), bytes(0x33, 0x22, 0x88)};
  return background == Background::dark ? dark : light;
}

Palette palette_of(Background background) {
  constexpr Rgb vermilion{.84, .37, 0};  // Okabe and Ito's, which no colour map here contains
  constexpr auto gray = [](double level) { return Rgb{level, level, level}; };
  if (background == Background::dark)
    return {{.071, .078, .094}, gray(.93), gray(.55),     {.27, .28, .31},
            {.55, .66, .78},    vermilion, {1, .42, .52}, 1};
  return {gray(1),         gray(.10), gray(.55),       gray(.80),
          {.42, .55, .68}, vermilion, {.72, .02, .18}, background == Background::white ? 1. : 0.};
}

}  // namespace chute::view
