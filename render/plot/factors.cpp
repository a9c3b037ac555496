#include "plot/factors.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

namespace chute::plot {
namespace {
using namespace std::string_view_literals;

constexpr std::array doubtful_words{" unsettled"sv, " apart"sv};
constexpr auto fit_word = " fit"sv;

/// More fills than these a small marker does not show.
constexpr std::size_t most_fills = 4;

bool ends_with_part(const std::string& name, std::string_view word) {
  return name.size() > word.size() && name.ends_with(word);
}

bool is_only_line(const Series& s) {
  return s.kind == Kind::line || s.kind == Kind::band || s.kind == Kind::steps || s.kind == Kind::bars;
}

struct Split {
  std::string first, last;  ///< the name, cut at a blank
};

std::vector<std::string> different(const std::vector<std::string>& values) {
  std::vector<std::string> found;
  for (const auto& v : values)
    if (std::find(found.begin(), found.end(), v) == found.end()) found.push_back(v);
  return found;
}

int index_in(const std::vector<std::string>& values, const std::string& value) {
  return static_cast<int>(std::find(values.begin(), values.end(), value) - values.begin());
}

}  // namespace

std::string base_name(const std::string& name) {
  for (const auto word : doubtful_words)
    if (ends_with_part(name, word)) return name.substr(0, name.size() - word.size());
  if (ends_with_part(name, fit_word)) return name.substr(0, name.size() - fit_word.size());
  return name;
}

bool is_doubtful(const std::string& name) {
  return std::any_of(doubtful_words.begin(), doubtful_words.end(),
                     [&](auto word) { return ends_with_part(name, word); });
}

std::string keys_of(const std::string& name) {
  std::string keys;
  for (std::size_t at = 0; at < name.size();) {
    const auto end = std::min(name.size(), name.find(' ', at));
    const auto token = name.substr(at, end - at);
    if (const auto equals = token.find('='); equals != std::string::npos)
      keys += token.substr(0, equals + 1) + " ";
    at = end + 1;
  }
  return keys;
}

std::optional<Factors> factors_of(const std::vector<const Series*>& series) {
  struct Member {
    std::string name;
    bool is_line;
  };
  std::vector<Member> members;  // each name once
  std::set<std::string> whole, seen;
  std::size_t alone = 0;  // such as "rotating" beside "mu=0 e_n=0.7" …
  for (const auto* s : series) whole.insert(s->name);
  for (const auto* s : series) {
    if (s->color || s->marker || s->dash) return {};
    // A series of which only doubtful points are left has its place in the table all the same.
    const auto name = base_name(s->name);
    const bool is_part = name != s->name && (!is_doubtful(s->name) || whole.count(name) > 0);
    if (is_part || !seen.insert(name).second) continue;
    if (name.find(' ') == std::string::npos)
      ++alone;
    else
      members.push_back({name, is_only_line(*s)});
  }
  if (members.size() < 4 || alone > 1) return {};
  std::optional<Factors> best;
  for (const bool behind_first : {false, true}) {
    std::vector<std::string> first, last;
    for (const auto& [name, is_line] : members) {
      const auto cut = behind_first ? name.find(' ') : name.rfind(' ');
      first.push_back(name.substr(0, cut)), last.push_back(name.substr(cut + 1));
    }
    const auto firsts = different(first), lasts = different(last);
    const std::size_t entries = firsts.size() + lasts.size();
    if (firsts.size() < 2 || lasts.size() < 2 || entries > members.size()) continue;
    if (entries == members.size() && entries > 4) continue;
    if (best && entries >= best->colors.size() + best->styles.size()) continue;
    // a style is a way to draw: all its series must be lines, or all have markers
    const auto is_pure = [&](const std::vector<std::string>& of_member) {
      std::map<std::string, bool> line;
      for (std::size_t k = 0; k < members.size(); ++k)
        if (line.try_emplace(of_member[k], members[k].is_line).first->second != members[k].is_line)
          return false;
      return true;
    };
    const bool last_is_color = is_pure(first) && (!is_pure(last) || lasts.size() >= firsts.size());
    if (!last_is_color && !is_pure(last)) continue;
    Factors f;
    f.colors = last_is_color ? lasts : firsts, f.styles = last_is_color ? firsts : lasts;
    std::set<std::string> filled;
    for (std::size_t k = 0; k < members.size(); ++k) {
      const auto &color = last_is_color ? last[k] : first[k], &style = last_is_color ? first[k] : last[k];
      f.of[members[k].name] = {index_in(f.colors, color), index_in(f.styles, style)};
      f.has_lines |= members[k].is_line;
      if (!members[k].is_line) filled.insert(style);
    }
    if (filled.size() <= most_fills) best = f;
  }
  return best;
}

}  // namespace chute::plot
