#include "plot/legend.hpp"

#include <algorithm>

namespace chute::plot {

void LegendBlock::add(const Series& series) {
  for (const auto& e : entries_)
    if (e.series->name == series.name) return;
  const auto source = series.label.value_or(label_from_name(series.name));
  if (source.empty()) return;
  entries_.push_back({&series, set_text(source, look_->legend_size), source});
}

double LegendBlock::sample() const {
  const bool only_points = std::all_of(entries_.begin(), entries_.end(), [](const Entry& e) {
    return e.series->kind == Kind::markers || e.series->kind == Kind::dots;
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
    draw_sample(list, *look_, *e.series, looks_->at(e.series->name), {x, middle}, sample());
    // on a common baseline, the sample at the height of a small letter's middle
    draw_text(list, e.text, {x + sample() + gap(), middle + 0.24 * look_->legend_size}, look_->ink);
  }
  boxes.push_back(
      {Box::Kind::legend, {at.x(), at.y(), at.x() + width(columns), at.y() + height(columns)}, panel, ""});
}

}  // namespace chute::plot
