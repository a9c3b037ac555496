#include "figures/data_recipe.hpp"

#include <fmt/format.h>

namespace chute::figures {
namespace {
using namespace std::string_view_literals;
constexpr std::array extract_words{
    "histogram"sv, "return-map"sv, "scatter"sv,        "peak"sv,   "profile"sv, "series"sv,
    "last"sv,      "pressure"sv,   "value"sv,          "mean"sv,   "line"sv,    "map"sv,
    "spectrum"sv,  "avalanches"sv, "mean-avalanche"sv, "table"sv,  "cooling"sv, "rate"sv,
    "record"sv,    "network"sv,    "depth"sv,          "janssen"sv};

bool is_point_by_point(Extract extract) {
  return extract == Extract::peak || extract == Extract::last || extract == Extract::pressure ||
         extract == Extract::value || extract == Extract::mean || extract == Extract::rate ||
         extract == Extract::record;
}
}  // namespace

static void describe(TomlReader& a, Where& where) {
  a.required("column", where.column);
  a.value("absolute", where.absolute);
  a.value("low", where.low);
  a.value("high", where.high);
}

static void describe(TomlReader& a, Curve& curve) {
  a.value("panel", curve.panel);
  a.required("series", curve.series);
  a.value("set", curve.set);
  a.value("quick", curve.quick);
  a.value("runs", curve.runs);
  a.check(curve.runs.empty() || curve.set.empty(), "set",
          "changes a scene; runs that are there cannot be changed");
  a.choice("extract", curve.extract, extract_words);
  const bool line = curve.extract == Extract::line, table = curve.extract == Extract::table;
  const bool mean = curve.extract == Extract::mean, value = curve.extract == Extract::value || mean;
  const bool avalanches = curve.extract == Extract::avalanches;
  if (avalanches || curve.extract == Extract::mean_avalanche)
    a.required("length", curve.length, positive);
  else if (!line)
    a.required("column", curve.column);
  if (avalanches) {
    a.value("collapse", curve.collapse);
    a.check(!curve.collapse || curve.collapse->size() == 2, "collapse", "must be [tau, D]");
  }
  const bool scatter = curve.extract == Extract::scatter, histogram = curve.extract == Extract::histogram;
  if (scatter || table) a.required("against", curve.against);
  if (scatter) a.value("absolute_x", curve.absolute_x);
  if (value || table) a.required("file", curve.file);
  if (histogram || scatter) a.value("file", curve.file);
  if (histogram || scatter || mean) a.sections("where", curve.where);
  const bool rate = curve.extract == Extract::rate || curve.extract == Extract::record;
  if (histogram || value || rate || curve.extract == Extract::network) a.value("scale", curve.scale);
  if (value || rate)
    a.value("x_power", curve.x_power, at_least(0)), a.value("x_scale", curve.x_scale, positive);
  if (curve.extract == Extract::cooling) {
    a.required("packing", curve.packing, between(1e-6, 0.9));
    a.required("restitution", curve.restitution, between(0, 1));
  }
  if (line) a.required("slope", curve.slope);
  if (histogram) a.value("over_sine", curve.over_sine), a.value("times_velocity", curve.times_velocity);
  if (histogram) a.value("bins", curve.bins, between(2, 100000));
  if (histogram || line) {
    a.value("range", curve.range);
    a.check(!curve.range || (curve.range->size() == 2 && (*curve.range)[0] < (*curve.range)[1]), "range",
            "must be [low, high] with low < high");
  }
  if (histogram || scatter) a.value("fold", curve.fold, non_negative), a.value("absolute", curve.absolute);
  if (scatter || curve.extract == Extract::return_map) a.value("most", curve.most, at_least(1));
  if (curve.extract == Extract::profile) a.value("fine", curve.fine);
  a.check(!line || curve.range, "range", "a line needs range = [low, high]");
  if (curve.extract == Extract::peak) {
    a.value("peak", curve.peak, between(0, 100));
    a.value("bandwidth", curve.bandwidth, positive);
    a.value("widest", curve.widest, positive);
  }
  if (is_point_by_point(curve.extract)) {
    a.required("vary", curve.vary);
    a.required("values", curve.values);
    a.check(!curve.values.empty(), "values", "must hold at least one value");
    a.value("quick_count", curve.quick_count, at_least(2));
  }
  a.check(curve.series.find_first_of(",\"\n") == std::string::npos, "series",
          "must not hold commas, quotes or line breaks");
}

/// A curve along which a key of the scene changes becomes one curve per value, under the same name.
static std::vector<Curve> point_by_point(const std::vector<Curve>& curves) {
  std::vector<Curve> points;
  for (const auto& curve : curves) {
    if (!curve.vary) points.push_back(curve);
    const std::size_t all = curve.values.size();
    const auto few = static_cast<std::size_t>(curve.quick_count.value_or(static_cast<std::int64_t>(all)));
    for (std::size_t k = 0, taken = 0; k < all; ++k) {
      Curve point = curve;
      const double value = point.at = curve.values[k];
      // The first and the last one, and evenly between them
      point.full_only = few < all && k != taken * (all - 1) / (few - 1);
      if (!point.full_only) ++taken;
      point.set.push_back(fmt::format("{}={}", *curve.vary, value));
      points.push_back(std::move(point));
    }
  }
  return points;
}

void describe(TomlReader& a, DataRecipe& recipe) {
  a.value("scene", recipe.scene);
  a.value("compute", recipe.compute);
  a.value("table", recipe.table);
  a.sections("experiment", recipe.experiments);
  const int sources = (recipe.scene.has_value() || recipe.compute.has_value()) + recipe.table.has_value() +
                      !recipe.experiments.empty();
  a.check(sources <= 1, "scene",
          "give one of scene (simulate; perhaps with compute, a built-in computation, beside it), "
          "experiment, table "
          "(a CSV file), or curves with runs");
  a.sections("ratio", recipe.ratios);
  if (!recipe.scene && (recipe.compute || recipe.table || !recipe.experiments.empty())) return;
  a.value("set", recipe.set);
  a.value("quick", recipe.quick);
  a.value("seeds", recipe.seeds, between(1, 10000));
  a.value("quick_seeds", recipe.quick_seeds, between(1, 10000));
  a.required("x", recipe.x);
  a.required("y", recipe.y);
  a.value("notes", recipe.notes);
  a.sections("curve", recipe.curves);
  recipe.curves = point_by_point(recipe.curves);
  a.sections("sweep", recipe.sweeps);
  a.sections("fit", recipe.fits);
  a.check(!recipe.curves.empty() || !recipe.sweeps.empty(), "curve",
          "a figure needs at least one [[data.curve]] or [[data.sweep]]");
  a.check(recipe.sweeps.empty() || recipe.scene, "sweep", "needs a scene to change");
  recipe.runs = !recipe.scene;
  for (const auto& curve : recipe.curves)
    a.check(
        curve.runs.empty() == !recipe.runs, "curve",
        recipe.runs ? "without a scene every curve names its runs" : "give either a scene or runs, not both");
}

}  // namespace chute::figures
