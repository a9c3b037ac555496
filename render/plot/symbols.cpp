#include "plot/symbols.hpp"

#include <algorithm>
#include <array>

namespace chute::plot {
namespace {

constexpr Atom ord = Atom::ordinary, op = Atom::operation, bin = Atom::binary, rel = Atom::relation,
               open = Atom::opening, close = Atom::closing, punct = Atom::punctuation, inner = Atom::inner;

// As in TeX, small Greek letters are italic, capitals upright.
constexpr std::array table{
    Symbol{"alpha", 0x3b1, ord, true},
    Symbol{"beta", 0x3b2, ord, true},
    Symbol{"gamma", 0x3b3, ord, true},
    Symbol{"delta", 0x3b4, ord, true},
    Symbol{"epsilon", 0x3f5, ord, true},
    Symbol{"varepsilon", 0x3b5, ord, true},
    Symbol{"zeta", 0x3b6, ord, true},
    Symbol{"eta", 0x3b7, ord, true},
    Symbol{"theta", 0x3b8, ord, true},
    Symbol{"vartheta", 0x3d1, ord, true},
    Symbol{"iota", 0x3b9, ord, true},
    Symbol{"kappa", 0x3ba, ord, true},
    Symbol{"lambda", 0x3bb, ord, true},
    Symbol{"mu", 0x3bc, ord, true},
    Symbol{"nu", 0x3bd, ord, true},
    Symbol{"xi", 0x3be, ord, true},
    Symbol{"omicron", 0x3bf, ord, true},
    Symbol{"pi", 0x3c0, ord, true},
    Symbol{"varpi", 0x3d6, ord, true},
    Symbol{"rho", 0x3c1, ord, true},
    Symbol{"varrho", 0x3f1, ord, true},
    Symbol{"sigma", 0x3c3, ord, true},
    Symbol{"varsigma", 0x3c2, ord, true},
    Symbol{"tau", 0x3c4, ord, true},
    Symbol{"upsilon", 0x3c5, ord, true},
    Symbol{"phi", 0x3d5, ord, true},
    Symbol{"varphi", 0x3c6, ord, true},
    Symbol{"chi", 0x3c7, ord, true},
    Symbol{"psi", 0x3c8, ord, true},
    Symbol{"omega", 0x3c9, ord, true},
    Symbol{"Gamma", 0x393, ord, false},
    Symbol{"Delta", 0x394, ord, false},
    Symbol{"Theta", 0x398, ord, false},
    Symbol{"Lambda", 0x39b, ord, false},
    Symbol{"Xi", 0x39e, ord, false},
    Symbol{"Pi", 0x3a0, ord, false},
    Symbol{"Sigma", 0x3a3, ord, false},
    Symbol{"Upsilon", 0x3a5, ord, false},
    Symbol{"Phi", 0x3a6, ord, false},
    Symbol{"Psi", 0x3a8, ord, false},
    Symbol{"Omega", 0x3a9, ord, false},
    Symbol{"times", 0xd7, bin, false},
    Symbol{"cdot", 0x22c5, bin, false},
    Symbol{"pm", 0xb1, bin, false},
    Symbol{"mp", 0x2213, bin, false},
    Symbol{"circ", 0x2218, bin, false},
    Symbol{"ast", 0x2217, bin, false},
    Symbol{"div", 0xf7, bin, false},
    Symbol{"le", 0x2264, rel, false},
    Symbol{"leq", 0x2264, rel, false},
    Symbol{"ge", 0x2265, rel, false},
    Symbol{"geq", 0x2265, rel, false},
    Symbol{"ll", 0x226a, rel, false},
    Symbol{"gg", 0x226b, rel, false},
    Symbol{"ne", 0x2260, rel, false},
    Symbol{"neq", 0x2260, rel, false},
    Symbol{"equiv", 0x2261, rel, false},
    Symbol{"approx", 0x2248, rel, false},
    Symbol{"sim", 0x223c, rel, false},
    Symbol{"simeq", 0x2243, rel, false},
    Symbol{"propto", 0x221d, rel, false},
    Symbol{"in", 0x2208, rel, false},
    Symbol{"to", 0x2192, rel, false},
    Symbol{"rightarrow", 0x2192, rel, false},
    Symbol{"leftarrow", 0x2190, rel, false},
    Symbol{"mapsto", 0x21a6, rel, false},
    Symbol{"perp", 0x22a5, rel, false},
    Symbol{"parallel", 0x2225, rel, false},
    Symbol{"infty", 0x221e, ord, false},
    Symbol{"partial", 0x2202, ord, false},
    Symbol{"nabla", 0x2207, ord, false},
    Symbol{"degree", 0xb0, ord, false},
    Symbol{"hbar", 0x210f, ord, false},
    Symbol{"ell", 0x2113, ord, false},
    Symbol{"prime", 0x2032, ord, false},
    Symbol{"ldots", 0x2026, inner, false},
    Symbol{"dots", 0x2026, inner, false},
    Symbol{"cdots", 0x22ef, inner, false},
    Symbol{"sum", 0x2211, op, false},
    Symbol{"int", 0x222b, op, false},
    Symbol{"langle", 0x27e8, open, false},
    Symbol{"rangle", 0x27e9, close, false},
    Symbol{"{", '{', open, false},
    Symbol{"}", '}', close, false},
    Symbol{"lbrace", '{', open, false},
    Symbol{"rbrace", '}', close, false},
    Symbol{"|", 0x2225, ord, false},
    Symbol{"%", '%', ord, false},
    Symbol{"$", '$', ord, false},
    Symbol{"#", '#', ord, false},
    Symbol{"&", '&', ord, false},
    Symbol{"_", '_', ord, false},
    Symbol{"colon", ':', punct, false},
    Symbol{"dagger", 0x2020, bin, false},
};

constexpr std::array<std::string_view, 21> functions{
    "sin", "cos", "tan", "cot", "arcsin", "arccos", "arctan", "sinh", "cosh", "tanh", "exp",
    "ln",  "log", "max", "min", "lim",    "sup",    "inf",    "det",  "arg",  "erf"};

constexpr std::array<std::string_view, 18> structures{"frac",   "dfrac",  "tfrac", "sqrt", "bar",  "overline",
                                                      "hat",    "tilde",  "dot",   "ddot", "vec",  "mathrm",
                                                      "mathit", "mathbf", "text",  "quad", "left", "right"};

}  // namespace

std::span<const Symbol> symbols() { return table; }

const Symbol* find_symbol(std::string_view name) {
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const Symbol& s) { return s.name == name; });
  return found == table.end() ? nullptr : &*found;
}

