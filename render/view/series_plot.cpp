#include "view/series_plot.hpp"

#include <cmath>

#include "common/error.hpp"
#include "plot/draw.hpp"
#include "plot/extents.hpp"
#include "plot/layout.hpp"
#include "plot/placed.hpp"
#include "view/lay_over.hpp"

namespace chute::view {
namespace {

plot::Figure figure_of(const TimeSeries& series, const std::string& units, plot::Style style) {
  plot::Figure figure;
  figure.style = style;
  figure.legend = plot::Legend::each;
  auto& panel = figure.panels.emplace_back();
  panel.x.label = column_title(series.clock, units);
  panel.x.min = series.times.front(), panel.x.max = series.times.back();
  const bool alone = series.columns.size() == 1;
  if (alone) panel.title = column_title(series.columns[0].name, units);
  for (const auto& column : series.columns) {
    auto& s = panel.series.emplace_back();
    s.name = column.name, s.label = alone ? "" : column_title(column.name, units);
    s.kind = plot::Kind::line, s.faint = true;
    s.x = series.times, s.y = column.values;
  }
  // fixed here, so that the layout keeps it and the growing curves know it
  const auto y = plot::span_of(panel.y, plot::extents_of(panel).y);
  panel.y.min = y.low, panel.y.max = y.high;
  return figure;
}

}  // namespace

SeriesPlot::SeriesPlot(const TimeSeries& series, const std::string& units, Background background,
                       const plot::Rect& place, double em)
    : series_(series),
      place_{std::floor(place.left), std::floor(place.top), std::floor(place.right),
             std::floor(place.bottom)},
      figure_(figure_of(series, units,
                        background == Background::dark ? plot::Style::dark : plot::Style::journal)) {
  const auto& look = plot::look_of(figure_.style);
  scale_ = em / look.label_size;
  figure_.width = place_.width() / scale_ / plot::points_per_mm;
  figure_.height = place_.height() / scale_ / plot::points_per_mm;
  looks_ = plot::assign_looks(figure_, look);
  plot::Layout layout;
  try {
    layout = plot::lay_out(figure_);
  } catch (const InputError& error) {
    throw InputError(std::string("the picture is too small for a plot beside the grains: ") + error.what());
  }
  standing_ = std::move(layout.list);
  standing_.background.a = 0;
  const auto& panel = figure_.panels[0];
  frame_.x = {*panel.x.min, *panel.x.max, plot::Scale::linear};
  frame_.y = {*panel.y.min, *panel.y.max, plot::Scale::linear};
  for (const auto& box : layout.boxes)
    if (box.kind == plot::Box::Kind::frame) frame_.rect = box.rect;
}

void SeriesPlot::lay_over_place(image::Image& picture, const plot::DisplayList& list) const {
  lay_over(picture, plot::rasterise_by_cairo(list, 72 * scale_), static_cast<int>(place_.left),
           static_cast<int>(place_.top));
}

void SeriesPlot::stand(image::Image& picture) const { lay_over_place(picture, standing_); }

void SeriesPlot::put_on(image::Image& picture, double time) const {
  const auto list = curves_until(time);
  if (!list.items.empty()) lay_over_place(picture, list);
}

void SeriesPlot::add_to(plot::DisplayList& page, double time) const {
  for (const auto& list : {standing_, curves_until(time)})
    plot::place(page, list, scale_, {place_.left, place_.top});
}

plot::DisplayList SeriesPlot::curves_until(double time) const {
  const auto& look = plot::look_of(figure_.style);
  plot::DisplayList list;
  list.width = standing_.width, list.height = standing_.height;
  list.background = standing_.background;
  for (const auto& column : series_.columns) {
    const auto& ink = looks_.at(column.name);
    plot::Path curve;
    plot::Point last{plot::unknown, plot::unknown};
    bool joined = false;  // to the point before
    const auto go = [&](double t, double value) {
      last = frame_.at(t, value);
      if (std::isfinite(value)) joined ? curve.line(last) : curve.move(last);
      joined = std::isfinite(value);
    };
    for (std::size_t i = 0; i < series_.times.size() && series_.times[i] <= time; ++i) {
      go(series_.times[i], column.values[i]);
      if (i + 1 == series_.times.size() || series_.times[i + 1] <= time) continue;
      const double share = (time - series_.times[i]) / (series_.times[i + 1] - series_.times[i]);
      if (share > 0) go(time, column.values[i] + share * (column.values[i + 1] - column.values[i]));
    }
    if (curve.empty()) continue;
    list.stroke(curve,
                {1.3 * look.line_width, plot::dash_pattern(ink.dash, look.line_width), plot::Cap::butt,
                 plot::Join::round},
                ink.color);
    if (joined) list.fill(plot::Path().circle(last, 0.65 * look.marker_size), ink.color);
  }
  return list;
}

}  // namespace chute::view
