#include "experiments/recipe.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>

#include "common/atomic_file.hpp"
#include "experiments/curves.hpp"
#include "experiments/perform.hpp"

namespace chute::experiments {
namespace {
using namespace std::string_view_literals;
constexpr std::array spacing_words{"even"sv, "log"sv};
}  // namespace

static void describe(TomlReader& a, ExperimentCurve& curve) {
  a.value("panel", curve.panel);
  a.required("series", curve.series);
  a.value("set", curve.set);
  a.value("quick", curve.quick);
  a.value("quantity", curve.quantity);
  a.value("by_curvature", curve.smooth);
  a.value("values", curve.values);
  a.value("power_law", curve.power_law);
  if (curve.power_law) a.required("power_law_at", curve.power_law_at, positive);
  a.check(curve.series.find_first_of(",\"\n") == std::string::npos, "series",
          "must not hold commas, quotes or line breaks");
}

void describe(TomlReader& a, ExperimentRecipe& recipe) {
  a.required("scene", recipe.scene);
  a.value("set", recipe.set);
  a.value("quick", recipe.quick);
  a.required("vary", recipe.vary);
  a.required("from", recipe.from);
  a.required("to", recipe.to);
  a.choice("spacing", recipe.spacing, spacing_words);
  a.value("count", recipe.count, between(2, 100000));
  a.value("quick_count", recipe.quick_count, between(2, 100000));
  a.value("by_curvature", recipe.by_curvature);
  a.value("more", recipe.more);
  a.required("quantity", recipe.quantity);
  a.required("x", recipe.x);
  a.required("y", recipe.y);
  a.value("notes", recipe.notes);
  a.sections("curve", recipe.curves);
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
