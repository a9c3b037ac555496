#include "write/box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace chute::write {

Box box_of(const read::GrainFrame& frame, bool flat_repeats) {
  if (frame.lattice) return {*frame.lattice, {}, frame.lattice->origin + frame.lattice->edges.diagonal()};
  Box box;
  const std::array<const std::vector<double>*, 3> places{&frame.x, &frame.y, &frame.z};
  for (std::size_t k = 0; k < 3; ++k) {
    const int axis = static_cast<int>(k);
    const bool flat = axis == 2 && frame.dimensions == 2;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < frame.size(); ++i) {
      low = std::min(low, (*places[k])[i] - frame.radius[i]);
      high = std::max(high, (*places[k])[i] + frame.radius[i]);
    }
    if (!(low < high)) low = -0.5, high = 0.5;  // without grains any box will do
    box.fitted[k] = !flat;
    box.lattice.periodic[k] = flat && flat_repeats;
    if (frame.period(axis) > 0 && !flat) {
      low = frame.domain.min()[axis], high = frame.domain.max()[axis];
      box.lattice.periodic[k] = true, box.fitted[k] = false;
    }
    box.lattice.origin[axis] = low, box.high[axis] = high;
    box.lattice.edges(axis, axis) = high - low;
  }
  return box;
}

}  // namespace chute::write
