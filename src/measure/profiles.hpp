#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "core/grains.hpp"

namespace chute::measure {

/// A mean with its standard error, which is empty where it is not known. The mean is NaN where nothing was
/// seen.
struct Estimate {
  double mean;
  std::optional<double> error;
};

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

/// Time averages over horizontal layers of a 2D flow. Errors are standard errors over `blocks` equal
/// stretches of the averaging window, so that they count correlated samples as what they are.
class Profiles {
 public:
  static constexpr std::size_t blocks = 10;

  /// `length` of the line; layers are `bin` high; averages run over [from, until].
  Profiles(double length, double bin, double from, double until);

  void sample(const GrainsView& grains);

  /// Bins from the bed up to the highest that ever held a grain. Empty if nothing was sampled.
  std::vector<ProfileBin> result() const;

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
  std::vector<std::int64_t> samples_ = std::vector<std::int64_t>(blocks);
  std::vector<std::vector<Sums>> sums_ = std::vector<std::vector<Sums>>(blocks);  // [block][bin]
};

}  // namespace chute::measure
