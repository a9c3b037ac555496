#include "view/furniture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plot/draw.hpp"
#include "plot/mathtext.hpp"
#include "plot/placed.hpp"
#include "plot/scale.hpp"
#include "view/lay_over.hpp"

namespace chute::view {
namespace {

using plot::Color;
using plot::DisplayList;
using plot::Path;
using plot::Point;
using plot::Rect;

constexpr double pixels = 72;   // dpi at which a point is a pixel
constexpr double small = 0.88;  // numbers on the bar, against the type's size

DisplayList blank(double width, double height) {
  DisplayList list;
  list.width = width, list.height = height;
  list.background = Color{1, 1, 1, 0};
  return list;
}

Path polygon(std::initializer_list<Point> points) {
  Path path;
  for (const Point& p : points) path.verbs.empty() ? path.move(p) : path.line(p);
  return path.close();
}

Path segment(Point a, Point b) { return Path().move(a).line(b); }

/// A line that ends in a slender head.
void draw_arrow(DisplayList& list, Point from, Point to, double width, double head, Color color) {
  const Point along = to - from;
  const double length = along.norm();
  if (length <= 0) return;
  const Point u = along / length, n = u.unitOrthogonal();
  head = std::min(head, 0.6 * length);
  const Point neck = to - head * u, bite = to - 0.8 * head * u;
  list.stroke(segment(from, bite), {width, {}, plot::Cap::butt, plot::Join::miter, 4}, color);
  list.fill(polygon({to, neck + (0.36 * head) * n, bite, neck - (0.36 * head) * n}), color);
}

Path arc(Point centre, double radius, double from, double to) {
  Path path;
  constexpr int steps = 24;
  for (int i = 0; i <= steps; ++i) {
    const double a = from + (to - from) * i / steps;
    const Point p{centre.x() + radius * std::cos(a), centre.y() + radius * std::sin(a)};
    i ? path.line(p) : path.move(p);
  }
  return path;
}

/// About five of them: a bar is read for its order of magnitude, not like an axis.
plot::Ticks bar_ticks(const Survey& survey, double length, double size, bool horizontal) {
  plot::Span span;
  span.low = survey.low, span.high = survey.high;
  return plot::ticks_for(span, std::min(length, 11 * size), size, horizontal);
}

std::string with_factor(const std::string& title, const plot::Ticks& ticks) {
  return ticks.factor.empty() ? title : title + " " + ticks.factor;
}

/// Degrees without digits that say nothing: 18, 14.4.
std::string degrees_text(double radians) {
  const double degrees = std::abs(radians) * 180 / std::numbers::pi;
  return fmt::format("{:g}", std::round(degrees * 10) / 10);
}

constexpr double patch = 0.85, patch_gap = 0.45;  // em: side of a kind's patch, and to its text
constexpr double kind_gap = 1.1;                  // em: from a text to the next patch beside it
constexpr double kind_line = 1.5;                 // em: from a row of patches to the next

}  // namespace

std::string time_text(const FrameStyle& style, const Survey& survey, double time) {
  time *= style.time_scale;
  if (const auto place = time_place(style.time)) {
    // A larger scale needs fewer digits to tell the frames apart.
    const int shift = static_cast<int>(std::floor(std::log10(style.time_scale) + 1e-9));
    auto text = style.time;
    text.replace(place->at, place->length,
                 fmt::format("{:.{}f}", time,
                             place->decimals.value_or(std::clamp(survey.time_decimals - shift, 0, 9))));
    return text;
  }
  const auto number = fmt::format("{:.{}f}", time, survey.time_decimals);
  if (!survey.clock.empty()) return fmt::format("{} {}", number, survey.clock);
  if (survey.units == "reduced") return fmt::format("$t = {}\\,\\sqrt{{d/g}}$", number);
  if (survey.units == "SI") return fmt::format("$t = {}\\,\\mathrm{{s}}$", number);
  return fmt::format("$t = {}$", number);
}

double plain_below(double largest) {
  const double unit = std::pow(10, std::floor(std::log10(largest)));
  double plain = unit;
  for (const double times : {1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (times * unit <= largest * (1 + 1e-9)) plain = times * unit;
  return plain;
}

double plain_length(double longest) {
  const double unit = std::pow(10, std::floor(std::log10(longest)));
  const double times = longest / unit;
  return unit * (times >= 5 ? 5 : times >= 2 ? 2 : 1);
}

std::string length_text(double length, const std::string& units) {
  if (units == "reduced") return length == 1 ? "$d$" : fmt::format("${:g}\\,d$", length);
  if (units != "SI") return fmt::format("{:g}", length);
  struct Unit {
    double metres;
    const char* name;
  };
  for (const Unit unit : {Unit{1, "m"}, Unit{1e-2, "cm"}, Unit{1e-3, "mm"}, Unit{1e-6, "\\mu m"}})
    if (length >= 0.999 * unit.metres) {
      const double times = std::round(length / unit.metres * 1e6) / 1e6;
      if (unit.metres == 1e-6) return fmt::format("${:g}\\,\\mu\\mathrm{{m}}$", times);
      return fmt::format("{:g} {}", times, unit.name);
    }
  return fmt::format("{:g} m", length);
}

Furniture::Furniture(const Studio& studio, double aspect)
    : studio_(studio),
      style_(studio.style),
      survey_(studio.survey),
      palette_(studio.palette),
      title_(survey_.field.title(survey_.units)) {
  double title = 0, labels = 0, kinds = 0;
  if (survey_.field.has_bar()) {
    constexpr double size = 100;  // any: widths in em are asked for
    const auto measure = [&](const std::string& label) {
      labels = std::max(labels, plot::set_text(label, small * size).width / size);
    };
    plot::Ticks ticks;
    if (survey_.categories.empty()) ticks = bar_ticks(survey_, 12 * size, small * size, false);
    for (const auto& tick : ticks.major) measure(tick.label);
    title = plot::set_text(with_factor(title_, ticks), size).width / size;
    for (const auto& label : kind_labels())
      measure(label),
          kinds += plot::set_text(label, small * size).width / size + patch + patch_gap + kind_gap;
  }
  places_ =
      arrange(style_, survey_, aspect, {title, labels, kinds, static_cast<double>(kind_labels().size())});
  if (places_.has_plot)
    plot_.emplace(survey_.series, survey_.units, style_.background, places_.plot, places_.em);
}

std::vector<std::string> Furniture::kind_labels() const {
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < survey_.categories.size(); ++i)
    labels.push_back(survey_.kind_names.empty() ? fmt::format("${}$", survey_.categories[i])
                                                : escaped(survey_.kind_names[i]));
  if (survey_.other_kinds) labels.emplace_back("others");
  return labels;
}

/// A patch of each kind's colour with its name or number: from the top of the bar's place downwards, or in rows from its left end.
void Furniture::draw_kinds(DisplayList& list) const {
  const bool upright = places_.upright_bar;
  const auto labels = kind_labels();
  const double em = places_.em,
               step = std::min(1.7 * em, places_.bar.height() / static_cast<double>(labels.size()));
  // where a small picture has no room, the texts are small, too, but do not touch
  const double size = upright ? std::min(small * em, 0.85 * step) : small * em;
  const double side = upright ? std::min(patch * em, 0.8 * step) : patch * em;
  Point corner{places_.bar.left, places_.bar.top};
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto text = plot::set_text(labels[i], size);
    const double width = side + patch_gap * em + text.width;
    if (!upright && corner.x() > places_.bar.left && corner.x() + width > places_.bar.right)
      corner = {places_.bar.left, corner.y() + kind_line * em};
    const Rgb c =
        i < survey_.categories.size() ? studio_.kind_color(static_cast<std::ptrdiff_t>(i)) : palette_.quiet;
    list.fill(Path().rectangle({corner.x(), corner.y(), corner.x() + side, corner.y() + side}),
              {c.r, c.g, c.b, 1});
    plot::draw_text(list, text, corner + Point(side + patch_gap * em, 0.5 * side + 0.33 * size), ink());
    corner += upright ? Point(0, step) : Point(width + kind_gap * em, 0);
  }
  plot::draw_text(list, plot::set_text(title_, em), places_.title, ink());
}

void Furniture::draw_bar(DisplayList& list) const {
  const double em = places_.em;
  const Rect& bar = places_.bar;
  const bool upright = places_.upright_bar;
  const double length = upright ? bar.height() : bar.width();
  // a step per pixel, each a little over the next so that no seam shows
  const int steps = std::max(2, static_cast<int>(std::lround(length)));
  for (int i = 0; i < steps; ++i) {
    const Rgb c = studio_.map.at((i + 0.5) / steps);
    const double a = length * i / steps, b = std::min(length, length * (i + 1) / steps + 1);
    const Rect slice = upright ? Rect{bar.left, bar.bottom - b, bar.right, bar.bottom - a}
                               : Rect{bar.left + a, bar.top, bar.left + b, bar.bottom};
    list.fill(Path().rectangle(slice), {c.r, c.g, c.b, 1});
  }
  // pointed ends: there are values beyond
  const auto point_at = [&](bool high) {
    const Rgb c = studio_.map.at(high ? 1 : 0);
    const double reach = 0.55 * em, sign = high ? 1 : -1;
    const Point tip = upright ? Point{bar.centre().x(), (high ? bar.top : bar.bottom) - sign * reach}
                              : Point{(high ? bar.right : bar.left) + sign * reach, bar.centre().y()};
    const Point a =
        upright ? Point{bar.left, high ? bar.top : bar.bottom} : Point{high ? bar.right : bar.left, bar.top};
    const Point b = upright ? Point{bar.right, a.y()} : Point{a.x(), bar.bottom};
    list.fill(polygon({a, tip, b}), {c.r, c.g, c.b, 1});
  };
  if (survey_.exceeds_high) point_at(true);
  if (survey_.exceeds_low) point_at(false);

  const double size = small * em, tick_length = 0.26 * em, hairline = std::max(1.0, 0.045 * em);
  const auto ticks = bar_ticks(survey_, length, size, !upright);
  for (const auto& tick : ticks.major) {
    const double at = length * plot::Span{survey_.low, survey_.high}.fraction(tick.value);
    const auto text = plot::set_text(tick.label, size);
    if (upright) {
      const double y = bar.bottom - at;
      list.stroke(segment({bar.right, y}, {bar.right + tick_length, y}), {hairline, {}}, ink());
      plot::draw_text(list, text, {bar.right + 0.45 * em, y + 0.33 * size}, ink());
    } else {
      const double x = bar.left + at;
      list.stroke(segment({x, bar.bottom}, {x, bar.bottom + tick_length}), {hairline, {}}, ink());
      plot::draw_text(list, text, {x - text.width / 2, bar.bottom + tick_length + 0.95 * size}, ink());
    }
  }
  plot::draw_text(list, plot::set_text(with_factor(title_, ticks), em), places_.title, ink());
}

ScaleBar Furniture::flat_scale(double pixels_per_unit) const {
  ScaleBar scale;
  scale.length = plain_length(longest_scale(places_.scene, places_.em) / pixels_per_unit);
  scale.from = places_.scale,
  scale.to = {places_.scale.x() + scale.length * pixels_per_unit, places_.scale.y()};
  return scale;
}

/// A bar along an edge of the grains may run out of a narrow picture: it is moved back into it, with its label.
ScaleBar Furniture::kept_inside(ScaleBar scale) const {
  const double em = places_.em, margin = 0.6 * em;
  const auto label = plot::set_text(length_text(scale.length, survey_.units), small * em);
  Rect bounds{std::min(scale.from.x(), scale.to.x()), std::min(scale.from.y(), scale.to.y()),
              std::max(scale.from.x(), scale.to.x()), std::max(scale.from.y(), scale.to.y())};
  const double beside = scale.label_below ? std::max(0.0, label.width - bounds.width()) / 2 : 0;
  bounds.left -= beside + margin, bounds.right += beside + margin;
  bounds.top -= margin, bounds.bottom += margin + (scale.label_below ? 1.6 * em : 0);
  Point shift{0, 0};
  if (bounds.right > style_.width) shift.x() = style_.width - bounds.right;
  if (bounds.left + shift.x() < 0) shift.x() = -bounds.left;
  if (bounds.bottom > style_.height) shift.y() = style_.height - bounds.bottom;
  if (bounds.top + shift.y() < 0) shift.y() = -bounds.top;
  scale.from += shift, scale.to += shift;
  return scale;
}

void Furniture::draw_scale(DisplayList& list, const ScaleBar& scale) const {
  const double em = places_.em, width = std::max(1.5, 0.1 * em), end = 0.26 * em;
  const Point along = scale.to - scale.from;
  const double length = along.norm();
  if (!(length > 0)) return;
  const Point u = along / length, across = u.unitOrthogonal();  // downwards if the bar runs to the right
  for (const Point& p : {scale.from, scale.to})
    list.stroke(segment(p - end * across, p + end * across), {width, {}}, ink());
  list.stroke(segment(scale.from, scale.to), {width, {}}, ink());
  const auto text = plot::set_text(length_text(scale.length, survey_.units), small * em);
  const Point middle = 0.5 * (scale.from + scale.to) + ((0.75 + 0.35 * std::abs(across.x())) * em) * across;
  const Point at = scale.label_below
                       ? Point{middle.x() - (0.5 + 0.5 * u.y()) * text.width, middle.y() + 0.5 * em}
                       : Point{scale.to.x() + 0.5 * em, scale.to.y() + 0.3 * small * em};
  plot::draw_text(list, text, at, ink());
}

/// An arrow of a plain speed near the largest, and a chain of a plain force near the largest, to read the others by.
void Furniture::draw_key(DisplayList& list, double arrow_pixels, double chain_pixels) const {
  const double em = places_.em;
  std::vector<Key> keys;
  if (style_.arrows && survey_.speed > 0) keys.push_back(speed_key(arrow_pixels));
  if (style_.chains && survey_.force > 0) keys.push_back(force_key(chain_pixels));
  std::vector<double> widths;
  for (const Key& key : keys) widths.push_back(key.width(em));
  double time = 0;
  if (places_.has_time)
    for (const double t : {survey_.times.front(), survey_.times.back()})
      time = std::max(time, plot::set_text(time_text(style_, survey_, t), em).width);
  const double top = style_.title.empty() ? 0 : places_.headline.y() + 0.4 * em;
  const auto ends = key_places(places_, widths, time, top);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (!ends[i]) continue;
    const Key& key = keys[i];
    const Point at{ends[i]->x() - key.text.width, ends[i]->y()},
        to{at.x() - 0.5 * em, at.y() - 0.3 * small * em}, from{to.x() - key.length, to.y()};
    const Rgb c = key.color;
    if (key.is_arrow)
      draw_arrow(list, from, to, key.thickness, 0.55 * em, ink());
    else
      list.stroke(segment(from, to), {key.thickness, {}}, {c.r, c.g, c.b, 1});
    plot::draw_text(list, key.text, at, ink());
  }
}

