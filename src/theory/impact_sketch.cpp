#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "theory/theory_figures.hpp"

namespace chute::theory {
namespace {

constexpr double pi = std::numbers::pi;

/// Draws lines into a panel of a table, each series one line.
class Sketch {
 public:
  explicit Sketch(FigureTable& table) : table_(table) {}

  void line(const char* panel, const char* series, double x0, double y0, double x1, double y1) {
    table_.rows.push_back({panel, series, x0, y0});
    table_.rows.push_back({panel, series, x1, y1});
  }
  /// A line with a head of two strokes at its end.
  void arrow(const char* panel, const char* series, double x0, double y0, double x1, double y1) {
    line(panel, series, x0, y0, x1, y1);
    head(panel, series, x1, y1, std::atan2(y0 - y1, x0 - x1));
  }
  /// An arc with a head: the sense in which something turns.
  void turn(const char* panel, const char* series, double x, double y, double radius, double from,
            double to) {
    arc(panel, series, x, y, radius, from, to);
    head(panel, series, x + radius * std::cos(to), y + radius * std::sin(to),
         to + (from < to ? -pi : pi) / 2);
  }
  void rectangle(const char* panel, const char* series, double x0, double y0, double x1, double y1) {
    for (const auto& [x, y] : {std::pair{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}})
      table_.rows.push_back({panel, series, x, y});
  }
  /// From angle `from` to `to`, anticlockwise from the x axis.
  void arc(const char* panel, const char* series, double x, double y, double radius, double from, double to) {
    constexpr int steps = 72;
    for (int k = 0; k <= steps; ++k) {
      const double a = from + (to - from) * k / steps;
      table_.rows.push_back({panel, series, x + radius * std::cos(a), y + radius * std::sin(a)});
    }
  }

 private:
  FigureTable& table_;

