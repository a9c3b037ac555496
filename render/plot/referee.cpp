#include "plot/referee.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "plot/factors.hpp"
#include "plot/polyline.hpp"

namespace chute::plot {
namespace {

using Fault = Finding::Kind;

bool stands_inside(Box::Kind kind) {
  return kind == Box::Kind::legend || kind == Box::Kind::panel_label || kind == Box::Kind::inset ||
         kind == Box::Kind::note || kind == Box::Kind::name || kind == Box::Kind::value;
}

const char* name(Box::Kind kind) {
  static const char* names[] = {
      "frame", "tick label",      "axis label",        "factor", "title", "panel label", "legend", "inset",
      "note",  "name at a curve", "value of a contour"};
  return names[static_cast<int>(kind)];
}

std::string told(const Box& box) {
  return box.text.empty() ? name(box.kind) : fmt::format("{} \"{}\"", name(box.kind), box.text);
}

const Path* path_of(const Item& item) {
  if (const auto* fill = std::get_if<FillItem>(&item)) return &fill->path;
  if (const auto* stroke = std::get_if<StrokeItem>(&item)) return &stroke->path;
  return nullptr;
}

bool is_same(const Color& a, const Color& b) { return a.r == b.r && a.g == b.g && a.b == b.b && a.a == b.a; }

class Referee {
 public:
  Referee(const Figure& figure, const Layout& layout) : figure_(figure), layout_(layout) {
    for (const auto& box : layout.boxes)
      if (box.kind == Box::Kind::frame) frames_[box.panel] = box.rect;
  }

  std::vector<Finding> review() {
    texts();
    markers();
    points();
    outside();
    looks();
    parameters();
    return std::move(found_);
  }

 private:
  const Figure& figure_;
  const Layout& layout_;
  std::map<int, Rect> frames_;
  std::vector<Finding> found_;

  void add(Fault kind, int panel, std::string what) { found_.push_back({kind, panel, std::move(what)}); }

  Rect bounds(const Tag& tag) const {
    Rect all = Rect::nothing();
    for (std::size_t i = tag.first; i < tag.last; ++i) {
      const auto& item = layout_.list.items[i];
      if (const auto* path = path_of(item)) {
        const auto* stroke = std::get_if<StrokeItem>(&item);
        all.include(path->bounds().grown(stroke ? stroke->stroke.width / 2 : 0));
      }
      if (const auto* dots = std::get_if<DotsItem>(&item))
        for (const auto& at : dots->at) all.include(dots->shape.bounds().moved(at));
    }
    return all;
  }

  void texts() {
    const Rect page{-1e-6, -1e-6, layout_.list.width + 1e-6, layout_.list.height + 1e-6};
    const auto& boxes = layout_.boxes;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const auto& a = boxes[i];
      if (!page.contains(a.rect)) add(Fault::text_overlap, a.panel, told(a) + " leaves the page");
      for (std::size_t k = i + 1; k < boxes.size(); ++k) {
        const auto& b = boxes[k];
        if (!a.rect.overlaps(b.rect)) continue;
        const auto &frame = a.kind == Box::Kind::frame ? a : b, &other = a.kind == Box::Kind::frame ? b : a;
        if (frame.kind == Box::Kind::frame && stands_inside(other.kind) && frame.rect.contains(other.rect))
          continue;
        add(Fault::text_overlap, a.panel, told(a) + " overlaps " + told(b));
      }
      if (stands_inside(a.kind)) on_data(a);
    }
  }

  /// Does this text cover a marker, or a part of a curve?
  void on_data(const Box& text) {
    for (const auto& tag : layout_.list.tags) {
      const bool mark = tag.kind == Tag::Kind::marker || tag.kind == Tag::Kind::beyond;
      if (tag.panel != text.panel && text.panel >= 0) continue;
      if (mark && bounds(tag).overlaps(text.rect))
        return add(Fault::text_on_data, tag.panel, told(text) + " covers a point of " + tag.series);
      // names of lines and notes stand at lines on purpose
      const bool large = text.kind == Box::Kind::legend || text.kind == Box::Kind::inset;
      if (tag.kind == Tag::Kind::reference && large && crosses(tag, text.rect))
        return add(Fault::text_on_data, tag.panel, told(text) + " covers a line " + tag.series);
      if (tag.kind == Tag::Kind::contour && text.kind == Box::Kind::value && crosses(tag, text.rect))
        return add(Fault::text_on_data, tag.panel, told(text) + " covers the contour of " + tag.series);
      if (tag.kind == Tag::Kind::curve && crosses(tag, text.rect))
        return add(Fault::text_on_data, tag.panel, told(text) + " covers the curve of " + tag.series);
    }
  }

