#pragma once
#include <vector>

#include "view/solid_scene.hpp"

namespace chute::view {

/// The balls that may be seen: those that others hide for certain are left out, which in a dense packing is
/// nearly all. Drawing the rest gives the same picture. `width` x `height` is the picture in pixels.
std::vector<Ball> visible(const std::vector<Ball>& balls, const Eye& eye, int width, int height);

}  // namespace chute::view
