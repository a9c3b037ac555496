#include "common/key_table.hpp"

namespace chute {

/// Cells of a Markdown table must not hold its borders.
static std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != text.npos; at += 2) text.insert(at, "\\");
  return text;
}

void KeyTable::add(const std::string& title, const std::vector<KeyText>& keys) {
  text_ += fmt::format("\n**{}**\n", title);
  if (keys.empty()) return;
  text_ += "\n| key | what | default | allowed |\n|---|---|---|---|\n";
  for (const auto& k : keys)
    text_ += fmt::format("| `{}` | {} | {} | {} |\n", k.key, cell(k.text), cell(k.preset),
                         cell(k.allowed.empty() ? k.type : k.allowed));
}

}  // namespace chute