  bool crosses(const Tag& tag, const Rect& rect) const {
    for (std::size_t i = tag.first; i < tag.last; ++i) {
      const auto* path = path_of(layout_.list.items[i]);
      if (!path) continue;
      std::size_t next = 0;
      Point before{0, 0};
      for (const auto verb : path->verbs) {
        if (verb == Path::Verb::close) continue;
        if (verb == Path::Verb::cubic) {
          before = path->points[next + 2], next += 3;
          continue;
        }
        const Point at = path->points[next++];
        Point a = before, b = at;
        if (verb == Path::Verb::line && cut_segment(a, b, rect)) return true;
        before = at;
      }
    }
    return false;
  }

  void markers() {
    for (const auto& tag : layout_.list.tags) {
      if (tag.kind != Tag::Kind::marker && tag.kind != Tag::Kind::dots) continue;
      const auto frame = frames_.find(tag.panel);
      if (frame == frames_.end() || frame->second.contains(bounds(tag))) continue;
      const Rect mark = bounds(tag), &f = frame->second;
      const double over =
          std::max({f.left - mark.left, mark.right - f.right, f.top - mark.top, mark.bottom - f.bottom});
      add(Fault::marker_on_frame, tag.panel,
          fmt::format("{} of {}, {:.1f} points over it", tag.kind == Tag::Kind::dots ? "dots" : "a marker",
                      tag.series, over));
    }
  }

  /// Every point that the figure's data have is in the picture, or an arrow says where it is.
  void points() {
    for (std::size_t p = 0; p < figure_.panels.size(); ++p) {
      std::map<std::string, std::size_t> wanted, shown;
      for (const auto& s : figure_.panels[p].series) {
        if (s.kind != plot::Kind::markers && s.kind != plot::Kind::both && s.kind != plot::Kind::dots)
          continue;
        for (std::size_t i = 0; i < s.x.size(); ++i)
          if (std::isfinite(s.x[i]) && std::isfinite(s.y[i])) ++wanted[s.name];
      }
      for (const auto& tag : layout_.list.tags)
        if (tag.panel == static_cast<int>(p) &&
            (tag.kind == Tag::Kind::marker || tag.kind == Tag::Kind::dots || tag.kind == Tag::Kind::beyond))
          shown[tag.series] += tag.points;
      for (const auto& [series, count] : wanted)
        if (shown[series] != count)
          add(Fault::point_lost, static_cast<int>(p),
              fmt::format("{}: {} points, {} of them shown", series, count, shown[series]));
    }
  }

  /// Arrows say that a few lie elsewhere; where many do, the range is wrong.
  void outside() {
    constexpr double most = 0.5;
    for (std::size_t p = 0; p < figure_.panels.size(); ++p) {
      std::size_t inside = 0, beyond = 0;
      std::set<std::string> of_points;  // of histograms an arrow is a bin that is too high
      for (const auto& s : figure_.panels[p].series)
        if (s.kind == plot::Kind::markers || s.kind == plot::Kind::both || s.kind == plot::Kind::dots)
          of_points.insert(s.name);
      for (const auto& tag : layout_.list.tags) {
        if (tag.panel != static_cast<int>(p) || !of_points.count(tag.series)) continue;
        if (is_doubtful(tag.series)) continue;  // which may lie anywhere
        if (tag.kind == Tag::Kind::marker || tag.kind == Tag::Kind::dots) inside += tag.points;
        if (tag.kind == Tag::Kind::beyond) beyond += tag.points;
      }
      if (figure_.panels[p].map || static_cast<double>(beyond) <= most * static_cast<double>(inside + beyond))
        continue;
      add(Fault::mostly_outside, static_cast<int>(p),
          fmt::format("{} of {} points", beyond, inside + beyond));
    }
  }

