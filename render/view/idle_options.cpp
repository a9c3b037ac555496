#include "view/idle_options.hpp"

#include <fmt/format.h>

#include <span>

#include "common/error.hpp"

namespace chute::view {
namespace {
struct Option {
  bool given;
  const char* name;
};
}  // namespace

void check_options(const FrameStyle& style, const Survey& survey) {
  const bool flat = survey.dimensions == 2;
  const Camera usual;
  const auto refuse = [](bool given, const char* option, const char* why) {
    if (given) throw InputError(fmt::format("{} does nothing here: {}", option, why));
  };
  const auto& keys = style.camera_keys;
  const Option in_space[] = {
      {style.occlusion, "--occlusion"},
      {style.outlines.has_value(), "--outlines"},
      {style.floor.has_value(), "--floor"},
      {style.box.has_value(), "--box"},
      {style.camera.azimuth != usual.azimuth || style.camera.elevation != usual.elevation ||
           style.camera.zoom != usual.zoom,
       "--camera AZIMUTH:ELEVATION[:ZOOM]"},
      {!keys.empty() && !keys.front().camera.window, "--camera-at TIME=AZIMUTH:ELEVATION[:ZOOM]"}};
  const Option in_plane[] = {
      {style.camera.window.has_value(), "--camera X0:X1:Y0:Y1"},
      {!keys.empty() && keys.front().camera.window.has_value(), "--camera-at TIME=X0:X1:Y0:Y1"}};
  const std::span<const Option> wrong =
      flat ? std::span<const Option>(in_space) : std::span<const Option>(in_plane);
  for (const Option& option : wrong)
    if (option.given)
      throw InputError(fmt::format("{} does nothing here: these grains lie in {}", option.name,
                                   flat ? "a plane" : "space"));
  constexpr const char* in_a_plane = "these grains lie in a plane";
  refuse(flat && style.up && style.up->head<2>().isZero(0), "--up along z", in_a_plane);
  refuse(style.copies && !(survey.domain.sizes()[0] > 0), "--copies", "the frames name no period along x");
  for (const Cut& cut : style.cuts) refuse(flat && cut.axis == 2, "--cut along z", in_a_plane);
  refuse(style.arrows && !(survey.speed > 0), "--arrows", "the frames tell no velocities, or nothing moves");
  for (const Option& option :
       {Option{style.range.has_value(), "--range"}, Option{!style.map.empty(), "--colormap"}}) {
    refuse(option.given && survey.field.is_none(), option.name, "nothing is coloured");
    refuse(option.given && !survey.categories.empty(), option.name, "kinds have colours of their own");
  }
}

std::vector<std::string> idle_options(const FrameStyle& style, const Survey& survey) {
  std::vector<std::string> notes;
  if (style.tilt && survey.slope == 0)
    notes.emplace_back("--tilt does nothing here: gravity points down as it is");
  if (style.trail > 0 && survey.times.size() == 1)
    notes.emplace_back("--trails does nothing here: there is one frame");
  return notes;
}

void check_map_options(const FrameStyle& style, bool plot) {
  const Camera usual;
  const auto& c = style.camera;
  const bool camera = c.window || c.all || c.follow || c.azimuth != usual.azimuth ||
                      c.elevation != usual.elevation || c.zoom != usual.zoom;
  for (const Option& option : {Option{camera, "--camera"},
                               Option{!style.camera_keys.empty(), "--camera-at"},
                               Option{style.opacity < 1, "--opacity"},
                               Option{style.tilt, "--tilt"},
                               Option{style.up.has_value(), "--up"},
                               Option{style.arrows, "--arrows"},
                               Option{style.chains, "--chains"},
                               Option{style.copies, "--copies"},
                               Option{style.impacts, "--impacts"},
                               Option{style.occlusion, "--occlusion"},
                               Option{style.outlines.has_value(), "--outlines"},
                               Option{style.floor.has_value(), "--floor"},
                               Option{style.box.has_value(), "--box"},
                               Option{style.trail > 0, "--trails"},
                               Option{!style.cuts.empty(), "--cut"},
                               Option{!style.species.empty(), "--species"},
                               Option{!style.spin, "--no-spin"},
                               Option{!style.furniture, "--bare"},
                               Option{!style.title.empty(), "--title"},
                               Option{!style.time.empty(), "--time"},
                               Option{style.font_size > 0, "--font-size"},
                               Option{plot, "--plot"}})
    if (option.given)
      throw InputError(fmt::format("{} does nothing here: these are maps of cells, no grains", option.name));
  if (!style.map.empty() && style.map != "viridis" && style.map != "rdbu")
    throw InputError(
        fmt::format("--colormap {} does nothing here: maps of cells have viridis or rdbu", style.map));
  if (style.background == Background::transparent)
    throw InputError("--background transparent does nothing here: maps of cells have white or dark ground");
}

}  // namespace chute::view
