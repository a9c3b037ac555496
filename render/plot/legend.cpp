#include "plot/legend.hpp"

#include <algorithm>

namespace chute::plot {

std::string label_of_factor(const Figure& figure, const std::string& value) {
  for (const auto& [name, label] : figure.words)
    if (name == value) return label;
  return label_from_name(value);
}

bool LegendBlock::has(const std::string& name) const {
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.name == name; });
}

void LegendBlock::put(const std::string& name, Kind kind, const SeriesLook& look, const std::string& label) {
  if (label.empty() || has(name)) return;
  entries_.push_back({name, kind, look, set_text(label, look_->legend_size), label});
}

void LegendBlock::add(const Series& series) {
  const auto& ink = looks_->at(series.name);
  if (is_doubtful(series.name) && !series.label && series.kind != Kind::cells) {
    const auto word = series.name.substr(base_name(series.name).size() + 1);
    if (word == "apart")
      put(" " + word, Kind::markers, any_hollow(), "starts that part");
    else
      add_hollow();
    return;
  }
  put(series.name, series.kind, ink, series.label.value_or(label_from_name(series.name)));
}

SeriesLook LegendBlock::any_hollow() const {
  SeriesLook any;
  any.color = look_->ink, any.hollow = true;
  return any;
}

void LegendBlock::add_hollow() { put(" unsettled", Kind::markers, any_hollow(), "not settled"); }

void LegendBlock::add(const Figure& figure, const Factors& factors, const std::vector<const Series*>& series,
                      bool colors) {
  const auto any_of = [&](auto holds) -> const Series* {
    for (const auto* s : series) {
      const auto at = factors.of.find(is_doubtful(s->name) ? base_name(s->name) : s->name);
      if (at != factors.of.end() && holds(at->second, *s)) return s;
    }
    return nullptr;
  };
  for (std::size_t k = 0; colors && k < factors.colors.size(); ++k) {
    const auto is_this = [&](const Factors::Place& at) { return at.color == static_cast<int>(k); };
    const auto has_shape = [](const Series& s) { return s.kind == Kind::markers || s.kind == Kind::both; };
    const Series* s = any_of([&](auto& at, auto& of) { return is_this(at) && has_shape(of); });
    if (!s) s = any_of([&](auto& at, auto&) { return is_this(at); });
    if (!s) continue;
    SeriesLook ink = looks_->at(s->name);
    ink.fill = Fill::filled, ink.hollow = false, ink.dash = 0;
    put(factors.colors[k], has_shape(*s) ? Kind::markers : s->kind, ink,
        label_of_factor(figure, factors.colors[k]));
  }
  for (std::size_t k = 0; k < factors.styles.size(); ++k) {
    const Series* s = any_of([&](auto& at, auto&) { return at.style == static_cast<int>(k); });
    if (!s) continue;
    SeriesLook ink = looks_->at(s->name);
    ink.color = look_->ink, ink.marker = 0, ink.marked = false, ink.hollow = false;
    put(factors.styles[k], s->kind, ink, label_of_factor(figure, factors.styles[k]));
  }
  for (const auto* s : series)
    if (!factors.of.count(s->name)) add(*s);
}

double LegendBlock::sample() const {
  const bool only_points = std::all_of(entries_.begin(), entries_.end(), [](const Entry& e) {
    return e.kind == Kind::markers || e.kind == Kind::dots;
  });
  return (only_points ? 0.8 : 2.1) * look_->legend_size;
}

double LegendBlock::row_height() const {
  double height = 1.3 * look_->legend_size;
  for (const auto& e : entries_)
    height = std::max(height, e.text.ascent + e.text.descent + 0.2 * look_->legend_size);
  return height;
}

std::vector<double> LegendBlock::column_widths(int columns) const {
  std::vector<double> widths(static_cast<std::size_t>(columns), 0);
  const int n = rows(columns);
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    auto& width = widths[i / static_cast<std::size_t>(n)];  // down the columns
    width = std::max(width, sample() + gap() + entries_[i].text.width);
  }
  while (!widths.empty() && widths.back() == 0) widths.pop_back();
  return widths;
}

double LegendBlock::width(int columns) const {
  double sum = 0;
  const auto widths = column_widths(columns);
  for (double w : widths) sum += w;
  return sum + 2.5 * gap() * static_cast<double>(std::max<std::size_t>(1, widths.size()) - 1);
}

double LegendBlock::height(int columns) const { return rows(columns) * row_height(); }

int LegendBlock::columns_within(double room) const {
  int columns = static_cast<int>(entries_.size());
  while (columns > 1 && width(columns) > room) --columns;
  const int n = rows(columns);  // no more columns than that many rows need
  return (static_cast<int>(entries_.size()) + n - 1) / n;
}

void LegendBlock::draw(DisplayList& list, Point at, int columns, int panel, std::vector<Box>& boxes) const {
  const auto widths = column_widths(columns);
  const int n = rows(columns);
  double x = at.x();
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const auto column = i / static_cast<std::size_t>(n), row = i % static_cast<std::size_t>(n);
    if (row == 0 && column > 0) x += widths[column - 1] + 2.5 * gap();
    const double middle = at.y() + (static_cast<double>(row) + 0.5) * row_height();
    const auto& e = entries_[i];
    const std::size_t first = list.items.size();
    draw_sample(list, *look_, e.kind, e.look, {x, middle}, sample());
    list.tag(Tag::Kind::sample, panel, e.source, 0, first);
    // on a common baseline, the sample at the height of a small letter's middle
    draw_text(list, e.text, {x + sample() + gap(), middle + 0.24 * look_->legend_size}, look_->ink);
  }
  boxes.push_back(
      {Box::Kind::legend, {at.x(), at.y(), at.x() + width(columns), at.y() + height(columns)}, panel, ""});
}

}  // namespace chute::plot