Furniture::Key Furniture::force_key(double chain_pixels) const {
  // a chain that would be thicker than the line of text is no key: a weaker one is shown then
  constexpr double thickest = 1.1;  // em
  const double em = places_.em,
               force = plain_below(survey_.force * std::min(1.0, thickest * em / chain_pixels));
  // m times g, not milligrams
  const auto unit = survey_.units == "reduced" ? fmt::format("$F_n = {:g}\\,m\\,g$", force)
                    : survey_.units == "SI"    ? fmt::format("$F_n = {:g}\\,\\mathrm{{N}}$", force)
                                               : fmt::format("$F_n = {:g}$", force);
  return {2 * em, std::max(0.5, chain_pixels * force / survey_.force), false,
          plot::set_text(unit, small * em), studio_.chain_color(force)};
}

Furniture::Key Furniture::speed_key(double arrow_pixels) const {
  const double em = places_.em;
  const double speed = plain_below(std::min(survey_.speed, 8 * em / arrow_pixels));
  const auto unit = survey_.units == "reduced" ? fmt::format("$v = {:g}\\,\\sqrt{{gd}}$", speed)
                    : survey_.units == "SI"    ? fmt::format("$v = {:g}\\,\\mathrm{{m/s}}$", speed)
                                               : fmt::format("$v = {:g}$", speed);
  return {speed * arrow_pixels, std::max(1.5, 0.085 * em), true, plot::set_text(unit, small * em),
          palette_.ink};
}

