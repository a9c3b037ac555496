#include "plot/outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace chute::plot {
namespace {

double cross(Point a, Point b) { return a.x() * b.y() - a.y() * b.x(); }

void add_cubic(std::vector<Point>& points, Point p0, Point p1, Point p2, Point p3, double tolerance) {
  // Wang's bound: chords of n equal steps of a cubic stray by at most (6/8) max|second difference| / n^2
  const double bend = std::max((p0 - 2 * p1 + p2).norm(), (p1 - 2 * p2 + p3).norm());
  const int steps = std::clamp(static_cast<int>(std::ceil(std::sqrt(0.75 * bend / tolerance))), 1, 500);
  for (int i = 1; i < steps; ++i) {
    const double t = static_cast<double>(i) / steps, s = 1 - t;
    points.push_back(s * s * s * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t * t * t * p3);
  }
  points.push_back(p3);
}

/// One stretch of pen: consecutive distinct points.
struct Piece {
  std::vector<Point> points;
  bool closed = false;
};

Piece distinct(const Contour& contour) {
  Piece piece{{}, contour.closed};
  for (Point p : contour.points)
    if (piece.points.empty() || (p - piece.points.back()).norm() > 1e-9) piece.points.push_back(p);
  while (piece.closed && piece.points.size() > 1 &&
         (piece.points.front() - piece.points.back()).norm() <= 1e-9)
    piece.points.pop_back();
  if (piece.points.size() < 2) piece.closed = false;
  return piece;
}

std::vector<Piece> dashed(Piece whole, const std::vector<double>& dash) {
  double period = 0;
  for (double d : dash) period += d;
  if (dash.empty() || period <= 0 || whole.points.size() < 2) return {std::move(whole)};
  if (whole.closed) whole.points.push_back(whole.points.front());
  std::vector<Piece> pieces;
  std::size_t phase = 0;
  double left = dash[0];
  bool on = true;
  Piece current{{whole.points[0]}, false};
  for (std::size_t i = 0; i + 1 < whole.points.size(); ++i) {
    const Point a = whole.points[i], b = whole.points[i + 1];
    const double total = (b - a).norm();
    double done = 0;
    while (total - done > left) {
      done += left;
      const Point p = a + (done / total) * (b - a);
      if (on) {
        current.points.push_back(p);
        pieces.push_back(std::move(current));
      }
      current = Piece{{p}, false};
      on = !on;
      phase = (phase + 1) % dash.size();
      left = dash[phase];
      if (dash.size() % 2 == 1 && phase == 0) continue;  // odd lists alternate meaning, as in PostScript
    }
    left -= total - done;
    if (on) current.points.push_back(b);
  }
  if (on && current.points.size() > 1) {
    if (whole.closed && !pieces.empty()) {  // the pen was down across the seam: one dash, not two
      auto& first = pieces.front().points;
      current.points.insert(current.points.end(), first.begin() + 1, first.end());
      first = std::move(current.points);
    } else {
      pieces.push_back(std::move(current));
    }
  }
  return pieces;
}

class Pen {
 public:
  Pen(const Stroke& stroke, double tolerance, std::vector<Point>& out)
      : stroke_(stroke), half_(stroke.width / 2), out_(out) {
    const double sagitta = std::min(1.0, tolerance / std::max(half_, 1e-12));
    step_ = std::clamp(2 * std::acos(1 - sagitta), 0.05, std::numbers::pi / 4);
  }

  void draw(const Piece& piece) {
    const auto& p = piece.points;
    if (p.size() == 1) {
      if (stroke_.cap == Cap::round) arc(p[0], 0, 2 * std::numbers::pi);
      return;
    }
    const std::size_t n = p.size(), segments = piece.closed ? n : n - 1;
    for (std::size_t i = 0; i < segments; ++i) {
      const Point a = p[i], b = p[(i + 1) % n], side = half_ * unit(a, b).unitOrthogonal();
      quad(a + side, b + side, b - side, a - side);
    }
    for (std::size_t i = piece.closed ? 0 : 1; i < (piece.closed ? n : n - 1); ++i)
      join(p[(i + n - 1) % n], p[i], p[(i + 1) % n]);
    if (!piece.closed) cap(p[1], p[0]), cap(p[n - 2], p[n - 1]);
  }

