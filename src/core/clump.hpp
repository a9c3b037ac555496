#pragma once
#include <vector>

#include "core/grains.hpp"
#include "core/orientation.hpp"
#include "core/vec.hpp"

namespace chute {

/// One of the spheres that a grain is made of. In 2D their centres lie in the plane.
template <int D>
struct Member {
  Vec<D> at{};  ///< from the centre of mass, along the principal axes
  double radius = 0;
};

/// The form of a grain that is not round: spheres, which may overlap, as one rigid body. Lengths are such that its volume is
/// that of a sphere of radius 1.
template <int D>
struct Clump {
  std::vector<Member<D>> members;
  Vec<turns<D>> gyration{};  ///< principal moments of inertia over the mass; 2/5 of a sphere
  Vec<turns<D>> ease{};      ///< their mean over each of them: how readily it spins about that axis
  double reach = 1;          ///< of its farthest point from the centre of mass
  double radius = 1;         ///< 2D: of the disc that covers as much of the plane; in 3D always 1
  /// Effective mass at the contact where a push gives it most spin, over its mass; 1 of a sphere.
  double lightest = 1;
  Orientation<D> written = as_at_start<D>();  ///< how the principal axes lie in the form as it was written

  /// Does it spin about any axis alike, as a sphere does?
  bool spins_like_a_sphere() const {
    for (int k = 1; k < turns<D>; ++k)
      if (gyration[k] != gyration[0]) return false;
    return true;
  }
  double mean_gyration() const {
    if (spins_like_a_sphere()) return gyration[0];
    double sum = 0;
    for (int k = 0; k < turns<D>; ++k) sum += gyration[k] / turns<D>;
    return sum;
  }
  /// Mean moment of inertia of a grain of that mass and scale (see Clumps).
  double inertia(double mass, double scale) const { return mean_gyration() * mass * scale * scale; }
};

/// Which of the moving grains has which form, and how large: its `scale` is the radius of the sphere of the same volume.
/// Nothing where all grains are round.
template <int D>
struct Clumps {
  std::vector<Clump<D>> forms;
  std::vector<int> form;
  Array scale;

  bool any() const { return !forms.empty(); }
  const Clump<D>& of(std::size_t grain) const { return forms[static_cast<std::size_t>(form[grain])]; }
};

}  // namespace chute
