#include "replay/frame_outputs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace chute::replay {
namespace {

struct Outputs {
  std::vector<Chosen<measure::Output>>& kinds;
};
template <class Archive>
void describe(Archive& a, Outputs& outputs) {
  for (auto& kind : outputs.kinds) chute::describe(a, *kind);
}

/// An output that frames suffice for. `by_itself`: measured where nobody says what.
struct Measurable {
  const char* word;
  bool by_itself;
};
constexpr Measurable all[] = {{"series", true},     {"profiles", true},    {"fields", true},
                              {"velocities", true}, {"moments", true},     {"forces", true},
                              {"pairs", true},      {"segregation", true}, {"cells", false},
                              {"heights", false},   {"diffusion", false},  {"surface", false}};

bool is_measurable(const std::string& word) {
  return std::ranges::any_of(all, [&](const auto& m) { return word == m.word; });
}

std::string why_not(const std::string& word) {
  const auto words = measurable();
  const bool known =
      std::ranges::any_of(measure::list(), [&](const auto& kind) { return kind.word == word; });
  const auto hint = known ? "" : nearest(word, words);
  return fmt::format("{}{}; what frames tell: {}",
                     known ? "is seen only while a run goes on, its scene can ask for it" : "no such output",
                     hint.empty() ? "" : fmt::format(", did you mean {}?", hint), fmt::join(words, ", "));
}

}  // namespace

std::vector<std::string> measurable() {
  std::vector<std::string> words;
  for (const auto& m : all) words.emplace_back(m.word);
  return words;
}

bool needs_velocities(const std::string& word) { return word == "velocities" || word == "moments"; }

std::vector<Chosen<measure::Output>> frame_outputs(const FrameScales& of, double from,
                                                   const std::vector<std::string>& only,
                                                   const std::vector<std::string>& settings) {
  std::vector<std::string> wanted = only;
  for (const auto& word : only)
    if (!is_measurable(word)) throw InputError(fmt::format("--only {}: {}", word, why_not(word)));
  if (only.empty())
    for (const auto& m : all) {
      const std::string word = m.word;
      if (!of.velocities && needs_velocities(word)) continue;
      if (!m.by_itself || (word == "pairs" && !of.closed_box) || (word == "forces" && !of.forces) ||
          (word == "segregation" && !of.mixture))
        continue;
      wanted.push_back(word);
    }
  toml::table table;
  for (const auto& setting : settings) {
    const auto word = setting.substr(0, setting.find_first_of(".="));
    if (!is_measurable(word)) throw InputError(fmt::format("--set {}: {}: {}", setting, word, why_not(word)));
    const bool steady = setting == word + ".from=steady" || setting == word + ".from=\"steady\"";
    for (const char* key : {".every=", ".from="})
      if (setting.starts_with(word + key) && !steady)
        throw InputError(
            fmt::format("--set {}: frames are looked at one by one; --from and --until say which", setting));
    set_by_path(table, setting);
    if (std::ranges::find(wanted, word) == wanted.end()) wanted.push_back(word);
  }
  std::vector<Chosen<measure::Output>> outputs;
  for (const auto& kind : measure::list()) {
    if (std::ranges::find(wanted, kind.word) == wanted.end()) continue;
    auto* keys = table.get_as<toml::table>(kind.word);
    if (!keys) keys = table.insert_or_assign(kind.word, toml::table{}).first->second.as_table();
    keys->insert_or_assign("every", of.between);
    if (!keys->contains("from")) keys->insert_or_assign("from", from);  // else it is "steady"
    if (kind.word == "diffusion" && !keys->contains("longest"))
      keys->insert_or_assign("longest", std::max(20 * of.between, of.scales.duration / 10));
    outputs.emplace_back(kind);
  }
  TomlReader reader(table, "--set");
  Outputs described{outputs};
  for (auto& output : outputs) output->before_reading(of.scales);
  describe(reader, described);
  reader.finish();
  for (auto& output : outputs) output->fill(of.scales);
  return outputs;
}

}  // namespace chute::replay