void Furniture::draw_gravity(DisplayList& list, const Directions& directions) const {
  const double em = places_.em, size = small * em, line = std::max(1.2, 0.075 * em);
  const Rect& box = places_.gravity;
  const bool solid = survey_.dimensions == 3;
  const double reach = (solid ? 1.75 : 2.7) * em;
  // the foot of the arrows; they point down, a little to one side
  const Point foot = solid ? Point{box.left + 1.75 * em, box.top + 1.75 * em}
                           : Point{box.left + 1.15 * em, box.top + 0.5 * em};
  if (solid) {
    constexpr const char* names[] = {"$x$", "$y$", "$z$"};
    for (std::size_t c = 0; c < 3; ++c) {
      const Point axis = directions.axes.col(static_cast<Eigen::Index>(c));
      const double seen = axis.norm();
      if (seen < 0.12) continue;  // it points at the eye
      const Point tip = foot + (1.4 * em) * axis;
      list.stroke(segment(foot, tip), {line * 0.8, {}}, quiet());
      const auto name = plot::set_text(names[c], size);
      const Point at = tip + (0.5 * em / seen) * axis;
      plot::draw_text(list, name, {at.x() - name.width / 2, at.y() + 0.27 * size}, quiet());
    }
  } else {
    const Point n = directions.normal, tip = foot + reach * n;
    list.stroke(segment(foot, tip), {line * 0.7, {0.28 * em, 0.2 * em}}, quiet());
    const Point along = n.unitOrthogonal();
    list.stroke(segment(tip - (0.6 * em) * along, tip + (0.6 * em) * along), {line * 0.7, {}}, quiet());
    const double from = std::atan2(n.y(), n.x()),
                 to = std::atan2(directions.gravity.y(), directions.gravity.x());
    if (std::abs(to - from) > 0.12) list.stroke(arc(foot, 1.4 * em, from, to), {line * 0.7, {}}, ink());
  }
  const Point g = directions.gravity, tip = foot + reach * g;
  draw_arrow(list, foot, tip, line, 0.6 * em, ink());
  const auto name = plot::set_text("$g$", em);
  // in space the axes are to the right of the arrow
  plot::draw_text(list, name, {solid ? tip.x() - 0.45 * em - name.width : tip.x() + 0.45 * em, tip.y()},
                  ink());
  const auto angle = plot::set_text(fmt::format("$\\theta = {}\\degree$", degrees_text(survey_.slope)), size);
  plot::draw_text(list, angle, {box.left, box.bottom - 0.25 * em}, ink());
}

