#pragma once
#include <optional>

#include "plot/scale.hpp"

namespace chute::plot {

/// Ticks of an axis of dates and times of day, told as seconds since the begin of 1970: at decimal parts of a second, full seconds,
/// minutes, hours, days, months or years, as many as fit. Labels leave out what all have in common, which stands where a factor
/// would. Nothing where the axis is so short that doubles of seconds cannot tell parts of it: about 2 µs in our days.
std::optional<Ticks> time_ticks(const Span& span, double length, double size, bool horizontal);

/// Axes of dates lie between these, the begin of the year 1 and the end of 9999.
struct Calendar {
  double first, last;
};
Calendar calendar();

}  // namespace chute::plot
