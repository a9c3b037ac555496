#pragma once
#include <string>
#include <string_view>

namespace chute::golden {

/// SHA-256 (FIPS 180-4) as 64 hexadecimal digits: tells whether a golden is still the file that was recorded.
std::string sha256(std::string_view bytes);

}  // namespace chute::golden
