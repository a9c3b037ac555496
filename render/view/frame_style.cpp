#include "view/frame_style.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/error.hpp"

namespace chute::view {

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
  if (const auto& w = camera.window)
    require((*w)[0] < (*w)[1] && (*w)[2] < (*w)[3],
            "camera window X0:X1:Y0:Y1: X0 < X1 and Y0 < Y1 are needed");
  require(camera.zoom > 0.01 && camera.zoom < 100,
          fmt::format("camera zoom {}: must be in (0.01, 100)", camera.zoom));
  require(std::abs(camera.elevation) <= 90,
          fmt::format("camera elevation {}: must be in [-90, 90]", camera.elevation));
  for (const Cut& cut : cuts)
    require(cut.axis >= 0 && cut.axis < 3 && std::isfinite(cut.value),
            "cut: needs a finite place on x, y or z");
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
  if (camera.follow)
    text += camera.follow->id ? fmt::format(" follow={}", *camera.follow->id) : std::string(" follow=mean");
  for (const Cut& cut : cuts) text += fmt::format(" cut={}{}{}", cut.axis, cut.above ? '>' : '<', cut.value);
  return text + fmt::format(
                    " eye={}:{}:{} tilt={:d} arrows={:d} chains={:d} copies={:d} impacts={:d} occlusion={:d} "
                    "outlines={:d} floor={:d} box={:d} spin={:d} furniture={:d} trail={}",
                    camera.azimuth, camera.elevation, camera.zoom, tilt, arrows, chains, copies, impacts,
                    occlusion, outlines, floor, box, spin, furniture, trail);
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
