#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace chute::image {

/// Pixels: red, green, blue, alpha, 8 bits each, alpha not multiplied in; rows from the top, no padding, so
/// `rgba.size() == 4 * width * height`.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;

  Image() = default;
  /// A picture of one colour, opaque white unless said otherwise.
  Image(int w, int h, std::uint8_t value = 255)
      : width(w), height(h), rgba(4 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value) {}

  std::size_t offset(int x, int y) const {
    return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
  std::uint8_t* pixel(int x, int y) { return rgba.data() + offset(x, y); }
  const std::uint8_t* pixel(int x, int y) const { return rgba.data() + offset(x, y); }

  bool operator==(const Image&) const = default;
};

/// Nothing was drawn: no pixels, or all of one colour.
inline bool is_blank(const Image& image) {
  for (std::size_t i = 4; i < image.rgba.size(); ++i)
    if (image.rgba[i] != image.rgba[i - 4]) return false;
  return true;
}

}  // namespace chute::image
