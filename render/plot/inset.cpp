#include "plot/inset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "common/error.hpp"
#include "plot/axes.hpp"
#include "plot/extents.hpp"
#include "plot/mathtext.hpp"

namespace chute::plot {

void draw_inset(Layout& out, const Inset& inset, const Rect& frame, int panel, const Look& look,
                const std::map<std::string, SeriesLook>& looks, Occupancy& occupied) {
  const double width = inset.width * frame.width(), height = inset.height * frame.height();
  std::optional<Point> at;
  // where it is asked for, else where it covers nothing, else where at least no text is
  for (const auto place : {inset.place, Place::automatic})
    if (const auto room = occupied.room_for(width, height, inset_from_frame, place); room && !at)
      at = room->at;
  if (!at) at = occupied.beside_texts(width, height, inset_from_frame, inset.place);
  if (!at)
    throw InputError(fmt::format("an inset of {} by {} of its panel finds no room beside the texts",
                                 inset.width, inset.height));
  const Rect outer{at->x(), at->y(), at->x() + width, at->y() + height};
  const auto extents = extents_of(inset.plot);
  const double shrink = std::max(0.8, smallest_type / look.tick_size);
  const TextSizes sizes{shrink * look.tick_size, shrink * look.label_size, 0.8 * gap_of(look)};
  Axes axes(inset.plot, span_of(inset.plot.x, extents.x), span_of(inset.plot.y, extents.y), sizes, true,
            true);
  Margins m;
  Rect inner;
  for (int pass = 0; pass < 5; ++pass) {
    inner = {outer.left + m.left, outer.top + m.top, outer.right - m.right, outer.bottom - m.bottom};
    if (inner.width() < 3 * sizes.tick || inner.height() < 2 * sizes.tick)
      throw InputError(fmt::format("an inset of {} by {} of its panel is too small for its labels",
                                   inset.width, inset.height));
    m.widen(axes.fit(inner.width(), inner.height()));
  }
  inner = {outer.left + m.left, outer.top + m.top, outer.right - m.right, outer.bottom - m.bottom};
  Path ground;
  out.list.fill(ground.rectangle(outer), look.paper);
  Look small = look;
  small.marker_size *= 0.75, small.line_width *= 0.85, small.cap *= 0.75;
  Occupancy inside(inner);
  Painter painter{out.list, small, inside};
  draw_marks(painter, Frame{inner, axes.x(), axes.y()}, inset.plot, looks);
  std::vector<Box> own;
  axes.draw(out.list, look, inner, m, panel, own);
  out.boxes.push_back({Box::Kind::inset, outer, panel, ""});
  occupied.mark_text(outer);
}

}  // namespace chute::plot
