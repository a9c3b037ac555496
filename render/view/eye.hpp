#pragma once
#include <Eigen/Geometry>

#include "plot/geometry.hpp"

namespace chute::view {

/// How a space is seen: an eye that looks at `centre`, in perspective. A point has three coordinates for the eye:
/// to the right, upwards, and its depth, away from the eye along the line to the centre.
struct Eye {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< rows, of length 1: right, up, towards the eye
  double distance = 1;                                 ///< of the eye from the centre, in the files' unit
  double focal = 1;      ///< pixels per unit slope: a length l at depth D is focal l / D long
  plot::Point at{0, 0};  ///< where the centre is seen, pixels from the top left

  /// Rows right, up and `towards`, all of length 1; `up` need not be square to `towards`.
  static Eigen::Matrix3d axes_of(const Eigen::Vector3d& towards, const Eigen::Vector3d& up);
  /// The eye that sees a box fill `rect` (pixels) as well as can be; `zoom` > 1 is larger.
  static Eye on_box(const Eigen::AlignedBox3d& box, const Eigen::Matrix3d& axes, const plot::Rect& rect,
                    double zoom);
  /// Width / height of a box so seen.
  static double aspect(const Eigen::AlignedBox3d& box, const Eigen::Matrix3d& axes);

  Eigen::Vector3d towards() const { return axes.row(2); }
  /// Right, up and depth of a place.
  Eigen::Vector3d coordinates(const Eigen::Vector3d& place) const {
    const Eigen::Vector3d p = axes * (place - centre);
    return {p.x(), p.y(), distance - p.z()};
  }
  /// Where a place is seen, pixels from the top left.
  plot::Point seen(const Eigen::Vector3d& place) const {
    const Eigen::Vector3d p = coordinates(place);
    return at + focal / p.z() * plot::Point{p.x(), -p.y()};
  }
  /// A direction at the centre as it is seen: x right, y down, length up to 1.
  plot::Point seen_direction(const Eigen::Vector3d& direction) const {
    const Eigen::Vector3d d = axes * direction;
    return {d.x(), -d.y()};
  }
};

}  // namespace chute::view
