#include "plot/mathtext.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/error.hpp"
#include "plot/fonts.hpp"
#include "plot/mathparse.hpp"

namespace chute::plot {
namespace {

constexpr double slant = 0.28;           // of the italics, horizontal per vertical
constexpr double script_ratio = 0.7;     // as in TeX
constexpr double rule_thickness = 0.05;  // em
constexpr double thinnest_rule = 0.4;    // points: a thinner one breaks up in print

// Where scripts stand, in em; chosen by eye so that they neither touch their letter nor float, near what TeX does.
constexpr double prime_raised = 0.4, super_raised = 0.36;
constexpr double sub_lowered = 0.16, sub_lowered_under_super = 0.22;
constexpr double below_tall = 0.05;   // a subscript's baseline under the foot of a nucleus that is no letter
constexpr double into_tall = 0.45;    // of the script's size: how far a superscript reaches down beside such
constexpr double sub_reaches = 0.8;   // of the height of an x: no subscript stands higher
constexpr double super_clear = 0.25;  // of the height of an x: no superscript hangs lower
constexpr double after_scripts = 0.05;

// Fractions, roots and bars, in em: space beside, above and below their rules.
constexpr double fraction_side = 0.08, fraction_gap = 0.13, fraction_overhang = 0.1;
constexpr double root_gap = 0.1, root_depth = 0.15, root_side = 0.06, root_joint = 0.02;
constexpr double accent_gap = 0.09, overline_gap = 0.1, overline_inset = 0.03;

double rule(double size) { return std::max(thinnest_rule, rule_thickness * size); }

double script_size(double size) { return std::min(size, std::max(script_ratio * size, smallest_type)); }

/// Growing line of boxes.
struct Line {
  TextBox box;
  double italic_correction = 0;  ///< how far the last letter leans over its advance
  bool last_italic = false;

  void extend(double ascent, double descent) {
    box.ascent = std::max(box.ascent, ascent), box.descent = std::max(box.descent, descent);
  }
  /// Puts `other` with its origin at (x, y) of this line; does not advance.
  void put(const TextBox& other, double x, double y) {
    for (GlyphRun run : other.runs) {
      for (auto& g : run.glyphs) g.at = g.at + Point{x, y};
      if (!box.runs.empty() && box.runs.back().face == run.face && box.runs.back().size == run.size) {
        auto& last = box.runs.back();
        last.glyphs.insert(last.glyphs.end(), run.glyphs.begin(), run.glyphs.end());
        last.text += run.text;
      } else {
        box.runs.push_back(std::move(run));
      }
    }
    for (const auto& rule : other.rules) box.rules.push_back(rule.moved({x, y}));
    if (other.ink.left <= other.ink.right) box.ink.include(other.ink.moved({x, y}));
    extend(other.ascent - y, other.descent + y);
  }
  void rule(const Rect& r) {
    box.rules.push_back(r);
    box.ink.include(r);
    extend(-r.top, r.bottom);
  }
};

class Setter {
 public:
  explicit Setter(bool bold) : fonts_(Fonts::mine()), bold_(bold) {}

  Line set(const MathNode& node, double size, bool script) {
    switch (node.kind) {
      case MathNode::Kind::characters:
        return characters(node, size);
      case MathNode::Kind::row:
        return row(node, size, script);
      case MathNode::Kind::scripts:
        return scripts(node, size);
      case MathNode::Kind::fraction:
        return fraction(node, size);
      case MathNode::Kind::root:
        return root(node, size, script);
      case MathNode::Kind::accent:
        return accent(node, size, script);
      case MathNode::Kind::overline:
        return overline(node, size, script);
      case MathNode::Kind::space:
        break;
    }
    Line line;
    line.box.width = node.space * size;
    return line;
  }

 private:
  Fonts& fonts_;
  bool bold_;

  Face face(bool italic, bool bold) const {
    bold = bold || bold_;
    return italic ? (bold ? Face::bold_italic : Face::italic) : (bold ? Face::bold : Face::regular);
  }

  /// Height above the baseline at which fraction bars and minus signs stand, em.
  double axis() {
    const auto& box = fonts_.metrics(Face::regular, fonts_.glyph(Face::regular, 0x2212)).box;
    return -(box.top + box.bottom) / 2;
  }
  double x_height() { return -fonts_.metrics(Face::regular, fonts_.glyph(Face::regular, 'x')).box.top; }

  void add_glyph(Line& line, GlyphRun& run, std::uint32_t id, double x, const std::string& text,
                 double size) {
    const auto& m = fonts_.metrics(run.face, id);
    run.glyphs.push_back({id, {x, 0}, static_cast<int>(text.size())});
    run.text += text;
    if (m.box.right > m.box.left)
      line.box.ink.include(
          Rect{x + size * m.box.left, size * m.box.top, x + size * m.box.right, size * m.box.bottom});
    line.extend(-size * m.box.top, size * m.box.bottom);
    line.italic_correction = std::max(0.0, size * (m.box.right - m.advance));
  }

  /// The face of the family that is set in, or STIXGeneral's where that has no such character.
  Face face_for(Face usual, char32_t c) {
    const Face own = in_family(usual, FamilyScope::current());
    return fonts_.has(own, c) ? own : usual;
  }

