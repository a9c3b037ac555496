#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "plot/symbols.hpp"

/// Labels as a tree. The language is described in mathtext.hpp.
namespace chute::plot {

struct MathNode {
  enum class Kind { characters, row, scripts, fraction, root, accent, overline, space };
  Kind kind = Kind::row;
  Atom atom = Atom::ordinary;

  // characters: a letter, a symbol, a number, a word
  std::u32string characters;
  bool italic = false, bold = false;

  /// row: its members; fraction: above, below; root, accent, overline: the inside; scripts: nucleus, sub,
  /// super, the last two empty rows where absent.
  std::vector<MathNode> inside;
  char32_t accent = 0;
  double space = 0;        ///< em
  bool full_size = false;  ///< dfrac
  bool shaped = false;     ///< characters are running text: kern them
};

/// InputError naming the slip and, for an unknown command, the nearest one.
MathNode parse_text(std::string_view source);

}  // namespace chute::plot
