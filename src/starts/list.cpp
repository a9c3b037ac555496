#include "starts/from_file.hpp"
#include "starts/pressed.hpp"
#include "starts/scattered.hpp"
#include "starts/square.hpp"

namespace chute::starts {
namespace {

/// Those that `lattice` names: the word for them before there were others.
bool is_lattice(const std::string& word) { return word == Square::word || word == Alone::word; }

}  // namespace

Catalogue<Start>& list() {
  static Catalogue<Start> all{kind_of<Start, Square>(), kind_of<Start, Alone>(), kind_of<Start, FromFile>(),
                              kind_of<Start, Scattered>(), kind_of<Start, Pressed>()};
  return all;
}

void choose_start(TomlReader& a, Chosen<Start>& start) {
  a.check(!a.has("kind") || !a.has("lattice"), "kind", "give either kind or lattice, which mean the same");
  const bool older = a.has("lattice");
  if (a.has("from") && !a.has("kind") && !older) {
    a.ignored("kind"), a.ignored("lattice");
    for (const auto& kind : list())
      if (kind.word == FromFile::word) start = Chosen<Start>(kind);
    return;
  }
  a.ignored(older ? "kind" : "lattice");
  choose_kind(a, older ? "lattice" : "kind", start, list());
}

void choose_start(TomlWriter& a, Chosen<Start>& start) {
  choose_kind(a, is_lattice(start.word()) ? "lattice" : "kind", start, list());
}

}  // namespace chute::starts
