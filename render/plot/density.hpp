#pragma once
#include "plot/figure.hpp"

namespace chute::plot {

/// More dots than these run together, and how many lie in one place can no longer be seen.
inline constexpr std::size_t most_dots = 10'000;

/// Turns the cloud of a panel that has no other series, and more dots than that, into a map of how many lie in each cell, on
/// a logarithmic scale of colours. Dots outside the limits that the axes have stay dots, and so become arrows at the frame.
void draw_crowd_as_density(Panel& panel);

/// The same in all panels; those that show one quantity, by the labels of their axes, get one range of it, unless the figure wants
/// its own for each.
void draw_crowds_as_densities(Figure& figure);

}  // namespace chute::plot
