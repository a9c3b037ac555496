#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "common/figure_table.hpp"
#include "figures/data_recipe.hpp"

namespace chute::figures {

/// Of a run's cells the field against x, averaged over the other directions: one series a file, `NAME t=TIME`. Of the first run.
std::vector<FigureRow> field_map(const Curve& curve, std::span<const std::filesystem::path> runs);

/// How the same average fluctuates in time at a place: its power spectrum, averaged over places and gathered in bins of equal
/// width on a logarithmic axis; x is the frequency. Over all runs.
std::vector<FigureRow> spectrum(const Curve& curve, std::span<const std::filesystem::path> runs);

/// P(s) of avalanches' sizes in bins of equal width on a logarithmic axis, or s^τ P(s) against s/L^D.
std::vector<FigureRow> avalanche_sizes(const Curve& curve, std::span<const std::filesystem::path> runs);

/// ⟨s⟩ against L.
std::vector<FigureRow> mean_avalanche(const Curve& curve, std::span<const std::filesystem::path> runs);

}  // namespace chute::figures
