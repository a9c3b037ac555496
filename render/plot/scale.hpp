#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "plot/figure.hpp"
#include "plot/mathtext.hpp"

/// Axes as numbers: ranges, ticks and their labels.
namespace chute::plot {

/// Range of an axis, ready to map: low < high, both > 0 on a log axis.
struct Span {
  double low = 0, high = 1;
  Scale scale = Scale::linear;
  /// Limits that were given: what lies beyond them is outside, although the range may reach a little farther for markers.
  double low_limit = -std::numeric_limits<double>::infinity(),
         high_limit = std::numeric_limits<double>::infinity();

  /// 0 at low, 1 at high; NaN for what a log axis cannot show.
  double fraction(double value) const;
  /// The value there: the other way round.
  double at(double fraction) const;
};

/// What the data of an axis ask for.
struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  /// Of the markers alone, and of markers and dots: at the frame they need room.
  double marker_low = low, marker_high = -low, dot_low = low, dot_high = -low;
  bool from_zero = false;  ///< a histogram: bars stand on zero
  bool keep_off = false;   ///< y: lines must not run along the frame either

  enum class Mark : std::uint8_t { none, dot, marker };
  void include(double value, Scale scale, Mark mark = Mark::none);
  void include(const Extent& other);
};

/// The given limits, moved out a little where a marker or dot within them would be cut; the data's with a little room where
/// none are given. InputError `axis: …` if the limits
/// are the wrong way round or a log axis is asked to show numbers <= 0.
Span span_of(const Axis& axis, const Extent& extent);

struct Tick {
  double value = 0;
  std::string label;  ///< text for mathtext; empty for a minor tick
};

struct Ticks {
  std::vector<Tick> major;
  std::vector<double> minor;
  std::string factor;  ///< "$\\times10^{-3}$" where the labels are to be multiplied by it, else empty
};

/// Numbers as texts, with as many decimals as tell them apart to some percent of their distances; over powers of ten where they
/// are large or tiny.
std::vector<std::string> value_texts(const std::vector<double>& values);

/// Ticks for an axis `length` points long. Labels (set at `size` points) neither touch nor crowd: along x
/// their widths count, along y their heights. One axis, one number of decimals.
Ticks ticks_for(const Span& span, double length, double size, bool horizontal);
/// The same, or the axis' names where it has some. InputError if these do not fit side by side.
Ticks ticks_for(const Axis& axis, const Span& span, double length, double size, bool horizontal);

}  // namespace chute::plot
