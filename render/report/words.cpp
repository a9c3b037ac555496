#include "report/words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace chute::report {
namespace {

using Node = toml::node_view<const toml::node>;

/// A value as text: a number as people write it, a text without quotes.
std::string text_of(const Node& node) {
  if (const auto number = node.value<double>(); number && !node.is_boolean()) return number_text(*number);
  if (const auto text = node.value<std::string>()) return *text;
  std::ostringstream out;
  out << node;
  return out.str();
}

std::string laid_out(std::string angle) {
  if (angle.ends_with(" deg")) angle = angle.substr(0, angle.size() - 4) + "°";
  return angle;
}

std::string plural(const std::string& count, const std::string& one) {
  return count + " " + one + (count == "1" ? "" : "s");
}

/// "law (key value, key value)" of a table such as [contact.normal], whose first word is under `word`.
std::string with_keys(const toml::table& table, const std::string& word) {
  std::vector<std::string> parts;
  for (const auto& [key, value] : table) {
    const std::string name(key.str());
    if (name == word || value.is_table() || (value.is_boolean() && !value.value_or(false))) continue;
    std::string shown = name;
    std::replace(shown.begin(), shown.end(), '_', ' ');
    parts.push_back(value.is_boolean() ? shown : shown + " " + text_of(Node(value)));
  }
  const auto name = table[word].value_or(std::string("?"));
  return parts.empty() ? name : fmt::format("{} ({})", name, fmt::join(parts, ", "));
}

std::string unit(const RunFiles& run, const char* si, const char* reduced) {
  return run.units == "SI" ? std::string(" ") + si : std::string(" ") + reduced;
}

std::string grains_sentence(const RunFiles& run) {
  const Node scene(run.scene);
  const std::string grain = run.dimensions == 3 ? "sphere" : "disc";
  const auto grains = scene["grains"];
  std::string text;
  if (const auto from = scene["grains"]["start"]["from"].value<std::string>())
    text = fmt::format("The grains that {} left", *from);
  else if (grains["count"])
    text = plural(text_of(grains["count"]), grain);
  else
    text = run.dimensions == 3 ? "Spheres" : "Discs";
  if (const auto mean = grains["diameter"]["mean"]; mean) {
    text += fmt::format(", {}", text_of(mean));
    if (grains["diameter"]["std"].value_or(0.0) > 0)
      text += fmt::format(" ± {}", text_of(grains["diameter"]["std"]));
    text += unit(run, "m", "d") + " across";
  } else if (grains["size_ratio"]) {
    text += fmt::format(", {} times as large as a bead of the bed", text_of(grains["size_ratio"]));
  }
  const auto start = grains["start"];
  const bool several = text.find("grains") != std::string::npos || grains["count"].value_or(2.0) != 1;
  std::string how;
  if (const auto kind = start["kind"].value<std::string>(); kind && *kind != "lattice") how = " " + *kind;
  if (const auto lattice = start["lattice"].value<std::string>(); lattice && *lattice != "none")
    how = fmt::format(" on a {} lattice", *lattice);
  if (start["velocity"].value_or(0.0) != 0)
    how += fmt::format("{} at {}{}", how.empty() ? "" : ",", text_of(start["velocity"]),
                       unit(run, "m/s", "√(gd)"));
  if (!how.empty()) text += fmt::format(", {}{}", several ? "start" : "starts", how);
  if (grains["independent"].value_or(false)) text += ", and do not feel each other";
  return text + ".";
}

std::string ground_sentence(const RunFiles& run) {
  const Node scene(run.scene);
  std::string text;
  const auto kind = scene["bed"]["kind"].value_or(std::string("none"));
  const auto walls = scene["wall"].as_array();
  if (kind == "none")
    text = "There is no bed";
  else if (kind == "flat")
    text = "Below is a smooth floor";
  else
    text = fmt::format("Below is a bed of {} glued grains ({})", text_of(scene["bed"]["count"]), kind);
  if (walls && !walls->empty())
    text += fmt::format(", with {}", plural(fmt::format("{}", walls->size()), "wall"));
  const auto angle = scene["incline"]["angle"];
  if (angle.is_table())
    text += fmt::format(", tilted from {} to {} at {} in a unit of time", laid_out(text_of(angle["from"])),
                        laid_out(text_of(angle["to"])), laid_out(text_of(angle["rate"])));
  else if (angle)
    text += fmt::format(", inclined by {}", laid_out(text_of(angle)));
  else if (scene["incline"]["sin"])
    text += fmt::format(", inclined by θ with sin θ = {}", text_of(scene["incline"]["sin"]));
  return text + ".";
}

}  // namespace

