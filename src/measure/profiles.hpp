#pragma once
#include <span>

#include "measure/blocks.hpp"
#include "measure/layer_sums.hpp"

namespace chute::measure {

/// One bin of a profile over the height h above the centres of the bed.
struct ProfileBin {
  double h;       ///< middle of the bin
  double grains;  ///< mean number of grains whose centre lies in the bin
  /// Area fraction in 2D, volume fraction in 3D: each grain counts whole where its centre is (thesis 5.2, footnote 4).
  Estimate eta;
  Estimate eta_exact;             ///< the same by the part of each grain that lies in the bin
  std::array<Estimate, 3> v;      ///< mean velocity of the grains in the bin
  std::array<Estimate, 3> sigma;  ///< √(⟨v²⟩ − ⟨v⟩²)
  Estimate temperature;           ///< ⟨(v − ⟨v⟩)²⟩/D: T of a mean grain's mass 1
  Estimate omega;                 ///< mean spin, positive when rolling downhill
  Estimate half_shear;  ///< ½ ∂v_x/∂h from the bins above and below; ω of simple shear (thesis 5.2.2)
  /// Stress, positive in compression: carried by velocities that fluctuate about the bin's mean, and by
  /// contacts (each where the line between the centres lies).
  std::array<Estimate, 6> kinetic, contact;
  Estimate coordination;  ///< contacts of a grain whose centre lies in the bin
};

/// Time averages over layers of a flow. Errors are standard errors over ten stretches of the averaging window, so that
/// they count correlated samples as what they are.
class Profiles {
 public:
  /// Layers are `bin` high; samples are taken within the window.
  Profiles(const Frame& frame, double bin, const Window& window);

  /// `touching` tells the coordination, `forces` the stress: the same of soft grains.
  void sample(const GrainsView& grains, std::span<const Contact> touching, std::span<const Contact> forces);

  /// Bins from the bed up to the highest that ever held a grain. Only blocks of the window that begin at
  /// `start` or later count, and at least the last one. Empty if nothing was sampled.
  std::vector<ProfileBin> result(double start) const;
  /// Samples of grains that were too high for any layer.
  double beyond() const { return beyond_; }

  template <class Archive>
  void serialize(Archive& a) {
    a(blocks_, beyond_);
  }

 private:
  struct Sums {
    double count = 0, area = 0, exact = 0, omega = 0, touches = 0;
    std::array<double, 3> v{}, v2{};
    LayerSums layer;
    Sums& operator+=(const Sums& o) {
      count += o.count, area += o.area, exact += o.exact, omega += o.omega, touches += o.touches;
      for (std::size_t k = 0; k < 3; ++k) v[k] += o.v[k], v2[k] += o.v2[k];
      layer += o.layer;
      return *this;
    }
    template <class Archive>
    void serialize(Archive& a) {
      a(count, area, exact, omega, touches, v, v2, layer);
    }
  };
  Frame frame_;
  double bin_;
  Blocks<Sums> blocks_;
  double beyond_ = 0;

  Sums* bin_at(std::vector<Sums>& bins, double height) const;
  void add_contact(std::vector<Sums>& bins, const Contact& contact, const GrainsView& grains) const;
};

}  // namespace chute::measure
