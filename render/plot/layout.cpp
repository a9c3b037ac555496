#include "plot/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>

#include "common/error.hpp"
#include "plot/axes.hpp"
#include "plot/cells.hpp"
#include "plot/extents.hpp"
#include "plot/fonts.hpp"
#include "plot/headings.hpp"
#include "plot/inset.hpp"
#include "plot/legend.hpp"
#include "plot/map.hpp"
#include "plot/names.hpp"

namespace chute::plot {
namespace {

/// Where a legend finds no room among the data, an axis whose upper end is free goes on beyond them, step by step,
/// in shares of its length; with more than half of it empty the legend stands above the frame instead.
constexpr double headroom_step = 0.12, most_headroom = 0.5;

/// One figure on its way to the page.
class Layouter {
 public:
  explicit Layouter(const Figure& figure)
      : figure_(figure),
        look_(look_of(figure)),
        looks_(assign_looks(figure, look_)),
        sizes_{look_.tick_size, look_.label_size, gap_of(look_)} {
    const int n = static_cast<int>(figure.panels.size());
    if (n == 0) throw InputError("a figure needs at least one panel");
    columns_ = figure.columns > 0 ? figure.columns : figure.width <= 100 || n == 1 ? 1 : 2;
    columns_ = std::min(columns_, n);
    rows_ = (n + columns_ - 1) / columns_;
    page_.width = figure.width * points_per_mm;
    headroom_.assign(figure.panels.size(), 0);
    without_names_.assign(figure.panels.size(), false);
    make_axes();
    make_legends();
  }

  Layout run() {
    // a legend that finds no room inside goes above its frame, which moves everything: until all have a place
    for (std::size_t attempt = 0; attempt <= 5 * legends_.size() + figure_.panels.size() + 2; ++attempt) {
      solve();
      Layout result = draw();
      if (settled_) return result;
    }
    return draw();
  }

 private:
  struct LegendPlan {
    LegendBlock block;
    int panel;  // -1: common
    Place wanted;
    bool above = false;  // its frame; a common one: above the figure
    int columns = 1;
  };

  const Figure& figure_;
  Look look_;
  std::map<std::string, SeriesLook> looks_;
  TextSizes sizes_;
  int columns_ = 1, rows_ = 1;
  struct {
    double width = 0, height = 0;
  } page_;
  std::vector<std::unique_ptr<Axes>> axes_;
  std::vector<LegendPlan> legends_;
  std::vector<Rect> frames_;
  std::vector<Margins> row_margins_, column_margins_;
  std::vector<double> axes_top_;  // what ticks and factors of each panel need above its frame
  std::vector<double> headroom_;
  std::vector<bool> without_names_;  // panels whose curves have no room for names beside them
  bool settled_ = false;

  int column(std::size_t panel) const { return static_cast<int>(panel) % columns_; }
  int row(std::size_t panel) const { return static_cast<int>(panel) / columns_; }
  bool has_below(std::size_t panel) const {
    return panel + static_cast<std::size_t>(columns_) < figure_.panels.size();
  }

  /// More room above the data, as a share of the range: for a legend.
  static void raise(Span& span, double share) {
    if (share > 0) span.high = std::min(span.at(1 + share), std::numeric_limits<double>::max());
  }

  /// Do two panels show the same quantity along an axis? Then a reader compares them, and they have one range.
  bool is_same(const Axis& a, const Axis& b) const {
    return !figure_.own_ranges && !a.label.empty() && a.label == b.label && a.scale == b.scale &&
           a.names == b.names;
  }

