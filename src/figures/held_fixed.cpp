#include "figures/held_fixed.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <set>
#include <span>

#include "common/toml_reader.hpp"
#include "scene/scene.hpp"

namespace chute::figures {
namespace {

struct Parameter {
  const char* key;   ///< of the scene
  const char* name;  ///< as series are named
};
/// What captions tell, in their order.
constexpr std::array parameters{
    Parameter{"grains.size_ratio", "Phi"},         Parameter{"incline.sin", "sin(theta)"},
    Parameter{"incline.angle", "theta"},           Parameter{"bed.gap", "eps"},
    Parameter{"bed.gap_max", "eps_max"},           Parameter{"contact.normal.restitution", "e_n"},
    Parameter{"contact.tangential.friction", "mu"}};

/// What is the same along a whole figure is told by another name if an engine has its own.
constexpr std::array engine_parameters{Parameter{"engine.restitution", "e_n"},
                                       Parameter{"engine.friction", "mu"}};

/// "14.4 deg" and "0.05 rad" stand in scenes; names of series have no blanks.
std::optional<std::string> text_of(const toml::node_view<const toml::node>& node) {
  if (const auto number = node.value<double>(); number && !node.is_string())
    return fmt::format("{:.6g}", *number);
  auto text = node.value<std::string>();
  if (!text) return {};
  std::erase(*text, ' ');
  return text->ends_with("rad") ? text->substr(0, text->size() - 3) : *text;
}

using Values = std::map<std::string, std::string>;

/// The parameters of one run; but those along which it is only one of many.
Values values_of(const std::filesystem::path& scene_file, const std::vector<std::string>& settings,
                 const std::set<std::string>& varied) {
  const auto told = scene::read_scene(scene_file, settings);
  const auto table = parse_toml(scene::to_toml(told), scene_file.string());
  const auto decides = [&](std::string_view key) {
    if (key.starts_with("contact.")) return told.engine->offers().by_contact;
    return told.incline.gravity != 0 || !key.starts_with("incline.");
  };
  Values values;
  const toml::table& scene = table;
  for (const auto& list :
       {std::span<const Parameter>(parameters), std::span<const Parameter>(engine_parameters)})
    for (const auto& [key, name] : list)
      if (const auto text = text_of(scene.at_path(key)); text && decides(key) && !varied.count(key))
        values[name] = *text;
  // of a bed of many gaps the largest says all
  if (values.count("eps_max")) values.erase("eps");
  return values;
}

void keep_common(std::optional<Values>& common, const Values& values) {
  if (!common) {
    common = values;
    return;
  }
  std::erase_if(*common, [&](const auto& entry) {
    const auto other = values.find(entry.first);
    return other == values.end() || other->second != entry.second;
  });
}

}  // namespace

std::vector<std::string> held_fixed(const DataRecipe& recipe, const std::filesystem::path& recipe_file) {
  if (!recipe.scene) return {};
  const auto scene_file = recipe_file.parent_path() / *recipe.scene;
  std::vector<std::string> panels;  // in order of appearance
  std::map<std::string, std::optional<Values>> common;
  const auto look_at = [&](const std::string& panel, std::vector<std::string> set,
                           const std::set<std::string>& varied) {
    if (!common.count(panel)) panels.push_back(panel);
    set.insert(set.begin(), recipe.set.begin(), recipe.set.end());
    keep_common(common[panel], values_of(scene_file, set, varied));
  };
  std::set<std::string> seen;  // points of one curve differ in what varies alone
  for (const auto& curve : recipe.curves) {
    if (curve.vary && !seen.insert(curve.panel + "\n" + curve.series).second) continue;
    look_at(curve.panel, curve.set, curve.vary ? std::set{*curve.vary} : std::set<std::string>{});
  }
  for (const auto& sweep : recipe.sweeps) {
    std::set<std::string> varied{sweep.x.key};
    auto set = sweep.set;
    if (sweep.boundary) varied.insert(sweep.boundary->axis.key);
    set.push_back(sweep.x.setting(sweep.x.points(false).front()));
    look_at(sweep.panel, set, varied);
  }
  // a quotient has what both of its parts have
  for (const auto& ratio : recipe.ratios)
    for (const auto& part : {ratio.of, ratio.over.value_or(ratio.of)}) {
      const auto of = common.find(part);
      if (of == common.end() || !of->second) continue;
      const auto values = *of->second;
      if (!common.count(ratio.panel)) panels.push_back(ratio.panel);
      keep_common(common[ratio.panel], values);
    }
  std::vector<std::string> comments;
  for (const auto& panel : panels) {
    std::string line = panel.empty() ? "parameters:" : "parameters " + panel + ":";
    bool any = false;
    for (const auto& [key, name] : parameters)
      if (const auto at = common[panel]->find(name); at != common[panel]->end())
        line += fmt::format(" {}={}", name, at->second), any = true;
    if (any) comments.push_back(line);
  }
  return comments;
}

}  // namespace chute::figures
