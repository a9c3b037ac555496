#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "figures/data_recipe.hpp"

namespace chute::figures {

/// For each panel of a recipe that simulates, which of its scenes' usual parameters are the same in all its curves, as the
/// comment "parameters a: Phi=2.5 sin(theta)=0.057" that plots show above the panel (plot/parameters.hpp). What varies along
/// the curves, or from one to the next, is not among them. `quick` does not matter: these are no quick settings.
std::vector<std::string> held_fixed(const DataRecipe& recipe, const std::filesystem::path& recipe_file);

}  // namespace chute::figures
