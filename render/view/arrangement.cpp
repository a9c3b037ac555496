#include "view/arrangement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/error.hpp"

namespace chute::view {
namespace {

// All in em, the size of the type.
constexpr double margin = 1.3;      // around everything
constexpr double line = 1.55;       // the line of time above the scene, with the space to it
constexpr double foot = 1.9;        // the scale bar below the scene, with the space to it
constexpr double gap = 1.5;         // between the scene and what stands beside it
constexpr double bar_width = 0.85;  // of the colours
constexpr double label_gap = 0.5;   // colours to numbers
constexpr double longest_bar = 20;
constexpr double kind_row = 1.2;  // a kind's name below another, at least
constexpr double gravity_width = 4.4, gravity_height = 5.0;
constexpr double plot_width = 17, plot_height = 10;  // at least, of a plot beside or below the scene
constexpr double time_width = 6.5;                   // of the line of time, with the space after it
constexpr double scale_label = 3;                    // beside the scale bar
constexpr double least_scene = 6;                    // its longer side, where a plot takes room
constexpr double headline = 2.4;                     // the picture's title, with the space below it
constexpr double key_gap = 1.2, key_line = 1.45;  // between keys in a row; from one line of them to the next
constexpr double key_ascent = 0.8;                // of a key's text

Arrangement moved_down(Arrangement places, double by) {
  const plot::Point down{0, by};
  for (plot::Point* point : {&places.title, &places.time, &places.key, &places.scale}) *point += down;
  for (plot::Rect* rect : {&places.scene, &places.bar, &places.plot, &places.gravity})
    rect->top += by, rect->bottom += by;
  return places;
}

}  // namespace

double longest_scale(const plot::Rect& scene, double em) {
  return std::clamp(0.2 * scene.width(), 3 * em, 9 * em);
}

std::vector<std::optional<plot::Point>> key_places(const Arrangement& places, std::span<const double> widths,
                                                   double time_width, double top) {
  const double em = places.em;
  const auto row_width = [&](std::span<const double> row) {
    double sum = -key_gap * em;
    for (const double width : row) sum += width + key_gap * em;
    return sum;
  };
  // as many as fit beside the time, and the others in a row above it, which may begin left of the scene
  const double room = places.scene.width() - (time_width > 0 ? time_width + key_gap * em : 0);
  std::size_t beside = 0;
  while (beside < widths.size() && row_width(widths.first(beside + 1)) <= room) ++beside;
  std::vector<std::optional<plot::Point>> ends;
  const auto put = [&](std::span<const double> row, plot::Point end) {
    for (const double width : row) {
      if (end.y() - key_ascent * em < top)
        ends.emplace_back();
      else
        ends.emplace_back(end);
      end.x() -= width + key_gap * em;
    }
  };
  put(widths.first(beside), places.key);
  auto above = widths.subspan(beside);
  // what stands beside the scene and reaches up to that row ends it
  const double line = places.key.y() - key_line * em;
  double right = std::numeric_limits<double>::infinity();
  plot::Rect bar = places.bar;
  bar.top = std::min(bar.top, places.title.y() - key_ascent * em);
  for (const auto& [there, rect] :
       {std::pair{places.has_bar, bar}, std::pair{places.has_gravity, places.gravity},
        std::pair{places.has_plot, places.plot}})
    if (there && rect.left >= places.scene.right && rect.top < line + 0.25 * em &&
        rect.bottom > line - key_ascent * em)
      right = std::min(right, rect.left);
  while (!above.empty() && row_width(above) + 0.5 * em > right) above = above.first(above.size() - 1);
  put(above, {std::max(places.key.x(), row_width(above) + 0.5 * em), line});
  ends.resize(widths.size());
  return ends;
}

namespace {

struct Fit {
  Arrangement places;
  double size;  ///< width of the scene
};

Fit beside(Arrangement places, double width, double height, double aspect, const BarTexts& texts) {
  const double em = places.em;
  const double panel =
      em * std::max(places.has_bar ? std::max(texts.title, bar_width + label_gap + texts.longest_label) : 0,
                    places.has_gravity ? gravity_width : 0);
  const double space = panel > 0 ? gap * em : 0;
  const double top = places.has_time || places.has_key ? line * em : 0, bottom = places.foot * em;
  const double free_width = width - 2 * margin * em - space - panel,
               free_height = height - 2 * margin * em - top - bottom;
  const double w = std::max(1.0, std::min(free_width, free_height * aspect)), h = w / aspect;
  const double left = (width - w - space - panel) / 2, above = (height - h - top - bottom) / 2 + top;
  places.scene = {left, above, left + w, above + h};
  places.time = {left, above - (line - 1) * em};
  places.key = {left + w, places.time.y()};
  places.scale = {left, above + h + 1.15 * em};

  // the panel is as high as the scene if that is enough for a bar and the arrows
  const double x = left + w + space;
  const double kinds = kind_row * texts.rows;
  const double least =
      em * ((places.has_bar ? std::max(8.5, 2 + kinds) : 0) + (places.has_gravity ? gravity_height : 0));
  const double extra = std::max(0.0, least - h) / 2;
  // a narrow scene's line of time reaches over the panel, and its scale bar under it
  const bool time_above = places.has_time && w + space < time_width * em;
  const double panel_top = std::max(time_above ? places.time.y() + 0.3 * em : margin * em, above - extra);
  const bool scale_below =
      places.foot >= foot && w + space < longest_scale(places.scene, em) + scale_label * em;
  const double panel_bottom =
      std::min(scale_below ? places.scale.y() - 0.5 * em : height - margin * em, above + h + extra);
  places.gravity = {x, panel_bottom - gravity_height * em, x + gravity_width * em, panel_bottom};
  places.title = {x, panel_top + 0.8 * em};
  const double bar_top = panel_top + 1.75 * em;
  const double bar_bottom = panel_bottom - (places.has_gravity ? gravity_height + 1.2 : 0.2) * em;
  places.bar = {x, bar_top, x + bar_width * em, std::min(bar_bottom, bar_top + longest_bar * em)};
  places.upright_bar = true;
  return {places, places.bar.height() < std::max(5.0, kinds) * em && places.has_bar ? 0.0 : w};
}

Fit below(Arrangement places, double width, double height, double aspect, const BarTexts& texts) {
  const double em = places.em;
  const double top = places.has_time || places.has_key ? line * em : 0;
  const double row = em * (places.has_gravity ? gravity_height + 0.6 : places.has_bar ? 3.4 : places.foot);
  const double free_width = width - 2 * margin * em, free_height = height - 2 * margin * em - top - row;
  const double w = std::max(1.0, std::min(free_width, free_height * aspect)), h = w / aspect;
  const double left = (width - w) / 2, above = (height - h - top - row) / 2 + top;
  places.scene = {left, above, left + w, above + h};
  places.time = {left, above - (line - 1) * em};
  places.key = {left + w, places.time.y()};
  places.scale = {left, above + h + 1.25 * em};
  places.gravity = {left + w - gravity_width * em, above + h + 0.6 * em, left + w,
                    above + h + (0.6 + gravity_height) * em};
  // between the scale bar with its label and the arrows: title, then colours
  const double from = left + (places.has_scale ? longest_scale(places.scene, em) + 4.2 * em : 0),
               to = left + w - em * (places.has_gravity ? gravity_width + 2 : 0);
  const bool kinds = texts.kinds > 0;
  const double room = to - from - em * (texts.title + 0.9 + (kinds ? 0 : texts.longest_label));
  const double length = std::min(room, (kinds ? texts.kinds : 1.3 * longest_bar) * em);
  const double start = from + (to - from - length - em * (texts.title + 0.9)) / 2;
  const double y = above + h + 1.25 * em;
  places.title = {start, y + 0.3 * em};
  places.bar = {start + (texts.title + 0.9) * em, y - bar_width / 2 * em,
                start + (texts.title + 0.9) * em + length, y + bar_width / 2 * em};
  places.upright_bar = false;
  // a bar needs some length, kinds fit into two rows
  const double least = kinds ? std::max(texts.longest_label + 3, 0.55 * texts.kinds) : 7;
  return {places, length < least * em && places.has_bar ? 0.0 : w};
}

}  // namespace

Arrangement arrange(const FrameStyle& style, const Survey& survey, double aspect, const BarTexts& texts) {
  Arrangement places;
  // readable at 400 x 300, quiet at 1920 x 1080
  places.em = style.font_size > 0
                  ? style.font_size
                  : std::max(12.0, 0.0225 * std::sqrt(static_cast<double>(style.width) * style.height));
  const double head = style.title.empty() ? 0 : headline * places.em;
  const double width = style.width, height = style.height - head;
  if (!style.furniture) {
    const double edge = 0.02 * std::min(width, height);
    const double w = std::min(width - 2 * edge, (height - 2 * edge) * aspect), h = w / aspect;
    places.scene = {(width - w) / 2, (height - h) / 2, (width + w) / 2, (height + h) / 2};
    return places;
  }
  places.has_bar = survey.field.has_bar();
  places.has_time = survey.has_times && style.time != "none";
  places.has_gravity = !survey.gravity.isZero(0);
  places.has_scale = true;
  places.has_key = (style.arrows && survey.speed > 0) || (style.chains && survey.force > 0);
  // in space the scale bar is part of the scene, only its label may reach below
  places.foot = survey.dimensions == 2 ? foot : 0.8;
  const auto fit = [&](double room_width, double room_height) {
    const auto side = beside(places, room_width, room_height, aspect, texts);
    const auto under = below(places, room_width, room_height, aspect, texts);
    return side.size >= under.size ? side : under;
  };
  if (survey.series.empty()) {
    places = fit(width, height).places;
  } else {
    const double strip = std::max(plot_height * places.em, 0.24 * height),
                 column = std::max(plot_width * places.em, 0.34 * width), edge = 0.5 * margin * places.em;
    const auto above = fit(width, height - strip), left = fit(width - column, height);
    places = above.size >= left.size ? above.places : left.places;
    if (std::max(above.size, left.size) < least_scene * places.em * std::min(1.0, aspect))
      throw InputError(fmt::format("a picture of {} x {} pixels is too small for a plot beside the grains",
                                   style.width, style.height));
    places.has_plot = true;
    if (above.size >= left.size) {
      places.plot = {edge, height - strip, width - edge, height - edge};
    } else {
      const double tall = std::min(height - 2 * edge, 0.8 * column), middle = places.scene.centre().y();
      const double top = std::clamp(middle - tall / 2, edge, height - edge - tall);
      places.plot = {width - column, top, width - edge, top + tall};
    }
  }
  places = moved_down(places, head);
  places.headline = {width / 2, (margin + 0.8) * places.em};
  return places;
}

}  // namespace chute::view