/// Larger than the rest, and smaller again where it would be wider than the picture.
void Furniture::draw_headline(DisplayList& list) const {
  constexpr double larger = 1.25, widest = 0.96;
  double size = larger * places_.em;
  auto text = plot::set_text(style_.title, size);
  if (text.width > widest * style_.width) {
    size *= widest * style_.width / text.width;
    text = plot::set_text(style_.title, size);
  }
  plot::draw_text(list, text, places_.headline - Point{text.width / 2, 0}, ink());
}

void Furniture::stand(const ScaleBar& scale, const Directions& directions, double arrow_pixels,
                      double chain_pixels) {
  auto list = blank(style_.width, style_.height);
  if (!style_.title.empty()) draw_headline(list);
  if (places_.has_bar) survey_.categories.empty() ? draw_bar(list) : draw_kinds(list);
  if (places_.has_scale) draw_scale(list, kept_inside(scale));
  if (places_.has_key) draw_key(list, arrow_pixels, chain_pixels);
  if (places_.has_gravity) draw_gravity(list, directions);
  standing_ = plot::rasterise_by_cairo(list, pixels);
  standing_list_ = std::move(list);
  if (plot_) plot_->stand(standing_);
}

void Furniture::put_on(image::Image& frame, double time) const {
  if (!style_.furniture) return;
  lay_over(frame, standing_);
  if (plot_) plot_->put_on(frame, time);
  if (!places_.has_time) return;
  const auto text = plot::set_text(time_text(style_, survey_, time), places_.em);
  const double above = std::ceil(1.5 * places_.em), below = std::ceil(0.6 * places_.em);
  const Point whole{std::floor(places_.time.x()), std::floor(places_.time.y())};
  auto list = blank(std::ceil(text.width + places_.em), above + below);
  plot::draw_text(list, text, {places_.time.x() - whole.x(), above + places_.time.y() - whole.y()}, ink());
  lay_over(frame, plot::rasterise_by_cairo(list, pixels), static_cast<int>(whole.x()),
           static_cast<int>(whole.y() - above));
}

void Furniture::add_to(plot::DisplayList& page, double time) const {
  if (!style_.furniture) return;
  plot::place(page, standing_list_, 1, {0, 0});
  if (plot_) plot_->add_to(page, time);
  if (places_.has_time)
    plot::draw_text(page, plot::set_text(time_text(style_, survey_, time), places_.em), places_.time, ink());
}

}  // namespace chute::view
