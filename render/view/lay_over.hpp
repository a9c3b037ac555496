#pragma once
#include "image/image.hpp"

namespace chute::view {

/// Lays `top` over `bottom` with its upper left corner at (left, above); both with straight alpha.
void lay_over(image::Image& bottom, const image::Image& top, int left = 0, int above = 0);

/// Colours were multiplied by alpha while shapes were laid over each other; files and blending want them as they are.
void divide_by_alpha(image::Image& picture);

}  // namespace chute::view
