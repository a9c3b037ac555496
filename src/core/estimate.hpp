#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace chute {

/// A mean with its standard error, which is empty where it is not known. The mean is NaN where nothing was
/// seen.
struct Estimate {
  double mean = NAN;
  std::optional<double> error{};
};

/// What the correlation r of neighbours does to the standard error of a mean, as in a first-order autoregression:
/// √((1 + r)/(1 − r)). Anticorrelation is taken for chance, and no more than 0.8 is believed of a short record.
inline double correlation_factor(double r) {
  const double kept = std::clamp(r, 0.0, 0.8);
  return std::sqrt((1 + kept) / (1 - kept));
}

/// Mean and standard error of independent values.
inline Estimate estimate_of(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  if (values.empty()) return {};
  double mean = 0, square = 0;
  for (const double v : values) mean += v / n;
  if (values.size() == 1) return {mean, {}};
  for (const double v : values) square += (v - mean) * (v - mean);
  return {mean, std::sqrt(square / (n - 1) / n)};
}

/// The same of values that follow each other in time, whose neighbours may be correlated.
inline Estimate estimate_in_time(std::span<const double> values) {
  Estimate e = estimate_of(values);
  if (!e.error) return e;
  double square = 0, next = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    square += (values[k] - e.mean) * (values[k] - e.mean);
    if (k > 0) next += (values[k] - e.mean) * (values[k - 1] - e.mean);
  }
  *e.error *= correlation_factor(square > 0 ? next / square : 0);
  return e;
}

}  // namespace chute
