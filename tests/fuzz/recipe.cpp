#include "plot/recipe.hpp"

#include "common/toml_reader.hpp"
#include "experiments/recipe.hpp"
#include "figures/data_recipe.hpp"
#include "plot/layout.hpp"
#include "read/table.hpp"
#include "targets.hpp"

namespace chute::fuzz {
namespace {

/// What `chute figure` reads: see src/app/figure.cpp.
struct Recipe {
  std::string title;
  figures::DataRecipe data;
  plot::PlotRecipe plot;
};

constexpr std::string_view numbers =
    "panel,series,x,y,x_err,y_err\n"
    "a,first,1,2,0.1,0.2\n"
    "a,first,2,3,,0.2\n"
    "a,second,3,-1e-3,,\n"
    "b,second,4,1e300,,\n"
    "b,theory,5,,,\n";

}  // namespace

static void describe(TomlReader& a, Recipe& recipe) {
  a.required("title", recipe.title);
  a.required_section("data", recipe.data);
  a.section("plot", recipe.plot);
}

void recipe(std::string_view bytes) {
  const auto parsed = parse_toml(bytes, "recipe.toml");
  TomlReader reader(parsed, "recipe.toml");
  Recipe recipe;
  recipe.plot.source = "recipe.toml";
  describe(reader, recipe);
  reader.finish();
  plot::lay_out(plot::figure_from(recipe.plot, read::parse_table(numbers, "recipe.csv")));
}

}  // namespace chute::fuzz
