#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace chute::fields {

/// Field data of files with grains of a scene with [[material]]: the names of materials in the order of their numbers, with commas
/// between.
inline constexpr std::string_view materials = "materials";

inline std::vector<std::string> names_in(std::string_view text) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= text.size();) {
    const auto end = std::min(text.find(',', begin), text.size());
    names.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return names;
}

}  // namespace chute::fields
