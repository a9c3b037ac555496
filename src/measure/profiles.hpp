#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "core/grains.hpp"
#include "measure/estimate.hpp"

namespace chute::measure {

/// One bin of a profile over the height h above the centres of the bed.
struct ProfileBin {
  double h;       ///< middle of the bin
  double grains;  ///< mean number of grains whose centre lies in the bin
  Estimate eta;   ///< area fraction: each grain counts whole where its centre is (thesis 5.2, footnote 4)
  Estimate eta_exact;         ///< area fraction by the part of each disc that lies in the bin
  Estimate v_x, v_y;          ///< mean velocity of the grains in the bin
  Estimate sigma_x, sigma_y;  ///< √(⟨v²⟩ − ⟨v⟩²)
  Estimate omega;             ///< mean spin, positive when rolling downhill
  Estimate half_shear;  ///< ½ ∂v_x/∂h from the bins above and below; what ω is in simple shear (thesis 5.2.2)
};

/// Time averages over horizontal layers of a 2D flow. Errors are standard errors over ten stretches of the
/// averaging window, so that they count correlated samples as what they are.
class Profiles {
 public:
  /// `length` of the line; layers are `bin` high. Samples lie in [from, until], which is cut into `blocks`:
  /// that is how finely `result` can choose what counts.
  Profiles(double length, double bin, double from, double until, std::size_t blocks = 10);

  void sample(const GrainsView& grains);

  /// Bins from the bed up to the highest that ever held a grain. Only blocks that begin at `start` or later
  /// count, and at least the last one. Empty if nothing was sampled.
  std::vector<ProfileBin> result(double start) const;
  std::vector<ProfileBin> result() const { return result(from_); }

  template <class Archive>
  void serialize(Archive& a) {
    a(samples_, sums_);
  }

 private:
  struct Sums {
    double count = 0, area = 0, exact = 0, v_x = 0, v_y = 0, v_x2 = 0, v_y2 = 0, omega = 0;
    Sums& operator+=(const Sums& o) {
      count += o.count, area += o.area, exact += o.exact, omega += o.omega;
      v_x += o.v_x, v_y += o.v_y, v_x2 += o.v_x2, v_y2 += o.v_y2;
      return *this;
    }
    template <class Archive>
    void serialize(Archive& a) {
      a(count, area, exact, v_x, v_y, v_x2, v_y2, omega);
    }
  };
  struct Means;
  double length_, bin_, from_, until_;
  std::vector<std::int64_t> samples_;
  std::vector<std::vector<Sums>> sums_;  // [block][bin]

  std::vector<std::size_t> blocks_from(double start) const;
};

}  // namespace chute::measure
