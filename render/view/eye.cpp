#include "view/eye.hpp"

namespace chute::view {
namespace {

/// The eye's distance from what it sees, in diagonals of its box: so far that lines which run away from the eye
/// still look nearly parallel, as they should where lengths are to be compared.
constexpr double diagonals_away = 2.6;

/// An eye of focal length 1 on the box; what it sees lies in the rectangle that is returned beside.
struct Glance {
  Eye eye;
  Eigen::AlignedBox2d seen;

  Glance(const Eigen::AlignedBox3d& box, const Eigen::Matrix3d& axes) {
    eye.centre = box.center(), eye.axes = axes;
    eye.distance = diagonals_away * box.diagonal().norm();
    for (int i = 0; i < 8; ++i)
      seen.extend(eye.seen(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i))));
  }
};

}  // namespace

Eigen::Matrix3d Eye::axes_of(const Eigen::Vector3d& towards, const Eigen::Vector3d& up) {
  Eigen::Matrix3d axes;
  axes.row(2) = towards.normalized();
  Eigen::Vector3d across = up.cross(towards);
  // straight from above: the other axes stay as they are where the eye comes down to the front
  if (across.norm() < 1e-6 * towards.norm()) across = Eigen::Vector3d::UnitY().cross(towards);
  if (across.norm() < 1e-6 * towards.norm()) across = Eigen::Vector3d::UnitX();
  axes.row(0) = across.normalized();
  axes.row(1) = axes.row(2).cross(axes.row(0));
  return axes;
}

double Eye::aspect(const Eigen::AlignedBox3d& box, const Eigen::Matrix3d& axes) {
  const Eigen::Vector2d size = Glance(box, axes).seen.sizes();
  return size.x() / size.y();
}

Eye Eye::on_box(const Eigen::AlignedBox3d& box, const Eigen::Matrix3d& axes, const plot::Rect& rect,
                double zoom) {
  auto [eye, seen] = Glance(box, axes);
  const Eigen::Vector2d size = seen.sizes();
  eye.focal = zoom * std::min(rect.width() / size.x(), rect.height() / size.y());
  eye.at = rect.centre() - eye.focal * seen.center();
  return eye;
}

}  // namespace chute::view
