#pragma once
#include <optional>
#include <string_view>

namespace chute::read {

/// Without the blanks at both ends.
std::string_view trimmed(std::string_view text);

/// A number as programs write it: padded with blanks, with a sign, with a dot at its end, `nan` or `inf` in any of their
/// forms; beyond the range of doubles it becomes 0 or infinity. Nothing if it is no number as a whole.
std::optional<double> number_in(std::string_view text);

}  // namespace chute::read
