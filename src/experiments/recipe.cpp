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

figures::FigureTable make_table(const ExperimentRecipe& recipe, const std::filesystem::path& recipe_file,
                                const figures::FigureContext& context,
                                const std::function<bool(double)>& progress) {
  const auto scene = recipe_file.parent_path() / recipe.scene;
  const auto text = read_file(scene);
  const auto count = static_cast<int>(context.quick ? recipe.quick_count : recipe.count);
  auto values = recipe.spacing == ExperimentRecipe::Spacing::even
                    ? evenly(recipe.from, recipe.to, count)
                    : logarithmically(recipe.from, recipe.to, count);
  values.insert(values.end(), recipe.more.begin(), recipe.more.end());

  std::vector<ComputedCurve> curves;
  for (const auto& curve : recipe.curves) {
    auto settings = recipe.set;
    settings.insert(settings.end(), curve.set.begin(), curve.set.end());
    for (const auto* quick : {&recipe.quick, &curve.quick})
      if (context.quick) settings.insert(settings.end(), quick->begin(), quick->end());
    const auto quantity = curve.quantity.value_or(recipe.quantity);
    const auto measure = [&, settings, quantity](double x) {
      auto all = settings;
      all.push_back(fmt::format("{}={}", recipe.vary, x));
      return perform(parse_experiment(text, scene.string(), all))[quantity];
    };
    std::function<double(double)> y = measure;
    if (curve.power_law) {
      const double at = *curve.power_law_at, p = *curve.power_law,
                   amplitude = (1 - measure(at)) / std::pow(at, p);
      y = [=](double x) { return 1 - amplitude * std::pow(x, p); };
    }
    curves.push_back({curve.panel, curve.series, curve.values.value_or(values), y});
  }

  figures::FigureTable table;
  table.comments = {fmt::format("x: {}", recipe.x), fmt::format("y: {}", recipe.y)};
  table.comments.insert(table.comments.end(), recipe.notes.begin(), recipe.notes.end());
  table.comments.push_back(fmt::format("experiments of {}{}{}", recipe.scene,
                                       recipe.set.empty() ? "" : " with ", fmt::join(recipe.set, " ")));
  table.rows = evaluate(curves, context.jobs, progress);
  note_quick(table, context, fmt::format("{} points, {}", count, fmt::join(recipe.quick, " ")));
  return table;
}

}  // namespace chute::experiments
