#include "common/angle.hpp"

#include <charconv>
#include <cmath>
#include <numbers>

namespace chute {

std::optional<double> parse_angle(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  if (error != std::errc{} || !std::isfinite(value)) return {};
  if (unit == "deg") return value * std::numbers::pi / 180;
  if (unit == "rad") return value;
  return {};
}

}  // namespace chute
