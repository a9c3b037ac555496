#pragma once
#include "scene.hpp"

namespace chute::contact::test {

/// A heap of grains on a triangular lattice over a floor, pressed down and aside by one step of gravity, with some
/// places empty and the velocities a little disturbed, so that contacts stick, slide and open.
inline Scene<2> heap(int columns, int rows, double mu, unsigned seed = 1) {
  std::mt19937 dice(seed);
  std::uniform_real_distribution<double> share(-1, 1);
  Scene<2> scene;
  std::vector<int> grain(static_cast<std::size_t>(columns * rows), -1);
  const auto at = [&](int column, int row) -> int& {
    return grain[static_cast<std::size_t>(row * columns + column)];
  };
  const double across = std::sqrt(0.75);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column + row < columns; ++column) {
      if (row > 0 && (at(column, row - 1) < 0 || at(column + 1, row - 1) < 0 || share(dice) > 0.9)) continue;
      const int i = at(column, row) = scene.body(1, 0.125, {{0.002 + 0.001 * share(dice), -0.01}});
      if (row == 0) {
        scene.touch(i, -1, {{0, 1}}, mu);
      } else {
        scene.touch(i, at(column, row - 1), {{0.5, across}}, mu);
        scene.touch(i, at(column + 1, row - 1), {{-0.5, across}}, mu);
      }
      if (column > 0 && at(column - 1, row) >= 0) scene.touch(i, at(column - 1, row), {{1, 0}}, mu);
    }
  return scene;
}

/// Spheres on a square lattice, each layer in the hollows of the one below.
inline Scene<3> heap_of_spheres(int side, double mu, unsigned seed = 1) {
  std::mt19937 dice(seed);
  std::uniform_real_distribution<double> share(-1, 1);
  Scene<3> scene;
  std::vector<std::vector<int>> layers;
  const double s = 0.5, up = std::sqrt(0.5);
  for (int layer = 0; layer < side; ++layer) {
    const int n = side - layer;
    layers.emplace_back();
    for (int k = 0; k < n * n; ++k) {
      const int i = scene.body(1, 0.1, {{0.002 + 0.001 * share(dice), 0.001 * share(dice), -0.01}});
      layers.back().push_back(i);
      if (layer == 0) {
        scene.touch(i, -1, {{0, 0, 1}}, mu);
        continue;
      }
      for (const int dx : {0, 1})
        for (const int dy : {0, 1}) {
          const int below = layers[static_cast<std::size_t>(layer - 1)]
                                  [static_cast<std::size_t>((k / n + dy) * (n + 1) + k % n + dx)];
          scene.touch(i, below, {{dx ? -s : s, dy ? -s : s, up}}, mu);
        }
    }
  }
  return scene;
}

}  // namespace chute::contact::test
