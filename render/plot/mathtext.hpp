#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "plot/display_list.hpp"

/// Labels: text with mathematics in a small subset of TeX.
///
/// Outside `$…$` text is set upright, as it stands (`\$ \% \# \& \_ \\` for these characters). Inside:
///   - letters are italic, digits upright; `-` is a minus; spaces do not count, as in TeX
///   - `x_1`, `x^{2n}`, `x'`, groups in braces
///   - Greek `\alpha … \omega` (italic), `\Gamma … \Omega` (upright), `\varphi …`
///   - `\times \cdot \pm \degree \infty \partial \nabla \le \ge \ll \gg \ne \approx \propto \to \langle
///   \rangle …`
///   - `\sin \cos \tan \exp \ln \log \max \min …`, upright
///   - `\bar \overline \hat \tilde \dot \ddot \vec`, `\sqrt{…}`, `\frac12`, `\frac{…}{…}` (`\dfrac`: large)
///   - `\mathrm{m/s}` for units, `\mathbf`, `\mathit`, `\text{words with spaces}`
///   - spaces `\, \: \; \! \quad`
/// An unknown command, an unbalanced brace, or a character that the font lacks is an InputError naming it.
namespace chute::plot {

/// Smallest type that a figure may hold, points: sub- and superscripts shrink to 0.7 of their line or to
/// this.
inline constexpr double smallest_type = 7;

/// Text ready to be placed: origin at the left end of the baseline, y downwards, points.
struct TextBox {
  double width = 0, ascent = 0, descent = 0;  ///< of the line; ascent and descent both positive
  Rect ink = Rect::nothing();
  std::vector<GlyphRun> runs;  ///< not yet turned, placed relative to the origin by their glyphs
  std::vector<Rect> rules;     ///< bars of fractions, roots, overlines
  double size = 0;

  bool empty() const { return runs.empty() && rules.empty(); }
  /// The page box if the text is put at `at`, turned by `quarter_turns` counter-clockwise.
  Rect box_at(Point at, int quarter_turns = 0) const;
};

/// Sets `source` at `size` points. InputError as above.
TextBox set_text(std::string_view source, double size, bool bold = false);

/// Adds it to the list with its origin at `at`, turned by `angle` radians counter-clockwise.
void draw_text(DisplayList& list, const TextBox& text, Point at, Color color, double angle = 0);

}  // namespace chute::plot
