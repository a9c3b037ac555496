#include <fmt/format.h>

#include <vector>

#include "scene/scene.hpp"

namespace chute::scene {
namespace {

/// Cells of a Markdown table must not hold its borders.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != text.npos; at += 2) text.insert(at, "\\");
  return text;
}

class Table {
 public:
  void add(const std::string& title, const std::vector<KeyText>& keys) {
    text_ += fmt::format("\n**{}**\n", title);
    if (keys.empty()) return;
    text_ += "\n| key | what | default | allowed |\n|---|---|---|---|\n";
    for (const auto& k : keys)
      text_ += fmt::format("| `{}` | {} | {} | {} |\n", k.key, cell(k.text), cell(k.preset),
                           cell(k.allowed.empty() ? k.type : k.allowed));
  }
  template <class Base>
  void add_kinds(const std::string& table, const std::string& key, const Catalogue<Base>& kinds) {
    for (const auto& kind : kinds) {
      KeyLister lister;
      const auto thing = kind.make();
      thing->list(lister);
      add(fmt::format("`[{}]` {} = \"{}\": {}", table, key, kind.word, kind.text), lister.keys());
    }
  }
  std::string text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace

std::string keys_table() {
  Table table;
  table.add("All scenes", plain_keys());
  table.add_kinds("bed", "kind", beds::list());
  KeyLister wall;
  WallSpec example;
  describe(wall, example);
  table.add("`[[wall]]` planes, segments, polygons and cylinders that grains do not pass", wall.keys());
  table.add_kinds("grains.start", "kind", starts::list());
  for (const auto& law : laws::all_law_keys())
    table.add(fmt::format("`[{}]` law = \"{}\"", law.table, law.name), law.keys);
  table.add_kinds("engine", "method", engines::list());
  for (const auto& kind : measure::list()) {
    KeyLister lister;
    kind.make()->list(lister);
    table.add(fmt::format("`[output]` {}: {}", kind.word, kind.text), lister.keys());
  }
  return table.text();
}

}  // namespace chute::scene
