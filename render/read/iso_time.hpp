#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace chute::read {

/// A date, or a date and time of day, after ISO 8601: `2026-03-07`, `2026-03-07T14:05`, `2026-03-07 14:05:09.25`, with `Z` or
/// an offset such as `+01:00` at its end. Seconds since the begin of 1970 in universal time, which is also taken where nothing
/// is said. A leap second, 23:59:60 to 60.99 of universal time, is the begin of the next day, as on computers' clocks. Nothing if the
/// text is something else, or a day or a time that does not exist.
std::optional<double> iso_time(std::string_view text);

/// The same time as text, in universal time and to a microsecond: a date alone at midnight. Years 0 to 9999; what is none of these becomes nothing.
std::string iso_text(double seconds);

}  // namespace chute::read
