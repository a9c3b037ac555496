#include "plot/mathparse.hpp"

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/toml_reader.hpp"
#include "plot/fonts.hpp"

namespace chute::plot {
namespace {

using Kind = MathNode::Kind;

bool is_letter(char32_t c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char32_t c) { return c >= '0' && c <= '9'; }
bool is_small_greek(char32_t c) {
  return (c >= 0x3b1 && c <= 0x3c9) || c == 0x3d1 || c == 0x3d5 || c == 0x3f5;
}

/// How the characters that mathematics does not take literally are set.
struct Plain {
  char32_t character;
  Atom atom;
};
Plain plain(char32_t c) {
  switch (c) {
    case '-':
      return {0x2212, Atom::binary};
    case '+':
      return {c, Atom::binary};
    case '*':
      return {0x2217, Atom::binary};
    case '=':
    case '<':
    case '>':
    case ':':
      return {c, Atom::relation};
    case '(':
    case '[':
      return {c, Atom::opening};
    case ')':
    case ']':
    case '!':
      return {c, Atom::closing};
    case ',':
    case ';':
      return {c, Atom::punctuation};
    case 0xb1:
    case 0xd7:
    case 0x22c5:
    case 0x2212:
      return {c, Atom::binary};
    default:
      return {c, Atom::ordinary};
  }
}

class Parser {
 public:
  Parser(std::string_view source, std::u32string text) : source_(source), text_(std::move(text)) {}

  MathNode whole() {
    MathNode row;
    std::u32string upright;
    const auto flush = [&] {
      if (upright.empty()) return;
      row.inside.push_back(letters(upright, false));
      row.inside.back().shaped = true;
      row.inside.back().atom =
          Atom::inner;  // never meets a neighbour: rows of mathematics are rows of their own
      upright.clear();
    };
    while (!at_end()) {
      const char32_t c = next();
      if (c == '$') {
        flush();
        style_ = {};
        row.inside.push_back(math_row(U'$'));
        take(U'$');
      } else if (c == '\\') {
        const auto name = command();
        if (name != U"$" && name != U"%" && name != U"\\" && name != U"_" && name != U"#" && name != U"&")
          fail(fmt::format("\\{} stands outside mathematics, write $\\{}$", utf8(name), utf8(name)));
        upright += name;
      } else {
        upright += c == '~' ? U'\u00a0' : c;
      }
    }
    flush();
    return row;
  }

 private:
  struct Style {
    bool upright = false, bold = false;
  };
  std::string_view source_;
  std::u32string text_;
  std::size_t at_ = 0;
  int depth_ = 0;
  Style style_;

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("text \"{}\": {}", source_, what));
  }
  static std::string utf8(const std::u32string& s) {
    std::string out;
    for (char32_t c : s) out += encode_utf8(c);
    return out;
  }
  bool at_end() const { return at_ >= text_.size(); }
  char32_t peek() const { return at_end() ? 0 : text_[at_]; }
  char32_t next() { return text_[at_++]; }
  void take(char32_t c) {
    if (peek() != c || at_end()) fail(fmt::format("{} is missing", encode_utf8(c)));
    ++at_;
  }
  void skip_spaces() {
    while (!at_end() && (peek() == ' ' || peek() == '\t' || peek() == '\n')) ++at_;
  }
  std::u32string command() {  // after the backslash
    if (at_end()) fail("a backslash at the end");
    std::u32string name(1, next());
    if (is_letter(name[0]))
      while (!at_end() && is_letter(peek())) name += next();
    return name;
  }

  MathNode letters(std::u32string characters, bool italic) const {
    MathNode node;
    node.kind = Kind::characters;
    node.characters = std::move(characters);
    node.italic = italic;
    node.bold = style_.bold;
    return node;
  }

  MathNode math_row(char32_t end) {
    if (++depth_ > 40) fail("too many braces inside each other");
    MathNode row;
    for (skip_spaces(); !at_end() && peek() != end; skip_spaces()) {
      if (peek() == '}') fail("a } without its {");
      if (peek() == '$') fail("} is missing");
      row.inside.push_back(scripted());
    }
    --depth_;
    return row;
  }

  MathNode scripted() {
    MathNode nucleus;
    if (peek() != '_' && peek() != '^') nucleus = atom();
    MathNode sub, super;
    bool any = false;
    for (skip_spaces(); peek() == '_' || peek() == '^' || peek() == '\''; skip_spaces()) {
      const char32_t c = next();
      MathNode& script = c == '_' ? sub : super;
      if (c == '\'') {
        script.inside.push_back(letters(U"\u2032", false));
      } else {
        if (!script.inside.empty())
          fail(fmt::format("two {} at one place", c == '_' ? "subscripts" : "superscripts"));
        script.inside.push_back(argument(c == '_' ? "_" : "^"));
      }
      any = true;
    }
    if (!any) return nucleus;
    MathNode node;
    node.kind = Kind::scripts;
    node.atom = nucleus.atom;
    node.inside = {std::move(nucleus), std::move(sub), std::move(super)};
    return node;
  }