  void make_axes() {
    const auto& panels = figure_.panels;
    axes_.clear();
    std::vector<Extents> extents;
    for (const auto& p : panels) extents.push_back(extents_of(p));
    for (std::size_t i = 0; i < panels.size(); ++i) {
      Extent ex = extents[i].x, ey = extents[i].y;
      double headroom = headroom_[i];
      Extent eright = extents[i].right, etop = extents[i].top;
      for (std::size_t k = 0; k < panels.size(); ++k) {
        if (panels[i].right && panels[k].right && is_same(*panels[i].right, *panels[k].right))
          eright.include(extents[k].right);
        if (panels[i].top && panels[k].top && is_same(*panels[i].top, *panels[k].top))
          etop.include(extents[k].top);
        if ((figure_.share_x && column(k) == column(i)) || is_same(panels[i].x, panels[k].x))
          ex.include(extents[k].x);
        if ((figure_.share_y && row(k) == row(i)) || is_same(panels[i].y, panels[k].y))
          ey.include(extents[k].y), headroom = std::max(headroom, headroom_[k]);
      }
      Span y = span_of(panels[i].y, ey);
      raise(y, headroom);
      const bool show_x = !figure_.share_x || !has_below(i), show_y = !figure_.share_y || column(i) == 0;
      axes_.push_back(std::make_unique<Axes>(panels[i], span_of(panels[i].x, ex), y, sizes_, show_x, show_y));
      if (panels[i].top)
        axes_.back()->set_top(span_of(*panels[i].top, etop), color_of(panels[i], &Series::top));
      if (!panels[i].right) continue;
      Span right = span_of(*panels[i].right, eright);
      raise(right, headroom);
      axes_.back()->set_right(right, color_of(panels[i], &Series::right));
    }
  }

  /// A second axis has the colour of its series, if that is one colour.
  std::optional<Color> color_of(const Panel& panel, bool Series::*is_there) const {
    std::optional<Color> color;
    for (const auto& s : panel.series) {
      if (!(s.*is_there)) continue;
      const Color own = looks_.at(s.name).color;
      if (color && (own.r != color->r || own.g != color->g || own.b != color->b)) return {};
      color = own;
    }
    return color;
  }

  Frame frame_of(std::size_t i) const {
    return {frames_[i], axes_[i]->x(), axes_[i]->y(), axes_[i]->right(), axes_[i]->top()};
  }

  /// Series of a panel, or of all (-1); those in insets too.
  std::vector<const Series*> series_of(int panel) const {
    std::vector<const Series*> found;
    for (std::size_t i = 0; i < figure_.panels.size(); ++i) {
      if (panel >= 0 && panel != static_cast<int>(i)) continue;
      for (const auto& s : figure_.panels[i].series) found.push_back(&s);
      for (const auto& inset : figure_.panels[i].insets)
        for (const auto& s : inset.plot.series) found.push_back(&s);
    }
    std::stable_partition(found.begin(), found.end(), [](const Series* s) { return !is_doubtful(s->name); });
    return found;
  }

  /// Are the curves of this panel named where they run?
  bool has_names(std::size_t i) const {
    if (without_names_[i] || figure_.legend == Legend::off || figure_.panels[i].legend == Place::off)
      return false;
    if (figure_.panels[i].legend == Place::direct) return true;
    const auto factors = factors_in(figure_, has_common_legend(figure_) ? -1 : static_cast<int>(i));
    return factors && factors->has_lines;
  }

  void make_legends() {
    const auto& panels = figure_.panels;
    legends_.clear();
    if (figure_.legend == Legend::off) return;
    const auto fill_block = [&](LegendBlock& block, int panel, bool colors) {
      const auto series = series_of(panel);
      if (const auto factors = factors_in(figure_, panel))
        block.add(figure_, *factors, series, colors);
      else
        for (const auto* s : series) block.add(*s);
      for (const auto* s : series)
        if (s->hollow && (s->kind == Kind::markers || s->kind == Kind::both)) block.add_hollow();
    };
    if (has_common_legend(figure_)) {
      LegendPlan plan{{look_, looks_}, -1, Place::automatic};
      bool named = true;
      for (std::size_t i = 0; i < panels.size(); ++i) named = named && has_names(i);
      fill_block(plan.block, -1, !named);
      if (plan.block.count() > 1) legends_.push_back(std::move(plan));
      return;
    }
    for (std::size_t i = 0; i < panels.size(); ++i) {
      if (panels[i].legend == Place::off) continue;
      if (panels[i].legend == Place::direct && has_names(i)) continue;
      const auto place = panels[i].legend == Place::direct ? Place::automatic : panels[i].legend;
      LegendPlan plan{{look_, looks_}, static_cast<int>(i), place, place == Place::top};
      fill_block(plan.block, static_cast<int>(i), !has_names(i));
      bool asked = place != Place::automatic;
      for (const auto& s : panels[i].series)
        asked = asked || (s.label && !s.label->empty()) || s.kind == Kind::cells || s.right || s.top;
      if (plan.block.count() > (asked ? 0 : 1)) legends_.push_back(std::move(plan));
    }
  }

