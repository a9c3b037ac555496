#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace chute::plot {

/// What an atom of a formula is; decides the space around it, as in TeX.
enum class Atom : std::uint8_t {
  ordinary,
  operation,
  binary,
  relation,
  opening,
  closing,
  punctuation,
  inner
};

/// A command that stands for one character.
struct Symbol {
  std::string_view name;  ///< without the backslash
  char32_t character;
  Atom atom;
  bool italic;
};

std::span<const Symbol> symbols();
const Symbol* find_symbol(std::string_view name);
/// sin, cos, max …: set upright.
bool is_function_name(std::string_view name);
/// Every command that mathematics knows, for the nearest one to a slip.
const std::vector<std::string>& known_commands();

/// Space between two neighbours in units of 1/18 em; `script` in sub- and superscripts, where only the thin
/// ones stay.
int space_between(Atom left, Atom right, bool script);

}  // namespace chute::plot
