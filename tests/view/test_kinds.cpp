#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "view/frame_style.hpp"

using namespace chute;

namespace kinds_tests {

namespace {

double linear(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }

/// CIELAB (D65) of a colour in linear sRGB.
Eigen::Vector3d lab(Eigen::Vector3d rgb) {
  Eigen::Matrix3d to_xyz;
  // clang-format off
  to_xyz << .4124564, .3575761, .1804375,
            .2126729, .7151522, .0721750,
            .0193339, .1191920, .9503041;
  // clang-format on
  Eigen::Vector3d xyz = to_xyz * rgb.cwiseMax(0).cwiseMin(1);
  xyz = xyz.cwiseQuotient(Eigen::Vector3d(0.95047, 1, 1.08883));
  const Eigen::Vector3d f = xyz.unaryExpr([](double t) {
    constexpr double d = 6.0 / 29;
    return t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.0 / 29;
  });
  return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

}  // namespace

TEST_CASE("Kinds look different to all eyes, from each other, the bed and the ground") {
  // How people without M and without L cones see: G. M. Machado, M. M. Oliveira, L. A. F. Fernandes, IEEE TVCG 15, 1291 (2009), full
  // severity, on linear sRGB.
  Eigen::Matrix3d eyes[3];
  // clang-format off
  eyes[0].setIdentity();
  eyes[1] << 0.367322, 0.860646, -0.227968,
             0.280085, 0.672501,  0.047413,
            -0.011820, 0.042940,  0.968881;
  eyes[2] << 0.152286, 1.052583, -0.204868,
             0.114503, 0.786281,  0.099216,
            -0.003882,-0.048116,  1.051998;
  // clang-format on
  constexpr double clearly = 20;  // CIELAB; 2.3 are just noticed side by side
  for (const auto background : {view::Background::white, view::Background::dark}) {
    const auto palette = view::palette_of(background);
    std::vector<view::Rgb> colors(view::kind_colors(background).begin(), view::kind_colors(background).end());
    colors.push_back(palette.bed);
    colors.push_back(palette.ground);
    for (const auto& eye : eyes)
      for (std::size_t i = 0; i < view::kind_color_count; ++i)
        for (std::size_t k = i + 1; k < colors.size(); ++k) {
          const auto seen = [&](const view::Rgb& c) {
            return lab(eye * Eigen::Vector3d(linear(c.r), linear(c.g), linear(c.b)));
          };
          CAPTURE(i, k);
          CHECK((seen(colors[i]) - seen(colors[k])).norm() > clearly);
        }
  }
}

}  // namespace kinds_tests
