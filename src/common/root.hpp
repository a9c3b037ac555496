#pragma once
#include <functional>

namespace chute {

/// The place between low and high where a function changes its sign, to the last bits (Boost's TOMS 748). Its signs at
/// the ends must differ.
double root_between(const std::function<double(double)>& f, double low, double high);

}  // namespace chute
