#pragma once
#include <string>
#include <vector>

#include "common/keys.hpp"

namespace chute {

/// Keys as a table in Markdown, for `--keys` and the README.
class KeyTable {
 public:
  void add(const std::string& title, const std::vector<KeyText>& keys);
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

}  // namespace chute
