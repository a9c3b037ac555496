#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/figure_table.hpp"
#include "common/toml_reader.hpp"

namespace chute {
class KeyLister;
}
namespace chute::experiments {

/// One curve: how its experiment differs.
struct ExperimentCurve {
  std::string panel, series;
  std::vector<std::string> set;         ///< key=value, on top of the recipe's
  std::vector<std::string> quick;       ///< and with --quick
  std::optional<std::string> quantity;  ///< instead of the recipe's
  bool smooth = false;  ///< `by_curvature` for this curve alone, such as a closed form beside points
  std::optional<std::vector<double>> values;  ///< of the varied key, instead of the recipe's
  /// Instead of experiments: 1 − y = a x^p with the exponent p, through the experiment at x = `power_law_at`.
  std::optional<double> power_law, power_law_at;
};

/// [[data.experiment]] of a figure recipe: a result of an experiment against one of its keys.
struct ExperimentRecipe {
  std::string scene;               ///< relative to the recipe
  std::vector<std::string> set;    ///< key=value for all
  std::vector<std::string> quick;  ///< and with --quick
  std::string vary;                ///< the key on the x axis: "experiment.psi"
  double from = 0, to = 0;         ///< its values
  enum class Spacing { even, logarithmic } spacing = Spacing::even;
  std::int64_t count = 50, quick_count = 10;
  bool by_curvature = false;       ///< and further values wherever the curves bend, whatever --quick says
  std::vector<double> more;        ///< further values
  std::string quantity;            ///< on the y axis: a result, as chute run prints them
  std::string x, y;                ///< what they are, with units: comments of the CSV
  std::vector<std::string> notes;  ///< further comments
  std::vector<ExperimentCurve> curves;
};

void describe(TomlReader& a, ExperimentRecipe& recipe);
void describe(KeyLister& a, ExperimentRecipe& recipe);

/// Does the experiments of a recipe file, `context.jobs` at a time.
figures::FigureTable make_table(std::span<const ExperimentRecipe> recipes,
                                const std::filesystem::path& recipe_file,
                                const figures::FigureContext& context,
                                const std::function<bool(double)>& progress = {});

}  // namespace chute::experiments