bool is_function_name(std::string_view name) {
  return std::find(functions.begin(), functions.end(), name) != functions.end();
}

const std::vector<std::string>& known_commands() {
  static const auto all = [] {
    std::vector<std::string> names;
    for (const auto& s : table) names.emplace_back(s.name);
    names.insert(names.end(), functions.begin(), functions.end());
    names.insert(names.end(), structures.begin(), structures.end());
    return names;
  }();
  return all;
}

int space_between(Atom left, Atom right, bool script) {
  // The TeXbook, p. 170: 0 none, 1 thin, 2 medium, 3 thick; negative ones vanish in scripts; * (never met) is
  // none.
  static constexpr int rules[8][8] = {
      // ord  op  bin  rel open close punct inner
      {0, 1, -2, -3, 0, 0, 0, -1},      // ordinary
      {1, 1, 0, -3, 0, 0, 0, -1},       // operation
      {-2, -2, 0, 0, -2, 0, 0, -2},     // binary
      {-3, -3, 0, 0, -3, 0, 0, -3},     // relation
      {0, 0, 0, 0, 0, 0, 0, 0},         // opening
      {0, 1, -2, -3, 0, 0, 0, -1},      // closing
      {-1, -1, 0, -1, -1, -1, -1, -1},  // punctuation
      {-1, 1, -2, -3, -1, 0, -1, -1},   // inner
  };
  static constexpr int widths[4] = {0, 3, 4, 5};
  const int rule = rules[static_cast<int>(left)][static_cast<int>(right)];
  if (rule < 0 && script) return 0;
  return widths[rule < 0 ? -rule : rule];
}

}  // namespace chute::plot
