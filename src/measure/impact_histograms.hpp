#pragma once
#include <array>
#include <span>
#include <string_view>

#include "core/engine.hpp"
#include "measure/blocks.hpp"

namespace chute::measure {

struct HistogramBins {
  std::size_t angles = 90;       ///< of γ mod π, over [0, π]
  std::size_t velocities = 100;  ///< of |v_n|, over [0, fastest]
  double fastest = 2;            ///< faster impacts are counted, but lie in no bin
};

/// One row of the impacts' statistics.
struct HistogramRow {
  std::string_view pair;  ///< "grain" (with a grain), "bed", or "all"
  std::string_view
      quantity;  ///< "gamma", "v_n": probability densities; "v_n of gamma": mean |v_n| at that angle
  double x;      ///< middle of the bin
  Estimate value;
};

/// Distributions of the impact angle γ (mod π) and of the normal velocity |v_n| (thesis figs. 5.2 and 5.3),
/// and how they are correlated (fig. 5.4), apart for impacts of grains with each other and with the bed.
/// Nothing is kept of single impacts, so a run of any length takes the same memory.
class ImpactHistograms {
 public:
  ImpactHistograms(const HistogramBins& bins, const Window& window);

  /// Ids from `moving` on are the bed's.
  void add(std::span<const Impact> impacts, std::size_t moving);

  /// As Profiles::result. A density is empty where no impact was seen in all.
  std::vector<HistogramRow> result(double start) const;

  template <class Archive>
  void serialize(Archive& a) {
    a(blocks_);
  }

 private:
  struct Sums {
    std::array<double, 2> count{}, v_n{};  ///< [0] with grains, [1] with the bed
    Sums& operator+=(const Sums& o) {
      for (std::size_t k = 0; k < 2; ++k) count[k] += o.count[k], v_n[k] += o.v_n[k];
      return *this;
    }
    template <class Archive>
    void serialize(Archive& a) {
      a(count, v_n);
    }
  };
  HistogramBins bins_;
  Blocks<Sums> blocks_;  // bins: of angles, then of velocities, then one with everything
};

}  // namespace chute::measure
