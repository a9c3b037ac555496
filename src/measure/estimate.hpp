#pragma once
#include <optional>

namespace chute::measure {

/// A mean with its standard error, which is empty where it is not known. The mean is NaN where nothing was
/// seen.
struct Estimate {
  double mean;
  std::optional<double> error;
};

}  // namespace chute::measure
