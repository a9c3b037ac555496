#pragma once
#include <span>
#include <vector>

namespace chute::figures {

/// A cluster of values that stands out in their distribution.
struct Peak {
  double position;  ///< mean of its members
  double width;     ///< their standard deviation
  double share;     ///< their part of all values
};

/// The distinguishable peaks of a distribution, in order of position. The density is estimated with a
/// gaussian kernel of standard deviation `bandwidth` (in the values' unit). Its maxima are peaks, and what
/// lies between two minima belongs to the peak in between. Two neighbours are one peak if the density between
/// them stays above half of the lower one; what holds less than a hundredth of all values is none. Nothing
/// for no values; a bandwidth of the clusters' own width tells clusters apart that are some 3 widths apart.
std::vector<Peak> find_peaks(std::span<const double> values, double bandwidth);

}  // namespace chute::figures
