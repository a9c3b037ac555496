#include "engines/kind/method.hpp"

#include <cmath>

namespace chute::engines {

double step_dividing(double between_outputs, double longest) {
  return between_outputs / std::ceil(between_outputs / longest);
}

}  // namespace chute::engines
