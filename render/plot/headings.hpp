#pragma once
#include <string>
#include <vector>

#include "plot/figure.hpp"
#include "plot/mathtext.hpp"

namespace chute::plot {

/// What stands above a panel: its letter, what it shows and what was held fixed.
std::string heading(const Panel& panel);

/// The same in as many lines as it takes, each set in
/// type of this size and no wider than `width`.
std::vector<TextBox> heading_lines(const Panel& panel, double size, double width);

}  // namespace chute::plot