 private:
  const Stroke& stroke_;
  double half_, step_ = 0.3;
  std::vector<Point>& out_;

  static Point unit(Point a, Point b) { return (b - a).normalized(); }
  void triangle(Point a, Point b, Point c) { out_.insert(out_.end(), {a, b, c}); }
  void quad(Point a, Point b, Point c, Point d) { triangle(a, b, c), triangle(a, c, d); }

  void arc(Point centre, double from, double sweep) {
    const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(sweep) / step_)));
    const auto at = [&](int i) -> Point {
      const double angle = from + sweep * i / steps;
      return centre + half_ * Point{std::cos(angle), std::sin(angle)};
    };
    for (int i = 0; i < steps; ++i) triangle(centre, at(i), at(i + 1));
  }

  void join(Point before, Point at, Point after) {
    const Point u = unit(before, at), v = unit(at, after);
    const double turn = cross(u, v), along = u.dot(v);
    if (std::abs(turn) < 1e-9 && along > 0) return;
    const double outer = turn > 0 ? -1 : 1;  // the gap opens on the far side of the turn
    const Point a = at + outer * half_ * u.unitOrthogonal(), b = at + outer * half_ * v.unitOrthogonal();
    if (stroke_.join == Join::round) {
      const double from = std::atan2(a.y() - at.y(), a.x() - at.x());
      arc(at, from, std::atan2(turn, along));
      return;
    }
    triangle(at, a, b);
    const double half_angle_sine = std::sqrt(std::max(0.0, (1 - along) / 2));  // of the outer angle
    const double inner_sine =
        std::sqrt(std::max(0.0, (1 + along) / 2));  // sin of half the angle between the lines
    if (stroke_.join != Join::miter || inner_sine * stroke_.miter_limit < 1) return;
    const Point middle = a + 0.5 * (b - a);
    const double to_middle = (middle - at).norm();
    if (to_middle < 1e-12 || half_angle_sine < 1e-6) return;
    triangle(a, at + (half_ / inner_sine / to_middle) * (middle - at), b);
  }

  void cap(Point from, Point end) {
    const Point u = unit(from, end), side = half_ * u.unitOrthogonal();
    if (stroke_.cap == Cap::square)
      quad(end + side, end + side + half_ * u, end - side + half_ * u, end - side);
    if (stroke_.cap == Cap::round) arc(end, std::atan2(-side.y(), -side.x()), std::numbers::pi);
  }
};

}  // namespace

std::vector<Contour> flatten(const Path& path, double tolerance) {
  std::vector<Contour> contours;
  std::size_t k = 0;
  for (auto verb : path.verbs) {
    if (verb == Path::Verb::move) {
      contours.push_back({{path.points[k++]}, false});
    } else if (verb == Path::Verb::close) {
      if (contours.empty()) continue;
      contours.back().closed = true;
    } else {
      if (contours.empty()) contours.push_back({{path.points[k]}, false});
      if (contours.back().closed) contours.push_back({{contours.back().points.front()}, false});
      auto& points = contours.back().points;
      if (verb == Path::Verb::line) {
        points.push_back(path.points[k++]);
      } else {
        const Point from = points.back();  // a copy: the vector grows
        add_cubic(points, from, path.points[k], path.points[k + 1], path.points[k + 2], tolerance);
        k += 3;
      }
    }
  }
  return contours;
}

void fan_triangles(const std::vector<Contour>& contours, std::vector<Point>& triangles) {
  for (const auto& contour : contours)
    for (std::size_t i = 1; i + 1 < contour.points.size(); ++i)
      triangles.insert(triangles.end(), {contour.points[0], contour.points[i], contour.points[i + 1]});
}

void pen_triangles(const std::vector<Contour>& contours, const Stroke& stroke, double tolerance,
                   std::vector<Point>& triangles) {
  Pen pen(stroke, tolerance, triangles);
  for (const auto& contour : contours)
    for (const auto& piece : dashed(distinct(contour), stroke.dash)) pen.draw(piece);
}

}  // namespace chute::plot
