#include <cmath>
#include <numbers>

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

}  // namespace chute::theory
