#include "view/solid_tile.hpp"

#include <algorithm>
#include <cmath>

namespace chute::view {
namespace {

/// Things nearer to the eye than this share of its distance are behind it, or all that it sees.
constexpr double too_near = 0.01;
constexpr std::array<int, 4> nowhere{0, 0, 0, 0};

/// What a sphere covers along one axis of the picture: the tangents of the angles under which its ends are seen.
std::array<double, 2> tangents(double across, double depth, double radius) {
  const double square = depth * depth - radius * radius;
  const double root = radius * std::sqrt(across * across + square);
  return {(across * depth - root) / square, (across * depth + root) / square};
}

/// The samples that a sphere may cover.
std::array<int, 4> box_of(const Eigen::Vector3d& centre, double radius, const Eye& eye, int width,
                          int height) {
  if (centre.z() - radius < too_near * eye.distance) return nowhere;
  const auto u = tangents(centre.x(), centre.z(), radius), v = tangents(centre.y(), centre.z(), radius);
  const auto sample = [](double pixel, int size) {
    return static_cast<int>(std::clamp(std::floor(samples * pixel), -1.0, 1.0 * size));
  };
  return {std::max(0, sample(eye.at.x() + eye.focal * u[0], samples * width)),
          std::max(0, sample(eye.at.y() - eye.focal * v[1], samples * height)),
          std::min(samples * width, sample(eye.at.x() + eye.focal * u[1], samples * width) + 1),
          std::min(samples * height, sample(eye.at.y() - eye.focal * v[0], samples * height) + 1)};
}

}  // namespace

SeenBall::SeenBall(const Ball& ball, const Eye& eye, int width, int height)
    : centre(eye.coordinates(ball.centre)),
      radius(ball.radius),
      at(eye.at + eye.focal / centre.z() * plot::Point{centre.x(), -centre.y()}),
      nearest(static_cast<float>(centre.z() - eye.distance - radius)),
      box(box_of(centre, radius, eye, width, height)) {}

SeenRod::SeenRod(const Rod& rod, const Eye& eye, int width, int height)
    : from(eye.coordinates(rod.from)),
      to(eye.coordinates(rod.to)),
      radius_from(rod.radius_from),
      radius_to(rod.radius_to),
      box(nowhere) {
  const auto a = box_of(from, radius_from, eye, width, height), b = box_of(to, radius_to, eye, width, height);
  if (a == nowhere || b == nowhere) return;
  box = {std::min(a[0], b[0]), std::min(a[1], b[1]), std::max(a[2], b[2]), std::max(a[3], b[3])};
}

// With the ball's centre c = C / C_z on the plane at depth 1, a line of sight is d = c + e, e small and in that
// plane. It meets the ball of radius r where |z d - C| = r, and all that is small is written with e alone, so that
// nothing cancels however far the eye is:
//   w = e.d,  root² = r² d.d - C_z² (e.e + (e x c)²),  z = C_z - (C_z w + root) / d.d
struct BallSight {
  Eigen::Vector3d e, d;
  double w, square;

