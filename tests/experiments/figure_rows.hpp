#pragma once
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/atomic_file.hpp"
#include "experiments/computed_figures.hpp"
#include "experiments/recipe.hpp"

/// The figures of the chapters on contact laws, and their rows as a reader of the CSV sees them.
namespace chute::test {

/// All figures of the chapters on contact laws.
inline const std::vector<std::string> law_figures{"fig-1-06", "fig-2-02", "fig-2-15", "fig-3-01", "fig-3-02",
                                                  "fig-3-03", "fig-3-04", "fig-3-05", "fig-3-06", "fig-3-07",
                                                  "fig-3-08", "fig-3-10", "table-3-1"};

/// The table of a figure: a computation, or the experiments of its recipe in scenes/.
inline experiments::FigureTable make_figure(const std::string& id,
                                            const experiments::FigureContext& context) {
  const auto& list = experiments::computed_figures();
  if (list.contains(id)) return list.at(id)(context);
  const auto file = std::filesystem::path(CHUTE_SOURCE_DIR) / "scenes" / (id + ".toml");
  const auto table = parse_toml(read_file(file), file.string());
  TomlReader reader(*table["data"].as_table(), file.string(), "data");
  std::vector<experiments::ExperimentRecipe> recipes;
  reader.sections("experiment", recipes);
  reader.finish();
  return experiments::make_table(recipes, file, context);
}

struct Points {
  std::vector<double> x, y, y_err;

  /// y at x, linear between the rows.
  double at(double where) const {
    for (std::size_t k = 1; k < x.size(); ++k)
      if (where <= x[k]) return y[k - 1] + (where - x[k - 1]) / (x[k] - x[k - 1]) * (y[k] - y[k - 1]);
    return y.back();
  }
  /// The last x where y changes from negative to positive; 0 if it never does.
  double zero() const {
    double where = 0;
    for (std::size_t k = 1; k < x.size(); ++k)
      if (y[k - 1] < 0 && y[k] >= 0) where = x[k - 1] - y[k - 1] / (y[k] - y[k - 1]) * (x[k] - x[k - 1]);
    return where;
  }
};

class Rows {
 public:
  explicit Rows(const std::string& id, bool quick = false) {
    const auto& table = computed(id, quick);
    for (const auto& row : table.rows) {
      REQUIRE(std::isfinite(row.x));
      REQUIRE(std::isfinite(row.y));
      auto& p = points_[{row.panel, row.series}];
      p.x.push_back(row.x);
      p.y.push_back(row.y);
      p.y_err.push_back(row.y_err.value_or(NAN));
    }
    REQUIRE(table.comments.size() >= 3);
    REQUIRE(table.comments[0].starts_with("x: "));
    REQUIRE(table.comments[1].starts_with("y: "));
  }
  const Points& operator()(const std::string& series, const std::string& panel = "") const {
    return points_.at({panel, series});
  }
  std::vector<std::pair<std::string, std::string>> names() const {
    std::vector<std::pair<std::string, std::string>> all;
    for (const auto& [name, p] : points_) all.push_back(name);
    return all;
  }

 private:
  std::map<std::pair<std::string, std::string>, Points> points_;

  static const experiments::FigureTable& computed(const std::string& id, bool quick) {
    static std::map<std::pair<std::string, bool>, experiments::FigureTable> known;
    const auto [at, is_new] = known.try_emplace({id, quick});
    if (is_new) at->second = make_figure(id, {quick, 2});
    return at->second;
  }
};

}  // namespace chute::test