  /// Names at the curves of a panel: of its series, or of the factor that colours tell.
  std::vector<CurveName> names_in(std::size_t i) const {
    std::vector<CurveName> names;
    const auto& panel = figure_.panels[i];
    const auto factors = factors_in(figure_, has_common_legend(figure_) ? -1 : static_cast<int>(i));
    for (const auto& s : panel.series) {
      std::string text = s.label.value_or(label_from_name(s.name));
      if (factors && panel.legend != Place::direct) {
        const auto at = factors->of.find(s.name);
        if (at == factors->of.end()) continue;
        text = label_of_factor(figure_, factors->colors[static_cast<std::size_t>(at->second.color)]);
      }
      if (text.empty() || is_doubtful(s.name)) continue;
      const auto known = std::find_if(names.begin(), names.end(), [&](auto& n) { return n.text == text; });
      if (known == names.end())
        names.push_back({text, {&s}});
      else
        known->curves.push_back(&s);
    }
    return names;
  }

  /// Lines of a table of names whose colours could not be told beside them get markers: never colour alone.
  void mark_lines(int panel) {
    const auto factors = factors_in(figure_, panel);
    if (!factors) return;
    for (auto& [name, look] : looks_)
      if (factors->of.count(name)) look.marked = true;
  }

  double heading_height(const Panel& p, double width) const {
    double height = 0;
    for (const auto& line : heading_lines(p, look_.legend_size, width))
      height += line.ascent + line.descent + sizes_.gap;
    return height;
  }
  double legend_height(int panel) const {
    for (const auto& l : legends_)
      if (l.panel == panel && l.above) return l.block.height(l.columns) + sizes_.gap;
    return 0;
  }

  /// Frames are three quarters as high as wide, but not higher than a wide one needs to show its data.
  double aspect_for(double width) const {
    constexpr double usual = 0.75,
                     highest = 18.5;  // the latter in heights of the tick labels: 58 mm in a journal
    return figure_.aspect.value_or(std::min(usual, highest * look_.tick_size / width));
  }

  /// Finds frames such that every text has its room.
  void solve() {
    const auto n = figure_.panels.size();
    const double margin = look_.margin, between = 0.9 * look_.tick_size;
    axes_top_.assign(n, 0);
    const auto no_margins = [&] {
      column_margins_.assign(static_cast<std::size_t>(columns_), {});
      row_margins_.assign(static_cast<std::size_t>(rows_), {});
    };
    double width = page_.width / columns_ * 0.8,
           height = figure_.height.value_or(60) * points_per_mm / rows_ * 0.7;
    if (!figure_.height) height = aspect_for(width) * width;
    for (int pass = 0; pass < 12; ++pass) {
      if (pass < 4) no_margins();  // near the answer; from here on margins only grow, so that this ends
      const double old_width = width, old_height = height;
      for (std::size_t i = 0; i < n; ++i) {
        Margins m = axes_[i]->fit(width, height);
        if (figure_.panels[i].map)
          m.right = std::max(m.right, bar_width(look_, *figure_.panels[i].map, height)),
          m.top = std::max(m.top, bar_above(look_, *figure_.panels[i].map, height));
        axes_top_[i] = m.top;
        m.top += heading_height(figure_.panels[i], width) + above_frame(static_cast<int>(i), width);
        Margins &c = column_margins_[static_cast<std::size_t>(column(i))],
                &r = row_margins_[static_cast<std::size_t>(row(i))];
        c.widen(m);
        r.widen(m);
      }
      double used = 2 * margin + between * (columns_ - 1);
      for (const auto& m : column_margins_) used += m.left + m.right;
      width = (page_.width - used) / columns_;
      const double top = above_figure();
      used = 2 * margin + between * (rows_ - 1) + top;
      for (const auto& m : row_margins_) used += m.top + m.bottom;
      page_.height =
          figure_.height ? *figure_.height * points_per_mm : used + rows_ * aspect_for(width) * width;
      height = (page_.height - used) / rows_;
      if (width < 4 * look_.tick_size || height < 3 * look_.tick_size)
        throw InputError(
            fmt::format("a page of {:.0f} mm by {:.0f} mm is too small for {} panels in {} columns",
                        figure_.width, page_.height / points_per_mm, n, columns_));
      if (std::abs(width - old_width) < 1e-9 && std::abs(height - old_height) < 1e-9) break;
    }
    give_back_width(margin, between, width, height);
    place_frames(n, margin, between, width, height);
  }