  BallSight(const SeenBall& ball, const Eye& eye, double x, double y)
      : e((x - ball.at.x()) / eye.focal, (ball.at.y() - y) / eye.focal, 0) {
    const double z = ball.centre.z();
    const Eigen::Vector3d c = ball.centre / z;
    d = c + e, w = e.dot(d);
    const double cross = e.x() * c.y() - e.y() * c.x();
    square = ball.radius * ball.radius * d.squaredNorm() - z * z * (e.squaredNorm() + cross * cross);
  }
  /// From the depth of the ball's centre to where the line meets it.
  double nearer(const SeenBall& ball) const {
    return -(ball.centre.z() * w + std::sqrt(std::max(0.0, square))) / d.squaredNorm();
  }
};

Hit hit(const SeenBall& ball, const Eye& eye, double x, double y) {
  const BallSight line(ball, eye, x, y);
  const double nearer = line.nearer(ball), z = ball.centre.z();
  const Eigen::Vector3d out = z * line.e + nearer * line.d;
  return {z - eye.distance + nearer, out.normalized()};
}

std::optional<double> depth_at(const SeenBall& ball, const Eye& eye, double x, double y) {
  const BallSight line(ball, eye, x, y);
  if (line.square < 0) return {};
  return ball.centre.z() - eye.distance + line.nearer(ball);
}

// After I. Quilez, "Capped cone - intersection" (2016), with distances from a point of the line near the rod.
std::optional<Hit> hit(const SeenRod& rod, const Eye& eye, double x, double y) {
  const Eigen::Vector3d d = sight(eye, x, y), start = (rod.from.z() + rod.to.z()) / 2 * d;
  const Eigen::Vector3d axis = rod.to - rod.from, a = start - rod.from, b = start - rod.to;
  const double ra = rod.radius_from, rb = rod.radius_to;
  const double length2 = axis.squaredNorm(), ma = a.dot(axis), mb = b.dot(axis), md = d.dot(axis),
               dd = d.squaredNorm();
  const auto depth = [&](double t) { return start.z() + t - eye.distance; };
  if (md != 0) {  // its ends: the one that faces the eye
    const double t = md > 0 ? -ma / md : -mb / md, radius = md > 0 ? ra : rb;
    if (((md > 0 ? a : b) + t * d).squaredNorm() < radius * radius)
      return Hit{depth(t), (md > 0 ? -1 : 1) * axis.normalized()};
  }
  const double taper = ra - rb, k = length2 + taper * taper;
  const double k2 = length2 * length2 * dd - md * md * k;
  const double k1 = length2 * length2 * d.dot(a) - ma * md * k + length2 * ra * taper * md;
  const double k0 =
      length2 * length2 * a.squaredNorm() - ma * ma * k + length2 * ra * (2 * taper * ma - length2 * ra);
  const double h = k1 * k1 - k2 * k0;
  if (h < 0 || k2 == 0) return {};
  const double t = (-k1 - std::sqrt(h)) / k2, along = ma + t * md;
  if (along < 0 || along > length2) return {};
  const Eigen::Vector3d out = length2 * (length2 * (a + t * d) + taper * ra * axis) - k * along * axis;
  return Hit{depth(t), out.normalized()};
}

void Tile::start(int left, int top) {
  left_ = left, top_ = top, added_ = 0;
  farthest_ = far;
  depths_.fill(far);
  names_.fill(nothing);
  block_depths_.fill(far);
}

std::array<int, 4> Tile::inside(const std::array<int, 4>& box) const {
  return {std::max(0, box[0] - left_), std::max(0, box[1] - top_), std::min(width, box[2] - left_),
          std::min(height, box[3] - top_)};
}

void Tile::add(const SeenBall& ball, std::uint32_t name, bool all) {
  const auto [x0, y0, x1, y1] = inside(ball.box);
  if (x0 >= x1 || y0 >= y1) return;
  const int bx0 = x0 / block, by0 = y0 / block, bx1 = (x1 - 1) / block, by1 = (y1 - 1) / block;
  bool hidden = !all;
  for (int by = by0; by <= by1 && hidden; ++by)
    for (int bx = bx0; bx <= bx1; ++bx) hidden = hidden && ball.nearest >= block_depth(bx, by);
  if (hidden) return;

  // as in hit(), all in units that are small where the ball is
  const double step = 1 / (samples * eye_.focal), z = ball.centre.z();
  const auto cx = static_cast<float>(ball.centre.x() / z), cy = static_cast<float>(ball.centre.y() / z);
  const auto cz = static_cast<float>(z), base = static_cast<float>(z - eye_.distance);
  const auto rr = static_cast<float>(ball.radius * ball.radius), cc = 1 + cx * cx + cy * cy;
  const auto first = static_cast<float>((left_ + x0 + 0.5) * step - ball.at.x() / eye_.focal);
  const auto across = static_cast<float>(step);
  for (int y = y0; y < y1; ++y) {
    const auto ey = static_cast<float>(ball.at.y() / eye_.focal - (top_ + y + 0.5) * step);
    float* const depths = &depths_[index(x0, y)];
    std::uint32_t* const names = &names_[index(x0, y)];
    for (int k = 0; k < x1 - x0; ++k) {
      const float ex = first + across * static_cast<float>(k);
      const float ec = ex * cx + ey * cy, ee = ex * ex + ey * ey, w = ec + ee, dd = cc + ec + w;
      const float cross = ex * cy - ey * cx;
      const float root = std::sqrt(rr * dd - cz * cz * (ee + cross * cross));  // NaN where the line misses
      const float depth = base - (cz * w + root) / dd;
      const bool nearer = depth < depths[k];
      depths[k] = nearer ? depth : depths[k];
      names[k] = nearer ? name : names[k];
    }
  }

  for (int by = by0; by <= by1; ++by)
    for (int bx = bx0; bx <= bx1; ++bx) {
      std::array<float, block> most;
      most.fill(-far);
      for (int y = 0; y < block; ++y)
        for (int x = 0; x < block; ++x) {
          auto& m = most[static_cast<std::size_t>(x)];
          const float depth = depths_[index(block * bx + x, block * by + y)];
          m = depth > m ? depth : m;
        }
      block_depth(bx, by) = *std::max_element(most.begin(), most.end());
    }
  constexpr int often =
      16;  // balls from one look at all blocks to the next, which costs as much as one of them
  if (++added_ % often == 0) farthest_ = *std::max_element(block_depths_.begin(), block_depths_.end());
}

void Tile::add(const SeenRod& rod, std::uint32_t name) {
  const auto [x0, y0, x1, y1] = inside(rod.box);
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      const auto at = hit(rod, eye_, (left_ + x + 0.5) / samples, (top_ + y + 0.5) / samples);
      auto& depth = depths_[index(x, y)];
      if (at && at->depth < depth) depth = static_cast<float>(at->depth), names_[index(x, y)] = name;
    }
}

}  // namespace chute::view
