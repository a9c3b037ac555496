#pragma once
#include <cereal/types/vector.hpp>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/grains.hpp"

namespace chute::measure {

/// The upper end of all grains, in strips of equal width across x.
struct Surface {
  std::int64_t first = 0;       ///< the number of the first strip, counted from x = 0
  std::vector<double> heights;  ///< above the bed's centres; NaN of a strip without grains

  template <class Archive>
  void serialize(Archive& a) {
    a(first, heights);
  }
};

/// What [output.surface] says of the lines that are laid through it.
struct SurfaceSpec {
  double every = 0, from = 0;
  double bin = 0;                ///< width of a strip
  double low = 0.2, high = 0.8;  ///< parts of the greatest height between which the surface counts as a slope
};

/// By how much the surface falls to both sides of its highest place, in degrees against the bed. NaN where fewer than three strips
/// have a height that counts, one after the other.
struct Slopes {
  double left = std::numeric_limits<double>::quiet_NaN(), right = left;
  double top = left, height = left;  ///< where that place is, and how high
};

/// Of the moving grains; each counts as the disc or sphere of its radius, and belongs to the strip of its centre. In space
/// strips are cut into squares, and the mean of their heights is that of the strip.
Surface surface_of(const GrainsView& grains, double bin);

Slopes slopes_of(const Surface& surface, const SurfaceSpec& spec);

}  // namespace chute::measure
