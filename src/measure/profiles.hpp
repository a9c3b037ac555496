#pragma once
#include <span>

#include "measure/blocks.hpp"
#include "measure/layer_sums.hpp"

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
  /// Stress, positive in compression: carried by velocities that fluctuate about the bin's mean, and by
  /// contacts (each where the line between the centres lies).
  Estimate kinetic_xx, kinetic_xy, kinetic_yy, contact_xx, contact_xy, contact_yy;
  Estimate coordination;  ///< contacts of a grain whose centre lies in the bin
};

/// Time averages over horizontal layers of a 2D flow. Errors are standard errors over ten stretches of the
/// averaging window, so that they count correlated samples as what they are.
class Profiles {
 public:
  /// `length` of the line; layers are `bin` high; samples are taken within the window.
  Profiles(double length, double bin, const Window& window);

  void sample(const GrainsView& grains, std::span<const ContactRecord> contacts);

  /// Bins from the bed up to the highest that ever held a grain. Only blocks of the window that begin at
  /// `start` or later count, and at least the last one. Empty if nothing was sampled.
  std::vector<ProfileBin> result(double start) const;

  template <class Archive>
  void serialize(Archive& a) {
    a(blocks_);
  }

 private:
  struct Sums {
    double count = 0, area = 0, exact = 0, v_x = 0, v_y = 0, v_x2 = 0, v_y2 = 0, omega = 0, touches = 0;
    LayerSums layer;
    Sums& operator+=(const Sums& o) {
      count += o.count, area += o.area, exact += o.exact, omega += o.omega, touches += o.touches;
      v_x += o.v_x, v_y += o.v_y, v_x2 += o.v_x2, v_y2 += o.v_y2;
      layer += o.layer;
      return *this;
    }
    template <class Archive>
    void serialize(Archive& a) {
      a(count, area, exact, v_x, v_y, v_x2, v_y2, omega, touches, layer);
    }
  };
  double length_, bin_;
  Blocks<Sums> blocks_;

  Sums& bin_at(std::vector<Sums>& bins, std::int64_t b) const;
  void add_contact(std::vector<Sums>& bins, const ContactRecord& contact, const GrainsView& grains) const;
};

}  // namespace chute::measure
