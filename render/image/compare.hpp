#pragma once
#include <cstddef>
#include <string>

#include "image/image.hpp"

namespace chute::image {

/// When two pictures count as the same. A channel may differ by `channel` (of 255): other processors round
/// the software renderer's arithmetic by at most 1. A share of the pixels may be allowed to exceed that, up to
/// `limit`. A gate on RMS or SSIM was measured to miss a radius changed by 1 %.
struct Tolerance {
  int channel = 2;
  double share = 0;  ///< share of pixels that may exceed `channel`
  int limit = 255;   ///< which none of those may exceed
};
inline constexpr Tolerance strict{};

struct Comparison {
  bool same_size = false;
  bool passes = false;
  int expected_width = 0, expected_height = 0, actual_width = 0, actual_height = 0;
  std::size_t pixels = 0;     ///< of the expected picture
  std::size_t differing = 0;  ///< pixels that differ at all
  std::size_t over = 0;       ///< pixels beyond the tolerance's `channel`
  int worst = 0;              ///< largest difference of a channel, of 255, and where (from the top left)
  int worst_x = 0, worst_y = 0;
  double rms = 0;   ///< root mean square over the channels, of 255
  double ssim = 1;  ///< mean structural similarity of the luminance, 8 x 8 blocks; a report, never a gate

  /// One line for people: the verdict and the numbers.
  std::string summary() const;
};

/// Compares decoded pixels, alpha included. Pictures of different sizes differ; nothing else is said about
/// them.
Comparison compare(const Image& expected, const Image& actual, Tolerance tolerance = strict);

/// What changed: gray where equal (the expected picture, faded), red where different, deeper with the
/// amplified difference. As large as both pictures together; what only one of them covers is red.
Image difference(const Image& expected, const Image& actual, double amplify = 16);

}  // namespace chute::image
