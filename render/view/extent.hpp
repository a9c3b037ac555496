#pragma once
#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <vector>

namespace chute::view {

/// Finds the view of a sequence: the smallest box that holds nearly all places of the moving grains in all frames, with the bed
/// below them. A grain that was thrown out does not make all others small.
class Extent {
 public:
  /// A grain in one of the frames, with its size.
  void add(const Eigen::Vector3d& place, double radius, bool fixed);

  struct View {
    Eigen::AlignedBox3d box;
    std::size_t outside = 0;  ///< moving grains of all frames whose centres lie outside
    bool cropped = false;     ///< there are grains, or parts of the bed, outside
    bool about = false;       ///< `outside` was counted on a part of them
  };
  /// `up` is the axis of which the bed lies below. `turn` is applied to places first: the view of a turned picture is
  /// another. `shape` > 0, width / height along the first two axes: where the bed goes on beside a box of another shape,
  /// more of it is shown. `all`: every grain.
  View view(int up, const Eigen::Matrix3d& turn, double shape, bool all) const;

  /// The axis along which moving grains spread less than half as far as along each other one, or -1.
  int thinnest() const;

 private:
  struct Place {
    Eigen::Vector3d centre;
    double radius;
  };
  /// Places in order of arrival, thinned evenly once there are many.
  struct Places {
    std::vector<Place> kept;
    std::size_t stride = 1, seen = 0;
    void add(const Place& place);
  };
  Places moving_, fixed_;
  Eigen::Vector3d low_ = Eigen::Vector3d::Constant(INFINITY), high_ = Eigen::Vector3d::Constant(-INFINITY);

  Eigen::AlignedBox3d box_of(const std::vector<Place>& places, const Eigen::Matrix3d& turn,
                             double left_out) const;
};

}  // namespace chute::view
