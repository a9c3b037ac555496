#include "experiments/recipe.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>

#include "common/atomic_file.hpp"
#include "common/keys.hpp"
#include "experiments/curves.hpp"
#include "experiments/perform.hpp"

namespace chute::experiments {
namespace {
using namespace std::string_view_literals;
constexpr std::array spacing_words{"even"sv, "log"sv};
}  // namespace

template <class Archive>
static void describe(Archive& a, ExperimentCurve& curve) {
  constexpr bool all = !Archive::reading;
  a.value("panel", curve.panel, "of the series");
  a.required("series", curve.series, "its name");
  a.value("set", curve.set, "key=value for its scene, on top of the recipe's");
  a.value("quick", curve.quick, "and with --quick");
  a.value("quantity", curve.quantity, "instead of the recipe's");
  a.value("by_curvature", curve.smooth,
          "that of the recipe for this curve alone, such as a closed form beside points");
  a.value("values", curve.values, "of the varied key, instead of the recipe's");
  a.value("power_law", curve.power_law, "instead of experiments: 1 − y = a x^p with this p");
  if (all || curve.power_law)
    a.required("power_law_at", curve.power_law_at, positive, "through the experiment at this x");
  a.check(curve.series.find_first_of(",\"\n") == std::string::npos, "series",
          "must not hold commas, quotes or line breaks");
}

template <class Archive>
static void describe_keys(Archive& a, ExperimentRecipe& recipe) {
  a.required("scene", recipe.scene, "of the experiment, relative to the recipe");
  a.value("set", recipe.set, "key=value for all");
  a.value("quick", recipe.quick, "and with --quick");
  a.required("vary", recipe.vary, "the key on the x axis");
  a.required("from", recipe.from, "its first value");
  a.required("to", recipe.to, "its last value");
  a.choice("spacing", recipe.spacing, spacing_words, "of the values between");
  a.value("count", recipe.count, between(2, 100000), "of values");
  a.value("quick_count", recipe.quick_count, between(2, 100000), "of a quick figure");
  a.value("by_curvature", recipe.by_curvature,
          "and further values wherever the curves bend, whatever --quick says");
  a.value("more", recipe.more, "further values");
  a.required("quantity", recipe.quantity, "on the y axis: a result, as chute run prints them");
  a.required("x", recipe.x, "what x is, with its unit: a comment of the CSV");
  a.required("y", recipe.y, "what y is");
  a.value("notes", recipe.notes, "further comments");
  a.sections("curve", recipe.curves);
}
void describe(KeyLister& a, ExperimentRecipe& recipe) { describe_keys(a, recipe); }
void describe(TomlReader& a, ExperimentRecipe& recipe) {
  describe_keys(a, recipe);
  a.check(recipe.spacing == ExperimentRecipe::Spacing::even || (recipe.from > 0 && recipe.to > 0), "from",
          "and to must be > 0 with spacing = \"log\"");
  a.check(!recipe.curves.empty(), "curve", "a figure needs at least one [[data.experiment.curve]]");
}

namespace {

std::vector<double> values_of(const ExperimentRecipe& recipe, bool quick) {
  const auto count = static_cast<int>(quick ? recipe.quick_count : recipe.count);
  auto values = recipe.spacing == ExperimentRecipe::Spacing::even
                    ? evenly(recipe.from, recipe.to, count)
                    : logarithmically(recipe.from, recipe.to, count);
  values.insert(values.end(), recipe.more.begin(), recipe.more.end());
  return values;
}

/// The quantity at a value of the varied key.
std::function<double(double)> measurement(const ExperimentRecipe& recipe, const ExperimentCurve& curve,
                                          const std::filesystem::path& scene, bool quick) {
  auto settings = recipe.set;
  settings.insert(settings.end(), curve.set.begin(), curve.set.end());
  for (const auto* more : {&recipe.quick, &curve.quick})
    if (quick) settings.insert(settings.end(), more->begin(), more->end());
  const auto measure = [=, text = read_file(scene), vary = recipe.vary,
                        quantity = curve.quantity.value_or(recipe.quantity)](double x) {
    auto all = settings;
    all.push_back(fmt::format("{}={}", vary, x));
    return perform(parse_experiment(text, scene.string(), all))[quantity];
  };
  if (!curve.power_law) return measure;
  const double at = *curve.power_law_at, p = *curve.power_law,
               amplitude = (1 - measure(at)) / std::pow(at, p);
  return [=](double x) { return 1 - amplitude * std::pow(x, p); };
}

}  // namespace

figures::FigureTable make_table(std::span<const ExperimentRecipe> recipes,
                                const std::filesystem::path& recipe_file,
                                const figures::FigureContext& context,
                                const std::function<bool(double)>& progress) {
  figures::FigureTable table;
  std::vector<ComputedCurve> curves;
  for (const auto& recipe : recipes) {
    const auto values = values_of(recipe, context.quick);
    for (const auto& curve : recipe.curves)
      curves.push_back({curve.panel, curve.series, curve.values.value_or(values),
                        measurement(recipe, curve, recipe_file.parent_path() / recipe.scene, context.quick),
                        recipe.by_curvature || curve.smooth,
                        recipe.spacing == ExperimentRecipe::Spacing::logarithmic});
    table.comments.push_back(fmt::format("x: {}", recipe.x));
    table.comments.push_back(fmt::format("y: {}", recipe.y));
    table.comments.insert(table.comments.end(), recipe.notes.begin(), recipe.notes.end());
    table.comments.push_back(
        fmt::format("{}experiments of {}{}{}", recipes.size() > 1 ? recipe.curves[0].panel + ": " : "",
                    recipe.scene, recipe.set.empty() ? "" : " with ", fmt::join(recipe.set, " ")));
    note_quick(table, context, fmt::format("{} values, {}", values.size(), fmt::join(recipe.quick, " ")));
  }
  table.rows = evaluate(curves, context.jobs, progress);
  return table;
}

}  // namespace chute::experiments
