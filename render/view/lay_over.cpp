#include "view/lay_over.hpp"

#include <algorithm>
#include <cstdint>

namespace chute::view {

void divide_by_alpha(image::Image& picture) {
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    const unsigned alpha = picture.rgba[i + 3];
    if (alpha == 0 || alpha == 255) continue;
    for (std::size_t c = 0; c < 3; ++c)
      picture.rgba[i + c] =
          static_cast<std::uint8_t>(std::min(255u, (picture.rgba[i + c] * 255u + alpha / 2) / alpha));
  }
}

void lay_over(image::Image& bottom, const image::Image& top, int left, int above) {
  for (int y = std::max(0, -above); y < top.height && y + above < bottom.height; ++y)
    for (int x = std::max(0, -left); x < top.width && x + left < bottom.width; ++x) {
      const std::uint8_t* s = top.pixel(x, y);
      if (s[3] == 0) continue;
      std::uint8_t* d = bottom.pixel(x + left, y + above);
      const int a = s[3], rest = d[3] * (255 - a), sum = 255 * a + rest;  // alphas times 255
      for (int c = 0; c < 3; ++c)
        d[c] = static_cast<std::uint8_t>((255 * a * s[c] + rest * d[c] + sum / 2) / sum);
      d[3] = static_cast<std::uint8_t>((sum + 127) / 255);
    }
}

}  // namespace chute::view