  /// Where ticks and size would chase each other, because a larger frame has longer numbers that leave it less room, margins have
  /// stayed wider than what stands in them: frames take that room, at the same height, if their numbers stay as they are.
  void give_back_width(double margin, double between, double& width, double height) {
    const auto needed = [&](double w) {
      std::vector<Margins> columns(static_cast<std::size_t>(columns_));
      for (std::size_t i = 0; i < axes_.size(); ++i) {
        Margins m = axes_[i]->fit(w, height);
        if (figure_.panels[i].map)
          m.right = std::max(m.right, bar_width(look_, *figure_.panels[i].map, height));
        columns[static_cast<std::size_t>(column(i))].widen(m);
      }
      return columns;
    };
    const auto fits = [](const std::vector<Margins>& a, const std::vector<Margins>& room) {
      for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i].left > room[i].left + 1e-9 || a[i].right > room[i].right + 1e-9) return false;
      return true;
    };
    const auto narrow = needed(width);
    double used = 2 * margin + between * (columns_ - 1);
    for (const auto& m : narrow) used += m.left + m.right;
    const double wider = (page_.width - used) / columns_;
    if (wider > width + 1e-6 && fits(needed(wider), narrow)) {
      for (std::size_t i = 0; i < narrow.size(); ++i)
        column_margins_[i].left = narrow[i].left, column_margins_[i].right = narrow[i].right;
      width = wider;
    } else {
      needed(width);  // the axes are laid out for this width again
    }
  }

  void place_frames(std::size_t n, double margin, double between, double width, double height) {
    frames_.assign(n, {});
    double y = margin + above_figure();
    for (int r = 0; r < rows_; ++r) {
      const auto& rm = row_margins_[static_cast<std::size_t>(r)];
      y += rm.top;
      double x = margin;
      for (int c = 0; c < columns_; ++c) {
        const auto& cm = column_margins_[static_cast<std::size_t>(c)];
        x += cm.left;
        const auto i = static_cast<std::size_t>(r * columns_ + c);
        if (i < n) frames_[i] = {x, y, x + width, y + height};
        x += width + cm.right + between;
      }
      y += height + rm.bottom + between;
    }
  }

  double above_frame(int panel, double width) {
    for (auto& l : legends_)
      if (l.panel == panel && l.above) l.columns = l.block.columns_within(width);
    return legend_height(panel);
  }
  double above_figure() {
    for (auto& l : legends_)
      if (l.panel == -1 && l.above) l.columns = l.block.columns_within(page_.width - 2 * look_.margin);
    return legend_height(-1) > 0 ? legend_height(-1) + sizes_.gap : 0;
  }

  Layout draw() {
    settled_ = true;
    Layout out;
    out.list.width = page_.width, out.list.height = page_.height, out.list.background = look_.paper;
    const auto n = figure_.panels.size();
    std::vector<Occupancy> occupied;
    for (std::size_t i = 0; i < n; ++i) {
      const Frame frame = frame_of(i);
      Painter painter{out.list, look_, occupied.emplace_back(frames_[i]), static_cast<int>(i),
                      figure_.panels[i].map || !cell_grid(figure_.panels[i]).empty()};
      draw_marks(painter, frame, figure_.panels[i], looks_);
      for (const auto& text : occupied.back().texts())
        out.boxes.push_back({text.contour.empty() ? Box::Kind::note : Box::Kind::value, text.rect,
                             static_cast<int>(i), text.contour});
      Margins common;
      common.left = column_margins_[static_cast<std::size_t>(column(i))].left;
      common.right = column_margins_[static_cast<std::size_t>(column(i))].right;
      common.x_gap = row_margins_[static_cast<std::size_t>(row(i))].x_gap;
      axes_[i]->draw(out.list, look_, frames_[i], common, static_cast<int>(i), out.boxes);
      if (figure_.panels[i].map)
        draw_bar(out.list, look_, frames_[i], *figure_.panels[i].map, static_cast<int>(i), out.boxes);
    }
    put_headings(out);
    for (std::size_t i = 0; i < n; ++i)
      for (const auto& inset : figure_.panels[i].insets)
        draw_inset(out, inset, frames_[i], static_cast<int>(i), look_, looks_, occupied[i]);
    for (std::size_t i = 0; i < n; ++i) {
      const Frame frame = frame_of(i);
      if (!has_names(i) || put_names(out, names_in(i), frame, figure_.panels[i], looks_, occupied[i], look_,
                                     static_cast<int>(i)))
        continue;
      // all of one legend go together
      if (has_common_legend(figure_))
        without_names_.assign(n, true);
      else
        without_names_[i] = true;
      mark_lines(has_common_legend(figure_) ? -1 : static_cast<int>(i));
      make_legends();
      settled_ = false;
      return out;
    }
    for (auto& legend : legends_) put_legend(out, legend, occupied);
    return out;
  }