  /// Two strokes from a tip, which opens towards the angle `back`.
  void head(const char* panel, const char* series, double x, double y, double back) {
    constexpr double length = 0.14, opening = 0.4;  // in bead radii; rad
    for (const double side : {-opening, opening}) {
      table_.rows.push_back(
          {panel, series, x + length * std::cos(back + side), y + length * std::sin(back + side)});
      table_.rows.push_back({panel, series, x, y});
    }
  }
};

}  // namespace

/// The thesis's definition of the impact angles: n leads from the bead's centre to the ball's, cos γ = n_z and
/// φ = atan2(n_y, n_x), so that φ = 0 is the downhill side of the bead. Lengths in bead radii; the ball is small, Φ = 2, and
/// γ larger than it can become, to be seen.
FigureTable compute_fig_4_31(const FigureContext&) {
  constexpr double size_ratio = 2, gamma = 0.6, phi = 0.75 * pi, reach = 1 + size_ratio;
  FigureTable table;
  table.comments = {
      "x: along the incline, in bead radii", "y: a: across it; b: away from it",
      "n leads from the bead to the ball; cos gamma = n_z, phi = atan2(n_y, n_x); phi = 0: downhill"};
  Sketch sketch(table);
  // From above: the bead, where it is hit, and two ways that the ball may take
  sketch.arc("a", "bead", 0, 0, 1, 0, 2 * pi);
  sketch.line("a", "axis x", 0, 0, 1.7, 0);
  sketch.line("a", "axis across", 0, -1.6, 0, 1.6);
  sketch.line("a", "normal", 0, 0, std::cos(phi), std::sin(phi));
  sketch.arc("a", "angle", 0, 0, 0.45, 0, phi);
  sketch.line("a", "way over the bead", -1.8, 0.45, 1.8, 0.1);
  sketch.line("a", "way to the side", std::cos(phi), std::sin(phi), 0.9, 1.8);
  sketch.line("a", "way to the impact", -1.8, 0.5, std::cos(phi), std::sin(phi));
  // From the side, in the plane that holds n: the ball touches the bead
  sketch.arc("b", "bead", 0, 0, 1, 0, 2 * pi);
  const double x = -reach * std::sin(gamma), z = reach * std::cos(gamma);
  sketch.arc("b", "ball", x, z, size_ratio, 0, 2 * pi);
  sketch.line("b", "axis z", 0, 0, 0, 4.5);
  sketch.line("b", "normal", 0, 0, x, z);
  sketch.arc("b", "angle", 0, 0, 1.6, pi / 2, pi / 2 + gamma);
  return table;
}

/// Two discs that meet: n leads from i to j, s lies across it (1.10, 1.11).
FigureTable compute_fig_1_04(const FigureContext&) {
  constexpr double R_i = 1, R_j = 0.75, along = 25 * pi / 180;
  const double n_x = std::cos(along), n_y = std::sin(along), x = (R_i + R_j) * n_x, y = (R_i + R_j) * n_y;
  FigureTable table;
  table.comments = {
      "x: in radii of grain i", "y: in radii of grain i",
      "n leads from i to j (1.10), s lies in the contact plane (1.11); the angle lies between n and v_i - v_j. As printed, with "
      "v_j - v_i, (1.15) would be beyond a right angle for all grains that meet"};
  Sketch sketch(table);
  sketch.arc("", "grain i", 0, 0, R_i, 0, 2 * pi);
  sketch.arc("", "grain j", x, y, R_j, 0, 2 * pi);
  sketch.line("", "axis centres", 0, 0, x, y);
  sketch.arrow("", "normal n", R_i * n_x, R_i * n_y, (R_i + 0.65) * n_x, (R_i + 0.65) * n_y);
  sketch.arrow("", "normal s", R_i * n_x, R_i * n_y, R_i * n_x + 0.65 * n_y, R_i * n_y - 0.65 * n_x);
  constexpr double v_i[2] = {0.05, 0.6}, v_j[2] = {-0.4, 0.1}, v[2] = {v_i[0] - v_j[0], v_i[1] - v_j[1]};
  sketch.arrow("", "velocity i", 0, 0, v_i[0], v_i[1]);
  sketch.arrow("", "velocity j", x, y, x + v_j[0], y + v_j[1]);
  sketch.arrow("", "approach", 0, 0, v[0], v[1]);
  sketch.arc("", "angle", 0, 0, 0.4, along, std::atan2(v[1], v[0]));
  sketch.turn("", "spin i", 0, 0, 0.8, 1.1 * pi, 1.5 * pi);
  sketch.turn("", "spin j", x, y, 0.55, 1.5 * pi, 1.9 * pi);
  return table;
}

/// The cylinder of 3.2 that a block pushes along a plane, and the forces on it.
FigureTable compute_fig_3_09(const FigureContext&) {
  FigureTable table;
  table.comments = {
      "x: in radii of the cylinder", "y: in radii of the cylinder",
      "forces on the cylinder: F_s^p of the plane, F_s^b of the block, m g; F_p pushes the block"};
  Sketch sketch(table);
  sketch.line("", "plane", -3.2, 0, 2, 0);
  sketch.arc("", "cylinder", 0, 1, 1, 0, 2 * pi);
  sketch.rectangle("", "block", -2.1, 0.45, -1, 1.55);
  sketch.arrow("", "force F_p", -3, 1, -2.1, 1);
  sketch.arrow("", "force F_s^b", -1, 1, -1, 0.35);
  sketch.arrow("", "force F_s^p", 0, 0, -0.65, 0);
  sketch.arrow("", "force m g", 0, 1, 0, 0.4);
  sketch.arrow("", "way v", 0, 1, 0.65, 1);
  sketch.turn("", "spin", 0, 1, 0.75, 0.85 * pi, 0.3 * pi);
  return table;
}

namespace {

/// Beads of radius 1 and a ball on a line, in the frame of the line, then turned downhill by `slope`.
void add_line_of_beads(Sketch& sketch, double slope, double gap, double size_ratio, int from, int to) {
  const auto turned = [slope](double x, double z) {
    return std::pair{x * std::cos(slope) + z * std::sin(slope), -x * std::sin(slope) + z * std::cos(slope)};
  };
  const double pitch = 2 * (1 + gap);
  for (int k = from; k <= to; ++k) {
    const auto [x, z] = turned(pitch * k, 0);
    sketch.arc("", fmt::format("bead {}", k - from + 1).c_str(), x, z, 1, 0, 2 * pi);
  }
  const auto [x, z] = turned(-pitch / 2, std::sqrt((1 + size_ratio) * (1 + size_ratio) - pitch * pitch / 4));
  sketch.arc("", "ball", x, z, size_ratio, 0, 2 * pi);
}

}  // namespace

/// The set-up of chapter 4: a ball of radius R = Φ r on a rough incline.
FigureTable compute_fig_4_01(const FigureContext&) {
  constexpr double slope = 0.3, size_ratio = 2;
  FigureTable table;
  table.comments = {"x: horizontal, in bead radii", "y: vertical, in bead radii",
                    "R = 2 r, theta = 0.3, touching beads"};
  Sketch sketch(table);
  add_line_of_beads(sketch, slope, 0, size_ratio, -3, 3);
  const double s = std::sin(slope), c = std::cos(slope);
  sketch.line("", "plane", -8 * c - s, 8 * s - c, 8 * c - s, -8 * s - c);
  sketch.line("", "axis level", 8 * c - s, -8 * s - c, 2, -8 * s - c);
  sketch.arc("", "angle", 8 * c - s, -8 * s - c, 4, pi - slope, pi);
  sketch.arrow("", "way x", 3.5 * c + 2.2 * s, -3.5 * s + 2.2 * c, 5.3 * c + 2.2 * s, -5.3 * s + 2.2 * c);
  sketch.arrow("", "way z", 3.5 * c + 2.2 * s, -3.5 * s + 2.2 * c, 3.5 * c + 4 * s, -3.5 * s + 4 * c);
  sketch.arrow("", "gravity", 5.8, 4.4, 5.8, 2.6);
  return table;
}

/// The angle γ at its most negative value, (4.21): the ball lies on the bead behind when it hits the next.
FigureTable compute_fig_4_03(const FigureContext&) {
  constexpr double gap = 0.25, size_ratio = 2;
  FigureTable table;
  table.comments = {
      "x: along the line, in bead radii", "y: away from it, in bead radii",
      "R = 2 r, eps = 0.25; gamma is negative on the uphill side of a bead; sin gamma_max = (1 + eps)/(1 + Phi) (4.21)"};
  Sketch sketch(table);
  add_line_of_beads(sketch, 0, gap, size_ratio, -2, 1);
  const double x = -(1 + gap), z = std::sqrt((1 + size_ratio) * (1 + size_ratio) - x * x);
  sketch.line("", "axis z", 0, 0, 0, 4.2);
  sketch.line("", "normal", 0, 0, x, z);
  sketch.arc("", "angle", 0, 0, 1.7, pi / 2, pi / 2 + std::asin(-x / (1 + size_ratio)));
  sketch.line("", "axis gap from", 1, -1.5, 1, -0.6);
  sketch.line("", "axis gap to", 1 + 2 * gap, -1.5, 1 + 2 * gap, -0.6);
  sketch.arrow("", "way", x, z, x + 1.6, z - 0.35);
  return table;
}

}  // namespace chute::theory
