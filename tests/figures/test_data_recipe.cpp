#include <catch2/catch.hpp>

#include "common/error.hpp"
#include "figures/data_recipe.hpp"

namespace data_recipe_tests {
using namespace chute;

namespace {

figures::DataRecipe read(const std::string& curve) {
  const auto table = parse_toml(
      "scene = \"ball.toml\"\nx = \"x\"\ny = \"y\"\n[[curve]]\nseries = \"peak 2\"\n" + curve, "figure.toml");
  TomlReader reader(table, "figure.toml");
  figures::DataRecipe recipe;
  describe(reader, recipe);
  reader.finish();
  return recipe;
}

}  // namespace

TEST_CASE("a curve along which a key varies becomes a curve per value, on top of its own settings") {
  const auto recipe = read(
      "extract = \"peak\"\ncolumn = \"gamma\"\npeak = 2\nset = [\"bed.gap=0.1\"]\n"
      "vary = \"incline.sin\"\nvalues = [0.05, 0.1]");
  REQUIRE(recipe.curves.size() == 2);
  CHECK(recipe.curves[0].at == 0.05);
  CHECK(recipe.curves[0].set == std::vector<std::string>{"bed.gap=0.1", "incline.sin=0.05"});
  CHECK(recipe.curves[1].at == 0.1);
  CHECK(recipe.curves[1].set == std::vector<std::string>{"bed.gap=0.1", "incline.sin=0.1"});
  CHECK(recipe.curves[1].series == "peak 2");
  CHECK(recipe.curves[1].peak == 2);
}

TEST_CASE("a peak needs what it is drawn against; other extracts know no such keys") {
  const std::string peak = "extract = \"peak\"\ncolumn = \"gamma\"\n";
  CHECK_THROWS_WITH(read(peak), Catch::Contains("vary: missing"));
  CHECK_THROWS_WITH(read(peak + "vary = \"incline.sin\"\nvalues = []"),
                    Catch::Contains("figure.toml:") && Catch::Contains("at least one value"));
  CHECK_THROWS_WITH(read(peak + "bandwidth = 0\nvary = \"incline.sin\"\nvalues = [0.1]"),
                    Catch::Contains("bandwidth"));
  CHECK_THROWS_AS(read("column = \"gamma\"\nvary = \"incline.sin\"\nvalues = [0.1]"), InputError);
}

}  // namespace data_recipe_tests
