#pragma once
#include <string>
#include <string_view>

namespace chute {

/// Bytes as text of 64 letters (RFC 4648, with padding), as data: addresses hold them.
std::string base64(std::string_view bytes);

}  // namespace chute