std::string number_text(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "unknown" : value > 0 ? "∞" : "−∞";
  auto text = fmt::format("{:.4g}", value);
  const auto e = text.find('e');
  std::string power;
  if (e != std::string::npos) {
    static constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    const int exponent = std::stoi(text.substr(e + 1));
    power = exponent < 0 ? "⁻" : "";
    for (const char c : std::to_string(std::abs(exponent))) power += digits[c - '0'];
    text = text.substr(0, e);
    power = text == "1" ? "10" + power : text == "-1" ? "−10" + power : " × 10" + power;
    if (text == "1" || text == "-1") text.clear();
  }
  if (text.starts_with('-')) text.replace(0, 1, "−");
  return text + power;
}

std::string mean_text(const Mean& mean) {
  if (!mean.value) return "unknown";
  return mean.error
             ? fmt::format("{} ± {}", number_text(*mean.value),
                           number_text(std::strtod(fmt::format("{:.2g}", *mean.error).c_str(), nullptr)))
             : number_text(*mean.value);
}

std::vector<std::string> scene_in_words(const RunFiles& run) {
  const Node scene(run.scene);
  std::vector<std::string> sentences;
  if (run.is_experiment()) {
    std::string text = fmt::format("An experiment with contact laws: {}.",
                                   with_keys(*run.scene["experiment"].as_table(), "kind"));
    sentences.push_back(std::move(text));
  } else {
    sentences.push_back(grains_sentence(run));
    sentences.push_back(ground_sentence(run));
  }
  const auto law = [&](const char* which) -> std::string {
    const auto* table = run.scene["contact"][which].as_table();
    return table ? with_keys(*table, "law") : "none";
  };
  if (run.scene.contains("contact"))
    sentences.push_back(fmt::format("Contacts: {} along the normal; {} along the surface.", law("normal"),
                                    law("tangential")));
  if (const auto* engine = run.scene["engine"].as_table())
    sentences.push_back(fmt::format("Method: {}.", with_keys(*engine, "method")));
  const std::string clock = run.record.clock == "time" ? unit(run, "s", "√(d/g)") : " " + run.record.clock;
  std::string end = run.record.end.empty() ? "" : fmt::format(" ({})", run.record.end);
  sentences.push_back(fmt::format("It ran for {}{}{}, with seed {}{}.", number_text(run.record.time), clock,
                                  end, run.record.seed,
                                  run.units == "SI" ? "; SI units" : "; reduced units, m = g = d = 1"));
  return sentences;
}

std::vector<Setting> settings_of(const toml::table& scene) {
  std::vector<Setting> settings;
  const auto walk = [&](const auto& self, const toml::table& table, const std::string& prefix) -> void {
    for (const auto& [key, value] : table) {
      const std::string name = prefix + std::string(key.str());
      if (const auto* inner = value.as_table()) {
        self(self, *inner, name + ".");
      } else {
        std::ostringstream out;
        out << Node(value);
        settings.push_back({name, out.str()});
      }
    }
  };
  walk(walk, scene, "");
  return settings;
}

std::vector<Difference> differences(std::span<const RunFiles> runs) {
  std::vector<Difference> all;
  for (std::size_t k = 0; k < runs.size(); ++k)
    for (const auto& setting : settings_of(runs[k].scene)) {
      auto found =
          std::find_if(all.begin(), all.end(), [&](const Difference& d) { return d.key == setting.key; });
      if (found == all.end())
        found = all.insert(all.end(), {setting.key, std::vector<std::string>(runs.size())});
      found->values[k] = setting.value;
    }
  std::erase_if(all, [](const Difference& d) {
    return std::all_of(d.values.begin(), d.values.end(),
                       [&](const auto& v) { return v == d.values.front(); });
  });
  return all;
}

std::string meaning_of(const std::string& verdict) {
  if (verdict == "stopped") return "it came to rest";
  if (verdict == "steady") return "it forgot its start, and its mean velocity no longer changes";
  if (verdict == "accelerating") return "its velocity grows without a sign of a limit";
  if (verdict == "runaway") return "it kept a velocity for a while, then left it for good";
  if (verdict == "unsettled")
    return "the run is too short to say what becomes of it; means are those of its last quarter";
  return "";
}

}  // namespace chute::report
