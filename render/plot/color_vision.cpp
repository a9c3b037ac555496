#include "plot/color_vision.hpp"

#include <cmath>

namespace chute::plot {
namespace {

/// sRGB's transfer function and back.
double to_linear(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
double from_linear(double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055; }

Eigen::Vector3d linear(const Color& c) { return {to_linear(c.r), to_linear(c.g), to_linear(c.b)}; }

Color seen_through(const Eigen::Matrix3d& eye, const Color& color) {
  const Eigen::Vector3d seen = (eye * linear(color)).cwiseMax(0).cwiseMin(1);
  return {from_linear(seen[0]), from_linear(seen[1]), from_linear(seen[2]), color.a};
}

}  // namespace

Color as_deuteranope(const Color& color) {
  static const Eigen::Matrix3d eye = (Eigen::Matrix3d() << 0.367322, 0.860646, -0.227968,  //
                                      0.280085, 0.672501, 0.047413,                        //
                                      -0.011820, 0.042940, 0.968881)
                                         .finished();
  return seen_through(eye, color);
}

Color as_protanope(const Color& color) {
  static const Eigen::Matrix3d eye = (Eigen::Matrix3d() << 0.152286, 1.052583, -0.204868,  //
                                      0.114503, 0.786281, 0.099216,                        //
                                      -0.003882, -0.048116, 1.051998)
                                         .finished();
  return seen_through(eye, color);
}

Lab lab_of(const Color& color) {
  static const Eigen::Matrix3d to_xyz = (Eigen::Matrix3d() << 0.4124, 0.3576, 0.1805,  //
                                         0.2126, 0.7152, 0.0722,                       //
                                         0.0193, 0.1192, 0.9505)
                                            .finished();
  const Eigen::Vector3d white = to_xyz * Eigen::Vector3d::Ones(), xyz = to_xyz * linear(color);
  const auto f = [&](Eigen::Index k) {
    const double t = xyz[k] / white[k];
    return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116;
  };
  return {116 * f(1) - 16, 500 * (f(0) - f(1)), 200 * (f(1) - f(2))};
}

double difference(const Color& a, const Color& b) {
  const Lab p = lab_of(a), q = lab_of(b);
  return std::hypot(p.l - q.l, p.a - q.a, p.b - q.b);
}

double grey_difference(const Color& a, const Color& b) { return std::abs(lab_of(a).l - lab_of(b).l); }

}  // namespace chute::plot
