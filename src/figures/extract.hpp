#pragma once
#include <filesystem>
#include <optional>
#include <span>

#include "common/figure_table.hpp"
#include "figures/data_recipe.hpp"

namespace chute::figures {

/// The rows of one curve from the files of its runs (the same scene with different seeds). Histograms and
/// dots join the runs; profiles and series average over them, with the standard error over the runs, or, if
/// there is only one, with the error that the run itself states. InputError if a file is missing or damaged.
std::vector<FigureRow> extract(const Curve& curve, std::span<const std::filesystem::path> runs);

/// The part of the rows that the curve's `where` leaves out; empty if it has none.
std::optional<double> left_out(const Curve& curve, std::span<const std::filesystem::path> runs);

}  // namespace chute::figures
