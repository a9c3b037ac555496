#pragma once
#include <span>

#include "measure/blocks.hpp"
#include "measure/layer_sums.hpp"

namespace chute::measure {

/// The continuum fields of a flow at one height.
struct FieldPoint {
  double h;
  Estimate density;           ///< mass per area in 2D, per volume in 3D
  std::array<Estimate, 3> v;  ///< momentum over density
  /// Stress, positive in compression, as in ProfileBin.
  std::array<Estimate, 6> kinetic, contact;
};

/// Coarse-grained fields over the height (I. Goldhirsch, Granular Matter 12, 239 (2010)): a grain at height y
/// counts with φ(h − y), a contact with the mean of φ along the line between the centres; averaged along the
/// bed and in time. φ(r) = 15/16w (1 − r²/w²)² for |r| < w, whose integral is 1. The fields are smooth,
/// integrate to mass and momentum, fulfil the balance of momentum exactly, and know no bins: heights are w/4
/// apart for drawing only.
class Fields {
 public:
  Fields(const Frame& frame, double width, const Window& window);

  void sample(const GrainsView& grains, std::span<const Contact> touching, std::span<const Contact> forces);

  /// Heights from −w on up to the highest that anything reached, as Profiles::result.
  std::vector<FieldPoint> result(double start) const;
  double beyond() const { return beyond_; }  ///< as Profiles::beyond

  template <class Archive>
  void serialize(Archive& a) {
    a(blocks_, beyond_);
  }

 private:
  Frame frame_;
  double width_, spacing_;
  Blocks<LayerSums> blocks_;
  double beyond_ = 0;

  double height(std::size_t point) const { return static_cast<double>(point) * spacing_ - width_; }
  template <class Add>
  void around(std::vector<LayerSums>& points, double low, double high, const Add& add) const;
};

}  // namespace chute::measure
