#include "plot/axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/error.hpp"

namespace chute::plot {

void Margins::widen(const Margins& m) {
  left = std::max(left, m.left);
  right = std::max(right, m.right);
  top = std::max(top, m.top);
  const double rest = std::max(bottom - x_gap, m.bottom - m.x_gap);
  x_gap = std::max(x_gap, m.x_gap);
  bottom = x_gap + rest;
}

TextBox set_to_fit(const std::string& text, double size, double room) {
  if (text.empty()) return {};
  for (;; size -= 0.5) {
    auto box = set_text(text, std::max(size, smallest_type));
    if (box.width <= room) return box;
    if (size <= smallest_type)
      throw InputError(
          fmt::format("label \"{}\" is {:.0f} points long, its panel has room for {:.0f}: shorten it or make "
                      "the figure larger",
                      text, box.width, room));
  }
}

namespace {

/// Labels with and without accents or subscripts share a baseline: all are as tall as an accented letter at
/// least.
void stand_on_strut(TextBox& text, double size) {
  text.ascent = std::max(text.ascent, 0.85 * size);
  text.descent = std::max(text.descent, 0.3 * size);
}

}  // namespace

Axes::Axes(const Plot& plot, const Span& x, const Span& y, const TextSizes& sizes, bool show_x, bool show_y)
    : plot_(plot), x_(x), y_(y), sizes_(sizes), show_x_(show_x), show_y_(show_y) {}

Margins Axes::fit(double width, double height) {
  x_ticks_ = ticks_for(plot_.x, x_, width, sizes_.tick, true);
  y_ticks_ = ticks_for(plot_.y, y_, height, sizes_.tick, false);
  x_texts_.clear(), y_texts_.clear();
  tick_ascent_ = tick_descent_ = 0;
  Margins m;
  const double gap = sizes_.gap;
  above_ = 0;
  if (top_) fit_top(width, m);
  double below = 0;  // how far y tick labels reach below the frame
  if (show_y_)
    for (const auto& tick : y_ticks_.major) {
      const auto text = set_text(tick.label, sizes_.tick);
      below = std::max(below, (text.ascent + text.descent) / 2 - y_.fraction(tick.value) * height);
    }
  m.x_gap = show_x_ ? gap : 0;
  if (show_x_) {
    for (const auto& tick : x_ticks_.major) {
      const auto& text = x_texts_.emplace_back(set_text(tick.label, sizes_.tick));
      tick_ascent_ = std::max(tick_ascent_, text.ascent),
      tick_descent_ = std::max(tick_descent_, text.descent);
      const double at = x_.fraction(tick.value) * width;
      if (text.width / 2 - at > 0.5 * gap)
        m.x_gap = std::max(m.x_gap, below + 0.3 * gap);  // they meet at the corner
      m.left = std::max(m.left, text.width / 2 - at),
      m.right = std::max(m.right, at + text.width / 2 - width);
    }
    x_label_ = set_to_fit(plot_.x.label, sizes_.label, width + m.right);
    x_factor_ = x_ticks_.factor.empty() ? TextBox{} : set_text(x_ticks_.factor, sizes_.tick);
    m.bottom = m.x_gap + row();
    // the factor of the tick labels stands at the axis' end, on its label's line if there is room
    x_factor_below_ =
        !x_factor_.empty() && !x_label_.empty() && (width - x_label_.width) / 2 < x_factor_.width + 2 * gap;
    x_line_ = x_label_;
    if (!x_label_.empty()) stand_on_strut(x_line_, sizes_.label);
    if (!x_factor_.empty() && !x_factor_below_) {
      x_line_.ascent = std::max(x_line_.ascent, x_factor_.ascent);
      x_line_.descent = std::max(x_line_.descent, x_factor_.descent);
    }
    if (x_line_.ascent + x_line_.descent > 0) m.bottom += gap + x_line_.ascent + x_line_.descent;
    if (x_factor_below_) m.bottom += gap + x_factor_.ascent + x_factor_.descent;
  }
  if (show_y_) {
    double widest = 0;
    for (const auto& tick : y_ticks_.major) {
      const auto& text = y_texts_.emplace_back(set_text(tick.label, sizes_.tick));
      widest = std::max(widest, text.width);
      const double at = y_.fraction(tick.value) * height, half = (text.ascent + text.descent) / 2;
      m.top = std::max(m.top, at + half - height), m.bottom = std::max(m.bottom, half - at);
    }
    y_label_ = set_to_fit(plot_.y.label, sizes_.label, height);
    if (!y_label_.empty()) stand_on_strut(y_label_, sizes_.label);
    y_factor_ = y_ticks_.factor.empty() ? TextBox{} : set_text(y_ticks_.factor, sizes_.tick);
    m.left = std::max(m.left, gap + widest);
    if (!y_label_.empty())
      m.left = std::max(m.left, gap + widest + 1.3 * gap + y_label_.ascent + y_label_.descent);
    if (!y_factor_.empty()) m.top = std::max(m.top, above_ + gap + y_factor_.ascent + y_factor_.descent);
  }
  if (right_) fit_right(height, m);
  return m;
}

void Axes::fit_right(double height, Margins& m) {
  const double gap = sizes_.gap;
  right_ticks_ = ticks_for(*plot_.right, *right_, height, sizes_.tick, false);
  right_texts_.clear();
  right_widest_ = 0;
  for (const auto& tick : right_ticks_.major) {
    const auto& text = right_texts_.emplace_back(set_text(tick.label, sizes_.tick));
    right_widest_ = std::max(right_widest_, text.width);
    const double at = right_->fraction(tick.value) * height, half = (text.ascent + text.descent) / 2;
    m.top = std::max(m.top, at + half - height), m.bottom = std::max(m.bottom, half - at);
  }
  right_label_ = set_to_fit(plot_.right->label, sizes_.label, height);
  if (!right_label_.empty()) stand_on_strut(right_label_, sizes_.label);
  right_factor_ = right_ticks_.factor.empty() ? TextBox{} : set_text(right_ticks_.factor, sizes_.tick);
  m.right = std::max(m.right, gap + right_widest_);
  if (!right_label_.empty())
    m.right = std::max(m.right, gap + right_widest_ + 1.3 * gap + right_label_.ascent + right_label_.descent);
  if (!right_factor_.empty())
    m.top = std::max(m.top, above_ + gap + right_factor_.ascent + right_factor_.descent);
}

void Axes::draw_right(DisplayList& list, const Look& look, const Rect& frame, int panel, double shrink,
                      std::vector<Box>& boxes) const {
  const double gap = sizes_.gap;
  const Color color = right_color_.value_or(look.ink);
  Path ticks;
  const auto tick = [&](double value, double length) {
    const double y = frame.bottom - right_->fraction(value) * frame.height();
    if (y < frame.top - 0.01 || y > frame.bottom + 0.01) return;
    ticks.move({frame.right, y}).line({frame.right - length, y});
  };
  for (const auto& t : right_ticks_.major) tick(t.value, shrink * look.major_tick);
  for (const double v : right_ticks_.minor) tick(v, shrink * look.minor_tick);
  list.stroke(ticks, {look.hairline, {}, Cap::butt, Join::miter}, color);
  const auto put = [&](Box::Kind kind, const TextBox& text, Point at, int turns, const std::string& source) {
    draw_text(list, text, at, color, turns * std::numbers::pi / 2);
    boxes.push_back({kind, text.box_at(at, turns), panel, source});
  };
  for (std::size_t i = 0; i < right_texts_.size(); ++i) {
    const auto& text = right_texts_[i];
    const double y = frame.bottom - right_->fraction(right_ticks_.major[i].value) * frame.height();
    put(Box::Kind::tick_label, text, {frame.right + gap, y + (text.ascent - text.descent) / 2}, 0,
        right_ticks_.major[i].label);
  }
  if (!right_label_.empty())
    put(Box::Kind::axis_label, right_label_,
        {frame.right + gap + right_widest_ + 1.3 * gap + right_label_.ascent,
         frame.centre().y() + right_label_.width / 2},
        1, plot_.right->label);
  if (!right_factor_.empty())
    put(Box::Kind::factor, right_factor_,
        {frame.right - right_factor_.width, frame.top - above_ - gap - right_factor_.descent}, 0,
        right_ticks_.factor);
}

void Axes::fit_top(double width, Margins& m) {
  const double gap = sizes_.gap;
  top_ticks_ = ticks_for(*plot_.top, *top_, width, sizes_.tick, true);
  top_texts_.clear();
  top_ascent_ = top_descent_ = 0;
  for (const auto& tick : top_ticks_.major) {
    const auto& text = top_texts_.emplace_back(set_text(tick.label, sizes_.tick));
    top_ascent_ = std::max(top_ascent_, text.ascent), top_descent_ = std::max(top_descent_, text.descent);
    const double at = top_->fraction(tick.value) * width, half = text.width / 2;
    m.left = std::max(m.left, half - at), m.right = std::max(m.right, at + half - width);
  }
  top_label_ = set_to_fit(plot_.top->label, sizes_.label, width);
  if (!top_label_.empty()) stand_on_strut(top_label_, sizes_.label);
  top_factor_ = top_ticks_.factor.empty() ? TextBox{} : set_text(top_ticks_.factor, sizes_.tick);
  above_ = gap + top_ascent_ + top_descent_;
  if (!top_label_.empty()) above_ += gap + top_label_.ascent + top_label_.descent;
  if (!top_factor_.empty()) above_ += gap + top_factor_.ascent + top_factor_.descent;
  m.top = std::max(m.top, above_);
}

void Axes::draw_top(DisplayList& list, const Look& look, const Rect& frame, int panel, double shrink,
                    std::vector<Box>& boxes) const {
  const double gap = sizes_.gap;
  const Color color = top_color_.value_or(look.ink);
  Path ticks;
  const auto place = [&](double value) { return frame.left + top_->fraction(value) * frame.width(); };
  const auto tick = [&](double value, double length) {
    const double x = place(value);
    if (x < frame.left - 0.01 || x > frame.right + 0.01) return;
    ticks.move({x, frame.top}).line({x, frame.top + length});
  };
  for (const auto& t : top_ticks_.major) tick(t.value, shrink * look.major_tick);
  for (const double v : top_ticks_.minor) tick(v, shrink * look.minor_tick);
  list.stroke(ticks, {look.hairline, {}, Cap::butt, Join::miter}, color);
  const auto put = [&](Box::Kind kind, const TextBox& text, Point at, const std::string& source) {
    draw_text(list, text, at, color);
    boxes.push_back({kind, text.box_at(at), panel, source});
  };
  double y = frame.top - gap - top_descent_;
  for (std::size_t i = 0; i < top_texts_.size(); ++i)
    put(Box::Kind::tick_label, top_texts_[i], {place(top_ticks_.major[i].value) - top_texts_[i].width / 2, y},
        top_ticks_.major[i].label);
  y -= top_ascent_;
  if (!top_label_.empty()) {
    y -= gap + top_label_.descent;
    put(Box::Kind::axis_label, top_label_, {frame.centre().x() - top_label_.width / 2, y}, plot_.top->label);
    y -= top_label_.ascent;
  }
  if (!top_factor_.empty())
    put(Box::Kind::factor, top_factor_, {frame.right - top_factor_.width, y - gap - top_factor_.descent},
        top_ticks_.factor);
}

void Axes::draw(DisplayList& list, const Look& look, const Rect& frame, const Margins& common, int panel,
                std::vector<Box>& boxes) const {
  const double gap = sizes_.gap;
  Path ticks;
  const auto x_tick = [&](double value, double length) {
    const double x = frame.left + x_.fraction(value) * frame.width();
    if (x < frame.left - 0.01 || x > frame.right + 0.01) return;
    ticks.move({x, frame.bottom}).line({x, frame.bottom - length});
    if (!top_) ticks.move({x, frame.top}).line({x, frame.top + length});
  };
  const auto y_tick = [&](double value, double length) {
    const double y = frame.bottom - y_.fraction(value) * frame.height();
    if (y < frame.top - 0.01 || y > frame.bottom + 0.01) return;
    ticks.move({frame.left, y}).line({frame.left + length, y});
    if (!right_) ticks.move({frame.right, y}).line({frame.right - length, y});
  };
  const double shrink = std::min(1.0, sizes_.tick / look.tick_size);
  for (const auto& t : x_ticks_.major) x_tick(t.value, shrink * look.major_tick);
  for (double v : x_ticks_.minor) x_tick(v, shrink * look.minor_tick);
  for (const auto& t : y_ticks_.major) y_tick(t.value, shrink * look.major_tick);
  for (double v : y_ticks_.minor) y_tick(v, shrink * look.minor_tick);
  list.stroke(ticks, {look.hairline, {}, Cap::butt, Join::miter}, look.ink);
  Path outline;
  list.stroke(outline.rectangle(frame), {look.hairline, {}, Cap::butt, Join::miter}, look.ink);
  boxes.push_back({Box::Kind::frame, frame, panel, ""});
  if (right_) draw_right(list, look, frame, panel, shrink, boxes);
  if (top_) draw_top(list, look, frame, panel, shrink, boxes);

  const auto put = [&](Box::Kind kind, const TextBox& text, Point at, int turns, const std::string& source) {
    draw_text(list, text, at, look.ink, turns * std::numbers::pi / 2);
    boxes.push_back({kind, text.box_at(at, turns), panel, source});
  };
  if (show_x_) {
    double y = frame.bottom + common.x_gap + tick_ascent_;
    for (std::size_t i = 0; i < x_texts_.size(); ++i) {
      const double x =
          frame.left + x_.fraction(x_ticks_.major[i].value) * frame.width() - x_texts_[i].width / 2;
      put(Box::Kind::tick_label, x_texts_[i], {x, y}, 0, x_ticks_.major[i].label);
    }
    y += tick_descent_ + gap;
    if (!x_label_.empty()) {
      const double right_edge = frame.right + common.right;
      const double x = std::min(frame.centre().x() - x_label_.width / 2, right_edge - x_label_.width);
      put(Box::Kind::axis_label, x_label_, {x, y + x_line_.ascent}, 0, plot_.x.label);
    }
    if (!x_factor_.empty()) {
      const double baseline =
          x_factor_below_ ? x_line_.ascent + x_line_.descent + gap + x_factor_.ascent : x_line_.ascent;
      put(Box::Kind::factor, x_factor_, {frame.right - x_factor_.width, y + baseline}, 0, x_ticks_.factor);
    }
  }
  if (show_y_) {
    for (std::size_t i = 0; i < y_texts_.size(); ++i) {
      const auto& text = y_texts_[i];
      const double y = frame.bottom - y_.fraction(y_ticks_.major[i].value) * frame.height();
      put(Box::Kind::tick_label, text, {frame.left - gap - text.width, y + (text.ascent - text.descent) / 2},
          0, y_ticks_.major[i].label);
    }
    if (!y_label_.empty())
      put(Box::Kind::axis_label, y_label_,
          {frame.left - common.left + y_label_.ascent, frame.centre().y() + y_label_.width / 2}, 1,
          plot_.y.label);
    if (!y_factor_.empty())
      put(Box::Kind::factor, y_factor_, {frame.left, frame.top - above_ - gap - y_factor_.descent}, 0,
          y_ticks_.factor);
  }
}

}  // namespace chute::plot
