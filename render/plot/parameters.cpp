#include "plot/parameters.hpp"

#include <algorithm>

#include "plot/legend.hpp"

namespace chute::plot {
namespace {

/// What stands behind "WORD PANEL: " or "WORD: " in each comment that begins so, for that panel or all.
std::vector<std::string> told(const std::vector<std::string>& comments, const std::string& word,
                              const std::string& panel) {
  std::vector<std::string> found;
  for (const auto& comment : comments)
    for (const auto& begin : {word + ": ", word + " " + panel + ": "})
      if (comment.starts_with(begin)) {
        found.push_back(comment.substr(begin.size()));
        break;
      }
  return found;
}

}  // namespace

std::string parameters_of(const std::vector<std::string>& comments, const std::string& panel) {
  std::string text;
  for (const auto& names : told(comments, "parameters", panel))
    text += (text.empty() || names.empty() ? "" : ", ") + label_from_name(names);
  return text;
}

bool is_told_hollow(const std::vector<std::string>& comments, const std::string& panel,
                    const std::string& series) {
  const auto all = told(comments, "hollow", panel);
  return std::find(all.begin(), all.end(), series) != all.end();
}

}  // namespace chute::plot
