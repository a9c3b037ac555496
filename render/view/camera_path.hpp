#pragma once
#include <vector>

#include "view/frame_style.hpp"

namespace chute::view {

/// A smooth curve through (t, y), t ascending: cubic pieces that overshoot no point, level at both ends and wherever neighbours lie
/// on one side (Fritsch and Carlson, SIAM J. Numer. Anal. 17, 238). Before the first point and after the last it keeps their values.
double smooth_through(const std::vector<double>& t, const std::vector<double>& y, double at);

/// The style's camera at a time: on a smooth way through its keys, if it has some.
Camera camera_at(const FrameStyle& style, double time);

}  // namespace chute::view
