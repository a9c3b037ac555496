#pragma once
#include <string>
#include <variant>
#include <vector>

#include "image/image.hpp"
#include "plot/geometry.hpp"

/// What a finished layout is: things to draw, in order, in points. Every back end draws this list and decides
/// nothing.
namespace chute::plot {

enum class Cap { butt, round, square };
enum class Join { miter, round, bevel };

/// How a path is drawn with a pen. Lengths in points.
struct Stroke {
  double width = 0.5;
  std::vector<double> dash;  ///< on, off, on, off …; empty: solid
  Cap cap = Cap::butt;
  Join join = Join::miter;
  double miter_limit = 4;
};

struct FillItem {
  Path path;  ///< non-zero winding; open contours are closed
  Color color;
};

struct StrokeItem {
  Path path;
  Stroke stroke;
  Color color;
};

/// The typefaces that text is set in: those of STIXGeneral, and behind them four for each family that was asked for (fonts.hpp).
enum class Face : std::uint8_t { regular, italic, bold, bold_italic };
inline constexpr int faces_in_family = 4;

inline bool is_italic(Face face) { return static_cast<int>(face) % 2 == 1; }
inline bool is_bold(Face face) { return static_cast<int>(face) % faces_in_family >= 2; }
inline int family_of(Face face) { return static_cast<int>(face) / faces_in_family; }
/// The face of another family that leans and weighs the same.
inline Face in_family(Face face, int family) {
  return static_cast<Face>(static_cast<int>(face) % faces_in_family + faces_in_family * family);
}

struct Glyph {
  std::uint32_t id = 0;  ///< in the face
  Point at{0, 0};        ///< of its origin on the baseline, before the run is turned
  int bytes = 0;         ///< of the run's text that it stands for
};

/// Glyphs of one face and size, on baselines of their own. Turned by `angle` (radians, counter-clockwise on
/// the page) about `origin`; glyph positions are relative to `origin`.
struct GlyphRun {
  Face face = Face::regular;
  double size = 9;
  Point origin{0, 0};
  double angle = 0;
  std::vector<Glyph> glyphs;
  std::string text;  ///< UTF-8: what a reader copies out of the PDF
  Color color;
};

/// The same small convex shape at many places: a scatter plot. Back ends with curves in their files may draw
/// it as pixels when it is long.
struct DotsItem {
  Path shape;  ///< about the origin, convex
  std::vector<Point> at;
  Color color;
};

/// Pixels, such as a scene in space, stretched over `rect`. For files and Cairo's pixels; OSMesa does not draw it.
struct PictureItem {
  image::Image picture;
  Rect rect;
};

/// Until the matching ClipEnd nothing outside is drawn. Not nested.
struct ClipBegin {
  Rect rect;
};
struct ClipEnd {};

using Item = std::variant<FillItem, StrokeItem, GlyphRun, DotsItem, PictureItem, ClipBegin, ClipEnd>;

/// What a stretch of items stands for, so that a reader of the list can tell data from furniture (referee.hpp).
/// Back ends do not look at it.
struct Tag {
  enum class Kind {
    marker,     ///< one point of a series
    dots,       ///< a cloud
    area,       ///< the cells of a series
    curve,      ///< a line, an outline, a band's edge
    beyond,     ///< an arrow at the frame for points outside
    sample,     ///< of a legend
    named,      ///< a name beside the curve itself
    reference,  ///< a line that is no data
    contour     ///< a line of equal value of a map; its series is the value
  };
  Kind kind = Kind::marker;
  int panel = 0;                    ///< counted from 0; -1: the whole figure's, or an inset's
  std::string series;               ///< its name; of a sample the label
  std::size_t points = 0;           ///< of the series that it stands for
  std::size_t first = 0, last = 0;  ///< items [first, last)
};

struct DisplayList {
  double width = 0, height = 0;  ///< of the page, points
  Color background = Color::hex(0xffffff);
  std::vector<Item> items;
  std::vector<Tag> tags;

  /// What was added since `first` is this.
  void tag(Tag::Kind kind, int panel, const std::string& series, std::size_t points, std::size_t first) {
    if (items.size() > first) tags.push_back({kind, panel, series, points, first, items.size()});
  }

  void fill(Path path, Color color) { items.emplace_back(FillItem{std::move(path), color}); }
  void stroke(Path path, Stroke s, Color color) {
    items.emplace_back(StrokeItem{std::move(path), std::move(s), color});
  }
};

/// Scatter plots with more dots than this become pixels inside PDF and SVG.
inline constexpr std::size_t dots_kept_as_curves = 5000;

}  // namespace chute::plot