  Line characters(const MathNode& node, double size) {
    Line line;
    const Face usual = face(node.italic, node.bold);
    // one run for as many characters as one face has
    std::u32string_view rest(node.characters);
    while (!rest.empty()) {
      GlyphRun run{face_for(usual, rest[0]), size, {0, 0}, 0, {}, {}, {}};
      std::size_t count = 1;
      while (count < rest.size() && face_for(usual, rest[count]) == run.face) ++count;
      add_run(line, std::move(run), rest.substr(0, count), node.shaped);
      rest.remove_prefix(count);
    }
    line.last_italic = node.italic;
    return line;
  }

  void add_run(Line& line, GlyphRun run, std::u32string_view characters, bool shaped_together) {
    const double begin = line.box.width, size = run.size;
    if (shaped_together) {
      std::string text;
      for (char32_t c : characters) text += encode_utf8(c);
      double advance = 0;
      const auto shaped = fonts_.shape(run.face, text, advance);
      for (std::size_t i = 0; i < shaped.size(); ++i) {
        const auto end = i + 1 < shaped.size() ? shaped[i + 1].byte : text.size();
        add_glyph(line, run, shaped[i].glyph, begin + size * shaped[i].x,
                  text.substr(shaped[i].byte, end - shaped[i].byte), size);
      }
      line.box.width = begin + size * advance;
    } else {
      for (char32_t c : characters) {
        const auto id = fonts_.glyph(run.face, c);
        add_glyph(line, run, id, line.box.width, encode_utf8(c), size);
        line.box.width += size * fonts_.metrics(run.face, id).advance;
      }
    }
    line.box.runs.push_back(std::move(run));
  }

  Line row(const MathNode& node, double size, bool script) {
    Line line;
    const MathNode* last = nullptr;
    Atom last_atom = Atom::opening;
    bool last_italic = false;
    double lean = 0;
    for (std::size_t i = 0; i < node.inside.size(); ++i) {
      const MathNode& member = node.inside[i];
      Atom atom = member.atom;
      // a sign that has nothing on its left, or nothing on its right, is no operation between two things
      if (atom == Atom::binary && (!last || last_atom == Atom::binary || last_atom == Atom::operation ||
                                   last_atom == Atom::relation || last_atom == Atom::opening ||
                                   last_atom == Atom::punctuation || i + 1 == node.inside.size()))
        atom = Atom::ordinary;
      Line inside = set(member, size, script);
      if (last && last->kind != MathNode::Kind::space && member.kind != MathNode::Kind::space &&
          !is_words(*last) && !is_words(member))
        line.box.width += space_between(last_atom, atom, script) * size / 18;
      if (last && last_italic && !inside.last_italic) line.box.width += lean;  // an f before a bracket
      line.put(inside.box, line.box.width, 0);
      line.box.width += inside.box.width;
      lean = inside.italic_correction, last_italic = inside.last_italic;
      last = &member, last_atom = atom;
    }
    line.italic_correction = lean, line.last_italic = last_italic;
    return line;
  }
  /// Running text and whole formulas side by side bring their own spaces.
  static bool is_words(const MathNode& node) { return node.shaped && node.atom == Atom::inner; }

  Line scripts(const MathNode& node, double size) {
    const MathNode &nucleus = node.inside[0], &sub = node.inside[1], &super = node.inside[2];
    Line line = set(nucleus, size, false);
    const double small = script_size(size);
    const bool letter = nucleus.kind == MathNode::Kind::characters;
    const double start = line.box.width;
    double end = start, up = 0;
    const bool prime = super.inside.size() == 1 && super.inside[0].characters == U"\u2032";
    if (prime) {  // the font draws it small and raised already
      const Line above = set(super, size, true);
      line.put(above.box, start + line.italic_correction, 0);
      end = start + line.italic_correction + above.box.width;
      up = prime_raised * size;
    } else if (!super.inside.empty()) {
      const Line above = set(super, small, true);
      up = std::max({super_raised * size, letter ? 0 : line.box.ascent - into_tall * small,
                     above.box.descent + super_clear * x_height() * size});
      line.put(above.box, start + line.italic_correction, -up);
      end = std::max(end, start + line.italic_correction + above.box.width);
      up -= above.box.descent;  // its lower edge
    }
    if (!sub.inside.empty()) {
      const Line below = set(sub, small, true);
      double down = std::max({(super.inside.empty() ? sub_lowered : sub_lowered_under_super) * size,
                              letter ? 0 : line.box.descent + below_tall * small,
                              below.box.ascent - sub_reaches * x_height() * size});
      if (!super.inside.empty())
        down = std::max(down, below.box.ascent - up + 4 * rule_thickness * size);  // a gap between the two
      line.put(below.box, start, down);
      end = std::max(end, start + below.box.width);
    }
    line.box.width = end + after_scripts * size;
    line.italic_correction = 0, line.last_italic = false;
    return line;
  }

