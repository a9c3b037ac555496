#include "image/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace chute::image {
namespace {

double luminance(const std::uint8_t* p) { return 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]; }

/// Structural similarity (Wang et al. 2004) with uniform windows of 8 x 8 pixels that overlap by half.
double similarity(const Image& a, const Image& b) {
  constexpr int window = 8, step = 4;
  constexpr double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255;
  double sum = 0;
  std::size_t windows = 0;
  for (int y0 = 0; y0 < std::max(1, a.height - window + 1); y0 += step)
    for (int x0 = 0; x0 < std::max(1, a.width - window + 1); x0 += step) {
      double n = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
      for (int y = y0; y < std::min(y0 + window, a.height); ++y)
        for (int x = x0; x < std::min(x0 + window, a.width); ++x) {
          const double la = luminance(a.pixel(x, y)), lb = luminance(b.pixel(x, y));
          n += 1, sa += la, sb += lb, saa += la * la, sbb += lb * lb, sab += la * lb;
        }
      const double ma = sa / n, mb = sb / n;
      const double va = saa / n - ma * ma, vb = sbb / n - mb * mb, cov = sab / n - ma * mb;
      sum += (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
      ++windows;
    }
  return windows ? sum / static_cast<double>(windows) : 1;
}

int pixel_difference(const std::uint8_t* a, const std::uint8_t* b) {
  int worst = 0;
  for (int c = 0; c < 4; ++c) worst = std::max(worst, std::abs(int(a[c]) - int(b[c])));
  return worst;
}

}  // namespace

std::string Comparison::summary() const {
  if (!same_size)
    return fmt::format("different sizes: expected {} x {}, got {} x {}", expected_width, expected_height,
                       actual_width, actual_height);
  return fmt::format(
      "{}: {} of {} pixels differ, {} beyond the tolerance, "
      "worst {}/255 at ({}, {}), RMS {:.4f}, SSIM {:.6f}",
      passes ? "same" : "different", differing, pixels, over, worst, worst_x, worst_y, rms, ssim);
}

Comparison compare(const Image& expected, const Image& actual, Tolerance tolerance) {
  Comparison result;
  result.expected_width = expected.width, result.expected_height = expected.height;
  result.actual_width = actual.width, result.actual_height = actual.height;
  result.pixels = expected.rgba.size() / 4;
  result.same_size = expected.width == actual.width && expected.height == actual.height;
  if (!result.same_size) return result;
  double squares = 0;
  for (int y = 0; y < expected.height; ++y)
    for (int x = 0; x < expected.width; ++x) {
      const auto *e = expected.pixel(x, y), *a = actual.pixel(x, y);
      const int d = pixel_difference(e, a);
      if (d == 0) continue;
      ++result.differing;
      if (d > tolerance.channel) ++result.over;
      if (d > result.worst) result.worst = d, result.worst_x = x, result.worst_y = y;
      for (int c = 0; c < 4; ++c) squares += (double(e[c]) - a[c]) * (double(e[c]) - a[c]);
    }
  if (result.differing) {
    result.rms = std::sqrt(squares / static_cast<double>(expected.rgba.size()));
    result.ssim = similarity(expected, actual);
  }
  result.passes = result.over == 0 ||
                  (static_cast<double>(result.over) <= tolerance.share * static_cast<double>(result.pixels) &&
                   result.worst <= tolerance.limit);
  return result;
}

Image difference(const Image& expected, const Image& actual, double amplify) {
  Image out(std::max(expected.width, actual.width), std::max(expected.height, actual.height));
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const bool in_expected = x < expected.width && y < expected.height;
      const bool in_both = in_expected && x < actual.width && y < actual.height;
      auto* p = out.pixel(x, y);
      const int d = in_both ? pixel_difference(expected.pixel(x, y), actual.pixel(x, y)) : 255;
      if (d == 0) {
        const auto gray = static_cast<std::uint8_t>(192 + luminance(expected.pixel(x, y)) / 255 * 63);
        p[0] = p[1] = p[2] = gray;
      } else {
        const double shown = std::min(255.0, 64 + amplify * d);  // even 1/255 must catch the eye
        p[0] = 255 - static_cast<std::uint8_t>(shown / 4);
        p[1] = p[2] = static_cast<std::uint8_t>((255 - shown) * 0.7);
      }
      p[3] = 255;
    }
  return out;
}

}  // namespace chute::image
