#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/estimate.hpp"

namespace chute::measure {

/// A stretch of time in which averages are taken, cut into blocks: that is how finely one can choose
/// afterwards from when on samples count.
struct Window {
  double from, until;
  std::size_t blocks = 10;
};

/// Sums over bins, kept apart for each block of time. `Sums` starts at zero and knows += and serialize.
template <class Sums>
class Blocks {
 public:
  struct Part {
    double samples = 0;
    std::vector<Sums> bins;

    Part& operator+=(const Part& other) {
      samples += other.samples;
      if (bins.size() < other.bins.size()) bins.resize(other.bins.size());
      for (std::size_t b = 0; b < other.bins.size(); ++b) bins[b] += other.bins[b];
      return *this;
    }
    template <class Archive>
    void serialize(Archive& a) {
      a(samples, bins);
    }
  };

  explicit Blocks(const Window& window) : window_(window), blocks_(window.blocks) {}

  /// The bins of the block that holds this time. Counts as one more sample.
  std::vector<Sums>& sample(double time) {
    auto& block = block_at(time);
    block.samples += 1;
    return block.bins;
  }

  /// The blocks with samples that begin at `start` or later (at least the last one), joined to ten stretches
  /// if there are more. All have the same number of bins.
  std::vector<Part> stretches(double start) const {
    constexpr std::size_t most = 10;
    std::vector<const Part*> counting;
    const double width = (window_.until - window_.from) / static_cast<double>(blocks_.size());
    std::size_t bins = 0;
    for (std::size_t b = blocks_.size(); b-- > 0;) {
      const bool late = window_.from + static_cast<double>(b) * width >= start - 1e-9 * width;
      if (blocks_[b].samples == 0 || !(late || counting.empty())) continue;
      counting.insert(counting.begin(), &blocks_[b]);
      bins = std::max(bins, blocks_[b].bins.size());
    }
    const std::size_t count = std::min(counting.size(), most);
    std::vector<Part> parts(count);
    for (std::size_t k = 0; k < counting.size(); ++k) parts[k * count / counting.size()] += *counting[k];
    for (auto& part : parts) part.bins.resize(bins);
    return parts;
  }
  std::vector<Part> stretches() const { return stretches(window_.from); }

  /// A run that goes on for longer cuts another window: what was gathered in blocks of the old one counts for the block of
  /// the new one that holds its middle.
  template <class Archive>
  void serialize(Archive& a) {
    Window before = window_;
    a(before.from, before.until, blocks_);
    if (before.from == window_.from && before.until == window_.until && blocks_.size() == window_.blocks)
      return;
    const auto gathered = std::exchange(blocks_, std::vector<Part>(window_.blocks));
    const double width = (before.until - before.from) / static_cast<double>(gathered.size());
    for (std::size_t b = 0; b < gathered.size(); ++b)
      if (gathered[b].samples > 0)
        block_at(before.from + (static_cast<double>(b) + 0.5) * width) += gathered[b];
  }

 private:
  Window window_;
  std::vector<Part> blocks_;

  Part& block_at(double time) {
    const double length = window_.until - window_.from;
    const double part = length > 0 ? (time - window_.from) / length : 0;
    const auto count = static_cast<double>(blocks_.size());
    return blocks_[static_cast<std::size_t>(std::clamp(part * count, 0.0, count - 1))];
  }
};

/// What `mean_of(sums, samples)` says about one bin: of the whole window, so that fluctuations count slow
/// changes too, with the error from the scatter over the stretches. Stretches in which it is not finite do not count.
template <class Sums, class MeanOf>
Estimate estimate_bin(const std::vector<typename Blocks<Sums>::Part>& stretches, std::size_t bin,
                      const MeanOf& mean_of) {
  Sums total{};
  double samples = 0;
  std::vector<double> values;
  for (const auto& stretch : stretches) {
    total += stretch.bins[bin];
    samples += stretch.samples;
    if (const double value = mean_of(stretch.bins[bin], stretch.samples); std::isfinite(value))
      values.push_back(value);
  }
  const double mean = mean_of(total, samples);
  if (!std::isfinite(mean)) return {mean, {}};  // what is not known has no error either
  return {mean, estimate_of(values).error};
}

}  // namespace chute::measure
