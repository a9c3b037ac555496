#pragma once
#include <optional>
#include <string_view>

namespace chute {

/// "18 deg" or "0.3 rad" in radians; nothing if it is neither.
std::optional<double> parse_angle(std::string_view text);

}  // namespace chute
