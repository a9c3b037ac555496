#pragma once
#include "image/image.hpp"
#include "plot/marks.hpp"
#include "view/frame_style.hpp"
#include "view/time_series.hpp"

namespace chute::view {

/// The plot of a time series beside the grains: the whole curve stands there faintly, and is drawn strongly
/// up to the frame's time, which a dot marks.
class SeriesPlot {
 public:
  /// Fills `place` (pixels of the frame); `em` is the size of the frame's type. InputError if the place is
  /// too small for axes and their labels.
  SeriesPlot(const TimeSeries& series, const std::string& units, Background background,
             const plot::Rect& place, double em);

  /// Axes, texts and the faint curves: the same in every frame.
  void stand(image::Image& picture) const;
  /// The curves up to `time`.
  void put_on(image::Image& frame, double time) const;
  /// Both on a page whose unit is a pixel.
  void add_to(plot::DisplayList& page, double time) const;

 private:
  const TimeSeries& series_;
  plot::Rect place_;
  double scale_;  ///< pixels per point
  plot::Figure figure_;
  std::map<std::string, plot::SeriesLook> looks_;
  plot::DisplayList standing_;
  plot::Frame frame_;

  plot::DisplayList curves_until(double time) const;
  void lay_over_place(image::Image& picture, const plot::DisplayList& list) const;
};

}  // namespace chute::view
