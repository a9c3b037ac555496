#pragma once
#include <filesystem>
#include <functional>

#include "common/figure_table.hpp"
#include "figures/data_recipe.hpp"

namespace chute::figures {

/// What simulating a recipe would take.
struct Work {
  std::size_t runs = 0, there = 0;  ///< of those in the folder already
  double seconds = 0;               ///< of one core, about
};
/// Reads all scenes of a recipe with a scene; InputError if one is wrong.
Work work_of(const DataRecipe& recipe, const std::filesystem::path& recipe_file,
             const std::filesystem::path& work, bool quick);

/// Makes a figure's table, from runs that the curves name, or else from a scene: simulates what it needs, in
/// run directories under `work` that are used again if they hold the finished run of the same scene by the
/// same build, and extracts the rows. `recipe_file` anchors relative paths.
FigureTable simulate(const DataRecipe& recipe, const std::filesystem::path& recipe_file,
                     const std::filesystem::path& work, const FigureContext& context,
                     const std::string& command_line, const std::function<bool(double)>& progress);

}  // namespace chute::figures