  /// How a series is drawn, without its colour: the outlines of a marker about its middle, how they are painted, dashes.
  struct Drawn {
    std::string form;
    Color color;
  };
  std::map<std::string, Drawn> drawn_in(int panel) const {
    std::map<std::string, Drawn> all;
    for (const auto& tag : layout_.list.tags) {
      if (tag.panel != panel || tag.kind == Tag::Kind::sample || tag.kind == Tag::Kind::named ||
          tag.kind == Tag::Kind::beyond || tag.kind == Tag::Kind::reference || tag.kind == Tag::Kind::contour)
        continue;
      auto& drawn = all[tag.series];
      const Point middle = bounds(tag).centre();
      std::string form;
      for (std::size_t i = tag.first; i < tag.last; ++i) {
        const auto& item = layout_.list.items[i];
        if (const auto* fill = std::get_if<FillItem>(&item); fill && tag.kind == Tag::Kind::marker) {
          form += is_same(fill->color, layout_.list.background) ? " ground" : " filled";
          form += outline(fill->path, middle);
          if (!is_same(fill->color, layout_.list.background)) drawn.color = fill->color;
        }
        const bool on_its_way = tag.kind == Tag::Kind::curve && i > tag.first;  // a marker on a line
        if (on_its_way) {
          const auto* path = path_of(item);
          const std::string mark = path ? (std::get_if<FillItem>(&item) ? " filled" : " outline") +
                                              outline(*path, path->bounds().centre())
                                        : "";
          if (form.find(mark) == std::string::npos) form += mark;  // there are many of one shape
          continue;
        }
        if (const auto* stroke = std::get_if<StrokeItem>(&item)) {
          form += tag.kind == Tag::Kind::marker ? " outline" + outline(stroke->path, middle) : " line";
          for (const double d : stroke->stroke.dash) form += fmt::format(" {:.2f}", d);
          drawn.color = stroke->color;
        }
        if (const auto* dots = std::get_if<DotsItem>(&item)) {
          form += " dots" + outline(dots->shape, {0, 0});
          drawn.color = dots->color;
        }
      }
      if (drawn.form.find(form) == std::string::npos) drawn.form += "|" + form;
    }
    return all;
  }
  static std::string outline(const Path& path, const Point& middle) {
    std::string text;
    for (const auto& p : path.points)
      text += fmt::format(" {:.1f},{:.1f}", p.x() - middle.x(), p.y() - middle.y());
    return text;
  }

  void looks() {
    for (const auto& [panel, frame] : frames_) {
      std::set<std::string> named, unnamed;
      for (const auto& tag : layout_.list.tags)
        if (tag.panel == panel && tag.kind == Tag::Kind::named) named.insert(tag.series);
      // what the author keeps out of the legend is not to be told apart
      for (const auto& s : figure_.panels[static_cast<std::size_t>(panel)].series)
        if (s.label && s.label->empty()) unnamed.insert(s.name);
      const bool no_legend = figure_.legend == Legend::off ||
                             figure_.panels[static_cast<std::size_t>(panel)].legend == Place::off;
      if (no_legend) continue;
      const auto all = drawn_in(panel);
      for (auto a = all.begin(); a != all.end(); ++a)
        for (auto b = std::next(a); b != all.end(); ++b) {
          if (a->second.form != b->second.form || unnamed.count(a->first) || unnamed.count(b->first))
            continue;
          if (named.count(a->first) && named.count(b->first)) continue;
          add(is_same(a->second.color, b->second.color) ? Fault::alike : Fault::color_alone, panel,
              a->first + " and " + b->first);
        }
    }
  }

  void parameters() {
    for (std::size_t p = 0; p < figure_.panels.size(); ++p) {
      const auto& panel = figure_.panels[p];
      if (panel.title.empty() && panel.parameters.empty() && panel.notes.empty())
        add(Fault::no_parameters, static_cast<int>(p), "panel \"" + panel.label + "\"");
    }
  }
};

}  // namespace

const char* name(Finding::Kind kind) {
  static const char* names[] = {"text overlap", "text on data",   "marker on the frame",
                                "point lost",   "mostly outside", "colour alone",
                                "alike",        "no parameters"};
  return names[static_cast<int>(kind)];
}

std::vector<Finding> review(const Figure& figure, const Layout& layout) {
  return Referee(figure, layout).review();
}

}  // namespace chute::plot