  /// (a), (b) and what was held fixed: in all figures at the left above the frame, in a row at one height.
  void put_headings(Layout& out) {
    const auto& panels = figure_.panels;
    std::vector<std::vector<TextBox>> all;
    for (std::size_t i = 0; i < panels.size(); ++i)
      all.push_back(heading_lines(panels[i], look_.legend_size, frames_[i].width()));
    for (std::size_t i = 0; i < panels.size(); ++i) {
      double top = frames_[i].top - row_margins_[static_cast<std::size_t>(row(i))].top;
      for (std::size_t line = 0; line < all[i].size(); ++line) {
        double ascent = 0, descent = 0;
        for (std::size_t k = 0; k < panels.size(); ++k)
          if (row(k) == row(i) && line < all[k].size())
            ascent = std::max(ascent, all[k][line].ascent), descent = std::max(descent, all[k][line].descent);
        const auto& text = all[i][line];
        const Point at{frames_[i].left, top + ascent};
        draw_text(out.list, text, at, look_.ink);
        out.boxes.push_back({Box::Kind::title, text.box_at(at), static_cast<int>(i), heading(panels[i])});
        top += ascent + descent + sizes_.gap;
      }
    }
  }

  void put_legend(Layout& out, LegendPlan& legend, std::vector<Occupancy>& occupied) {
    if (legend.above) {
      if (legend.panel == -1) {
        const double width = legend.block.width(legend.columns);
        legend.block.draw(out.list, {(page_.width - width) / 2, look_.margin}, legend.columns, -1, out.boxes);
        return;
      }
      const auto i = static_cast<std::size_t>(legend.panel);
      const double top = frames_[i].top - axes_top_[i] - sizes_.gap - legend.block.height(legend.columns);
      legend.block.draw(out.list, {frames_[i].left, top}, legend.columns, legend.panel, out.boxes);
      return;
    }
    for (int columns : {1, 2, 3}) {
      const double width = legend.block.width(columns), height = legend.block.height(columns);
      std::optional<Occupancy::Room> best;
      std::size_t panel = 0;
      for (std::size_t i = 0; i < occupied.size(); ++i) {
        if (legend.panel != -1 && legend.panel != static_cast<int>(i)) continue;
        // where it is asked for, else where it covers nothing, else where at least no text is
        auto room = occupied[i].room_for(width, height, inset_from_frame, legend.wanted);
        if (!room && in_corner(legend.wanted))
          room = occupied[i].room_for(width, height, inset_from_frame, Place::automatic);
        if (!room && in_corner(legend.wanted))
          if (const auto at = occupied[i].beside_texts(width, height, inset_from_frame, legend.wanted))
            room = Occupancy::Room{*at, 0};
        if (!room) continue;
        room->from_corner += 12 * static_cast<double>(i);  // rather in an earlier panel
        if (best && best->from_corner <= room->from_corner) continue;
        best = room;
        panel = i;
      }
      if (!best) continue;
      const Point at = best->at;
      legend.block.draw(out.list, at, columns, static_cast<int>(panel), out.boxes);
      occupied[panel].mark_text({at.x(), at.y(), at.x() + width, at.y() + height});
      return;
    }
    settled_ = false;
    // higher, if the range is ours to choose; else above the frame
    const auto i = static_cast<std::size_t>(std::max(0, legend.panel));
    if (!figure_.panels[i].y.max && !figure_.share_y && headroom_[i] + headroom_step < most_headroom) {
      headroom_[i] += headroom_step;
      make_axes();
    } else {
      if (headroom_[i] > 0) {
        headroom_[i] = 0;
        make_axes();
      }
      legend.above = true;
    }
  }
};

}  // namespace

Layout lay_out(const Figure& figure) {
  try {
    const FamilyScope family(figure.changes.font ? font_family(*figure.changes.font) : 0);
    return Layouter(figure).run();
  } catch (const InputError& error) {
    throw figure.source.empty() ? error : InputError(figure.source + ": " + error.what());
  }
}

}  // namespace chute::plot