  Line fraction(const MathNode& node, double size) {
    const double small = node.full_size ? size : script_size(size);
    const Line above = set(node.inside[0], small, !node.full_size),
               below = set(node.inside[1], small, !node.full_size);
    Line line;
    const double side = fraction_side * size, thick = rule(size), gap = fraction_gap * size;
    const double inner = std::max(above.box.width, below.box.width) + fraction_overhang * size,
                 middle = axis() * size;
    line.put(above.box, side + (inner - above.box.width) / 2,
             -(middle + thick / 2 + gap + above.box.descent));
    line.put(below.box, side + (inner - below.box.width) / 2, -(middle - thick / 2 - gap - below.box.ascent));
    line.rule({side, -middle - thick / 2, side + inner, -middle + thick / 2});
    line.box.width = inner + 2 * side;
    return line;
  }

  Line root(const MathNode& node, double size, bool script) {
    const Line inside = set(node.inside[0], size, script);
    const auto id = fonts_.glyph(Face::regular, 0x221a);
    const auto& sign = fonts_.metrics(Face::regular, id);
    const double thick = rule(size), gap = root_gap * size;
    const double bottom = std::max(inside.box.descent, root_depth * size);
    const double top = std::max(inside.box.ascent, x_height() * size) + gap + thick;
    // the sign as a larger or smaller letter
    const double scale = std::max(smallest_type, (top + bottom) / sign.box.height());
    Line line;
    TextBox glyph;
    glyph.runs.push_back({Face::regular, scale, {0, 0}, 0, {{id, {0, 0}, 3}}, "\u221a", {}});
    glyph.ink = {scale * sign.box.left, scale * sign.box.top, scale * sign.box.right,
                 scale * sign.box.bottom};
    glyph.ascent = -glyph.ink.top, glyph.descent = glyph.ink.bottom;
    line.put(glyph, 0, -top - glyph.ink.top);
    const double start = glyph.ink.right;
    line.put(inside.box, start, 0);
    line.box.width = start + inside.box.width + inside.italic_correction + root_side * size;
    line.rule({start - root_joint * size, -top, line.box.width, -top + thick});
    line.box.width += root_side * size;
    return line;
  }

  Line accent(const MathNode& node, double size, bool script) {
    Line line = set(node.inside[0], size, script);
    const auto id = fonts_.glyph(Face::regular, node.accent);
    const auto& m = fonts_.metrics(Face::regular, id);
    const Rect ink = line.box.ink;
    if (ink.left > ink.right) return line;
    const double height = -ink.top;
    const double lean = line.last_italic ? slant * (height / 2 + 0.05 * size) : 0;
    const double x = (ink.left + ink.right) / 2 + lean - size * (m.box.left + m.box.right) / 2;
    // every accent is drawn for the height of an x in its font; some stand a little high there, some low
    const double y = -(height + accent_gap * size) - size * m.box.bottom;
    TextBox mark;
    const bool bar = node.accent == 0xaf;
    const std::string text = encode_utf8(bar ? 0x304 : node.accent);
    mark.runs.push_back(
        {Face::regular, size, {0, 0}, 0, {{id, {0, 0}, static_cast<int>(text.size())}}, text, {}});
    mark.ink = {size * m.box.left, size * m.box.top, size * m.box.right, size * m.box.bottom};
    mark.ascent = -mark.ink.top;
    const double correction = line.italic_correction;
    const bool italic = line.last_italic;
    line.put(mark, x, y);
    line.italic_correction = correction, line.last_italic = italic;
    return line;
  }

  Line overline(const MathNode& node, double size, bool script) {
    Line line = set(node.inside[0], size, script);
    const double thick = rule(size);
    const double y = -line.box.ascent - overline_gap * size;
    line.rule({overline_inset * size, y - thick, line.box.width + line.italic_correction, y});
    return line;
  }
};

}  // namespace

Rect TextBox::box_at(Point at, int quarter_turns) const {
  if (quarter_turns == 1) return {at.x() - ascent, at.y() - width, at.x() + descent, at.y()};
  return {at.x(), at.y() - ascent, at.x() + width, at.y() + descent};
}

TextBox set_text(std::string_view source, double size, bool bold) {
  const MathNode tree = parse_text(source);
  Line line;
  try {
    line = Setter(bold).set(tree, size, false);
  } catch (const InputError& error) {
    throw InputError("text \"" + std::string(source) + "\": " + error.what());
  }
  line.box.width += line.italic_correction;
  line.box.size = size;
  return std::move(line.box);
}

void draw_text(DisplayList& list, const TextBox& text, Point at, Color color, double angle) {
  for (GlyphRun run : text.runs) {
    run.origin = at, run.angle = angle, run.color = color;
    list.items.emplace_back(std::move(run));
  }
  const Eigen::Rotation2Dd turn(-angle);  // anticlockwise on a page whose y points down
  const auto turned = [&](double x, double y) -> Point { return at + turn * Point{x, y}; };
  for (const auto& r : text.rules) {
    Path path;
    path.move(turned(r.left, r.top)).line(turned(r.right, r.top));
    path.line(turned(r.right, r.bottom)).line(turned(r.left, r.bottom)).close();
    list.fill(std::move(path), color);
  }
}

}  // namespace chute::plot