  /// What a command or a script takes: a group in braces or one letter, digit or command.
  MathNode argument(const std::string& of) {
    skip_spaces();
    if (at_end() || peek() == '$' || peek() == '}') fail(of + " lacks what it applies to");
    if (is_digit(peek())) return letters({next()}, false);  // \frac12
    return atom();
  }

  MathNode group() {
    take(U'{');
    MathNode row = math_row(U'}');
    take(U'}');
    return row;
  }

  MathNode atom() {
    const char32_t c = peek();
    if (c == '{') return group();
    if (c == '^' || c == '_') fail("a script of a script needs braces");
    ++at_;
    if (c == '\\') return from_command(command());
    if (is_digit(c)) {
      std::u32string number(1, c);
      while (is_digit(peek()) || (peek() == '.' && at_ + 1 < text_.size() && is_digit(text_[at_ + 1])))
        number += next();
      return letters(number, false);
    }
    if (is_letter(c) || is_small_greek(c)) return letters({c}, !style_.upright);
    if (c == '~') return spaced(0.25);
    const auto [character, kind] = plain(c);
    auto node = letters({character}, false);
    node.atom = kind;
    return node;
  }

  static MathNode spaced(double em) {
    MathNode node;
    node.kind = Kind::space;
    node.space = em;
    return node;
  }

  MathNode wrapped(Kind kind, std::vector<MathNode> inside) const {
    MathNode node;
    node.kind = kind;
    node.inside = std::move(inside);
    return node;
  }

  MathNode styled(Style style, const std::string& of) {
    const Style before = style_;
    style_ = style;
    MathNode node = argument(of);
    style_ = before;
    return node;
  }

  MathNode words() {  // \text{…}: as outside mathematics
    take(U'{');
    std::u32string inside;
    while (!at_end() && peek() != '}') inside += next();
    take(U'}');
    auto node = letters(inside, false);
    node.shaped = true;
    return node;
  }

  MathNode from_command(const std::u32string& wide) {
    const std::string name = utf8(wide);
    if (const auto* symbol = find_symbol(name)) {
      auto node = letters({symbol->character}, symbol->italic && !style_.upright);
      node.atom = symbol->atom;
      return node;
    }
    if (is_function_name(name)) {
      auto node = letters(wide, false);
      node.shaped = true;
      node.atom = Atom::operation;
      return node;
    }
    if (name == "," || name == ":" || name == ";" || name == " " || name == "!")
      return spaced(name == ","   ? 3 / 18.
                    : name == ":" ? 4 / 18.
                    : name == ";" ? 5 / 18.
                    : name == "!" ? -3 / 18.
                                  : .25);
    if (name == "quad") return spaced(1);
    if (name == "frac" || name == "tfrac" || name == "dfrac") {
      auto above = argument("\\" + name), below = argument("\\" + name);
      auto node = wrapped(Kind::fraction, {std::move(above), std::move(below)});
      node.atom = Atom::inner;
      node.full_size = name == "dfrac";
      return node;
    }
    if (name == "sqrt") return wrapped(Kind::root, {argument("\\sqrt")});
    if (name == "overline") return wrapped(Kind::overline, {argument("\\overline")});
    if (name == "mathrm") return styled({true, style_.bold}, "\\mathrm");
    if (name == "mathit") return styled({false, style_.bold}, "\\mathit");
    if (name == "mathbf") return styled({true, true}, "\\mathbf");
    if (name == "text") return words();
    if (name == "left" ||
        name == "right") {  // brackets keep their size; the words are allowed for habit's sake
      skip_spaces();
      if (at_end()) fail("\\" + name + " lacks its bracket");
      if (peek() == '.') return ++at_, MathNode{};
      return atom();
    }
    const char32_t accent = name == "bar"     ? 0xaf
                            : name == "hat"   ? 0x2c6
                            : name == "tilde" ? 0x2dc
                            : name == "dot"   ? 0x2d9
                            : name == "ddot"  ? 0xa8
                            : name == "vec"   ? 0x20d7
                                              : 0;
    if (accent) {
      auto node = wrapped(Kind::accent, {argument("\\" + name)});
      node.accent = accent;
      return node;
    }
    const auto hint = nearest(name, known_commands());
    fail(fmt::format("\\{} is not known{}", name,
                     hint.empty() ? "" : fmt::format(", did you mean \\{}?", hint)));
  }
};

}  // namespace

MathNode parse_text(std::string_view source) { return Parser(source, decode_utf8(source)).whole(); }

}  // namespace chute::plot
