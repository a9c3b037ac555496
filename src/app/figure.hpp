#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/figure_table.hpp"

namespace chute::app {

struct KnownFigure {
  std::string id, title;
  std::filesystem::path recipe;
};

/// All figure recipes that come with chute, ordered by id.
std::vector<KnownFigure> known_figures();

/// Words for many figures at once, and what they are.
struct FigureGroup {
  const char *word, *meaning;
  std::vector<const char*> beginnings;  ///< of the ids that belong to it
};
const std::vector<FigureGroup>& figure_groups();
/// The recipes of a group, of a figure that is known, or of a file.
std::vector<std::filesystem::path> find_recipes(const std::string& name);

/// The recipe of an id, or the file of that name; of `-` the name that stands for standard input. InputError, with the nearest id, if there is none.
std::filesystem::path find_recipe(const std::string& name);

/// Says what making a figure would take, without simulating or writing anything: a recipe of data that are there is read and laid
/// out. InputError as make_figure, where that can be known before.
std::string check_figure(const std::filesystem::path& recipe, const std::filesystem::path& directory,
                         const figures::FigureContext& context);

/// Every key that a recipe can have, table by table: `chute figure --keys` and the README.
std::string figure_keys();

/// Makes DIR/ID.csv, .png, .pdf and .svg from a recipe. Tells what a referee finds wrong with the picture (plot/referee.hpp), a line each.
std::vector<std::string> make_figure(const std::filesystem::path& recipe,
                                     const std::filesystem::path& directory,
                                     const figures::FigureContext& context,
                                     const std::function<bool(double)>& progress);

}  // namespace chute::app
