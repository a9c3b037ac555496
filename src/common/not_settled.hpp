#pragma once
#include <string_view>

namespace chute {

/// How tables of averages that were to begin with a steady state begin to say that there was none; figures look for it.
inline constexpr std::string_view not_settled = "no steady state was found";

}  // namespace chute
