#include "common/key_table.hpp"
#include "scene/scene.hpp"

namespace chute::scene {

std::string keys_table() {
  KeyTable table;
  table.add("All scenes", plain_keys());
  table.add_kinds("bed", "kind", beds::list());
  KeyLister wall;
  WallSpec example;
  describe(wall, example);
  table.add("`[[wall]]` planes, segments, polygons and cylinders that grains do not pass", wall.keys());
  KeyLister between;
  laws::ContactBetween own;
  describe(between, own);
  table.add("`[[contact.between]]` what is two materials' own where they meet", between.keys());
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
