#include "plot/cairo_canvas.hpp"

#include <cairo-ft.h>
#include <ft2build.h>
#include FT_FREETYPE_H

#include <cmath>
#include <cstring>
#include <map>
#include <mutex>
#include <string>

#include "common/error.hpp"
#include "plot/fonts.hpp"

namespace chute::plot {
namespace {

/// Cairo keeps fonts in caches beyond the life of a drawing, so these live as long as the program. Cairo
/// locks them.
cairo_font_face_t* cairo_face(Face face) {
  static std::mutex mutex;
  static std::map<Face, cairo_font_face_t*> made;
  static FT_Library library = nullptr;
  const std::lock_guard lock(mutex);
  if (!library && FT_Init_FreeType(&library) != 0) throw WorkError("cannot start FreeType");
  auto& found = made[face];
  if (found) return found;
  const auto [path, index] = Fonts::source(face);
  FT_Face file = nullptr;
  if (FT_New_Face(library, path.c_str(), index, &file) != 0)
    throw WorkError(path + ": cannot read this font" +
                    (family_of(face) == 0 ? "; it belongs to the package fonts-stix" : ""));
  return found = cairo_ft_font_face_create_for_ft_face(file, FT_LOAD_NO_HINTING);
}

class Canvas {
 public:
  Canvas(cairo_t* cairo, Target target) : cairo_(cairo), target_(target) {}

  void draw(const FillItem& item) {
    trace(item.path);
    ink(item.color);
    cairo_set_fill_rule(cairo_, CAIRO_FILL_RULE_WINDING);
    cairo_fill(cairo_);
  }

  void draw(const StrokeItem& item) {
    trace(item.path);
    ink(item.color);
    const auto& s = item.stroke;
    cairo_set_line_width(cairo_, s.width);
    cairo_set_line_cap(cairo_, s.cap == Cap::butt    ? CAIRO_LINE_CAP_BUTT
                               : s.cap == Cap::round ? CAIRO_LINE_CAP_ROUND
                                                     : CAIRO_LINE_CAP_SQUARE);
    cairo_set_line_join(cairo_, s.join == Join::miter   ? CAIRO_LINE_JOIN_MITER
                                : s.join == Join::round ? CAIRO_LINE_JOIN_ROUND
                                                        : CAIRO_LINE_JOIN_BEVEL);
    cairo_set_miter_limit(cairo_, s.miter_limit);
    cairo_set_dash(cairo_, s.dash.data(), static_cast<int>(s.dash.size()), 0);
    cairo_stroke(cairo_);
  }

  void draw(const GlyphRun& run) {
    cairo_save(cairo_);
    cairo_translate(cairo_, run.origin.x(), run.origin.y());
    cairo_rotate(cairo_, -run.angle);
    cairo_set_font_face(cairo_, cairo_face(run.face));
    cairo_set_font_size(cairo_, run.size);
    ink(run.color);
    std::vector<cairo_glyph_t> glyphs;
    std::vector<cairo_text_cluster_t> clusters;
    for (const auto& g : run.glyphs) {
      glyphs.push_back({g.id, g.at.x(), g.at.y()});
      clusters.push_back({g.bytes, 1});
    }
    if (target_ == Target::pixels) {
      cairo_glyph_path(cairo_, glyphs.data(), static_cast<int>(glyphs.size()));
      cairo_fill(cairo_);
      return cairo_restore(cairo_);
    }
    cairo_show_text_glyphs(cairo_, run.text.data(), static_cast<int>(run.text.size()), glyphs.data(),
                           static_cast<int>(glyphs.size()), clusters.data(),
                           static_cast<int>(clusters.size()), static_cast<cairo_text_cluster_flags_t>(0));
    cairo_restore(cairo_);
  }

  void draw(const DotsItem& item) {
    if (item.at.size() > dots_kept_as_curves && target_ == Target::file)
      dots_as_picture(item);
    else
      dots(cairo_, item);
  }

  void draw(const PictureItem& item) {
    const auto& from = item.picture;
    cairo_surface_t* picture = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, from.width, from.height);
    unsigned char* const data = cairo_image_surface_get_data(picture);
    const int stride = cairo_image_surface_get_stride(picture);
    for (int y = 0; y < from.height; ++y)
      for (int x = 0; x < from.width; ++x) {
        // Cairo's pixels are whole words with alpha multiplied in
        const auto* p = from.pixel(x, y);
        const std::uint32_t alpha = p[3];
        std::uint32_t word = alpha << 24;
        for (int c = 0; c < 3; ++c) word |= (p[c] * alpha + 127) / 255 << (16 - 8 * c);
        std::memcpy(data + static_cast<std::ptrdiff_t>(y) * stride + 4 * x, &word, 4);
      }
    cairo_surface_mark_dirty(picture);
    cairo_save(cairo_);
    cairo_translate(cairo_, item.rect.left, item.rect.top);
    cairo_scale(cairo_, item.rect.width() / from.width, item.rect.height() / from.height);
    cairo_set_source_surface(cairo_, picture, 0, 0);
    cairo_paint(cairo_);
    cairo_restore(cairo_);
    cairo_surface_destroy(picture);
  }

  void draw(const ClipBegin& clip) {
    cairo_save(cairo_);
    cairo_rectangle(cairo_, clip.rect.left, clip.rect.top, clip.rect.width(), clip.rect.height());
    cairo_clip(cairo_);
    clip_ = clip.rect;
  }
  void draw(const ClipEnd&) { cairo_restore(cairo_); }

 private:
  cairo_t* cairo_;
  Target target_;
  Rect clip_;

  void ink(Color c) { cairo_set_source_rgba(cairo_, c.r, c.g, c.b, c.a); }

  static void trace(cairo_t* cairo, const Path& path, Point by = {0, 0}) {
    std::size_t k = 0;
    const auto& p = path.points;
    for (auto verb : path.verbs) switch (verb) {
        case Path::Verb::move:
          cairo_move_to(cairo, by.x() + p[k].x(), by.y() + p[k].y()), ++k;
          break;
        case Path::Verb::line:
          cairo_line_to(cairo, by.x() + p[k].x(), by.y() + p[k].y()), ++k;
          break;
        case Path::Verb::cubic:
          cairo_curve_to(cairo, by.x() + p[k].x(), by.y() + p[k].y(), by.x() + p[k + 1].x(),
                         by.y() + p[k + 1].y(), by.x() + p[k + 2].x(), by.y() + p[k + 2].y());
          k += 3;
          break;
        case Path::Verb::close:
          cairo_close_path(cairo);
          break;
      }
  }
  void trace(const Path& path) { trace(cairo_, path); }

  static void dots(cairo_t* cairo, const DotsItem& item) {
    cairo_set_source_rgba(cairo, item.color.r, item.color.g, item.color.b, item.color.a);
    for (Point p : item.at) {
      trace(cairo, item.shape, p);
      cairo_fill(cairo);
    }
  }

  /// A long scatter plot as a transparent picture: a PDF with 10^5 circles opens slowly
  /// everywhere.
  void dots_as_picture(const DotsItem& item) {
    const Rect box = visible_box(item, clip_);
    if (box.left >= box.right || box.top >= box.bottom) return;
    constexpr double per_point = dots_dpi / 72;
    const int width = static_cast<int>(std::ceil(box.width() * per_point));
    const int height = static_cast<int>(std::ceil(box.height() * per_point));
    cairo_surface_t* picture = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height);
    cairo_t* inside = cairo_create(picture);
    cairo_scale(inside, per_point, per_point);
    cairo_translate(inside, -box.left, -box.top);
    dots(inside, item);
    check_cairo(cairo_status(inside), "drawing dots");
    cairo_destroy(inside);
    cairo_save(cairo_);
    cairo_translate(cairo_, box.left, box.top);
    cairo_scale(cairo_, 1 / per_point, 1 / per_point);
    cairo_set_source_surface(cairo_, picture, 0, 0);
    cairo_paint(cairo_);
    cairo_restore(cairo_);
    cairo_surface_destroy(picture);
  }
};

}  // namespace

Rect visible_box(const DotsItem& item, const Rect& clip) {
  Rect box = Rect::nothing();
  for (Point p : item.at) box.include(p);
  const Rect shape = item.shape.bounds();
  return {std::max(clip.left, box.left + shape.left), std::max(clip.top, box.top + shape.top),
          std::min(clip.right, box.right + shape.right), std::min(clip.bottom, box.bottom + shape.bottom)};
}

void check_cairo(cairo_status_t status, const char* doing) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw WorkError(std::string("Cairo failed at ") + doing + ": " + cairo_status_to_string(status));
}

void draw_on_cairo(cairo_t* cairo, const DisplayList& list, double scale, Target target) {
  cairo_save(cairo);
  cairo_scale(cairo, scale, scale);
  cairo_set_antialias(cairo, CAIRO_ANTIALIAS_BEST);
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(cairo, options);
  cairo_font_options_destroy(options);
  const Color paper = list.background;
  if (paper.a > 0) {
    cairo_set_source_rgba(cairo, paper.r, paper.g, paper.b, paper.a);
    cairo_paint(cairo);
  }
  Canvas canvas(cairo, target);
  for (const auto& item : list.items) std::visit([&](const auto& i) { canvas.draw(i); }, item);
  cairo_restore(cairo);
  check_cairo(cairo_status(cairo), "drawing");
}

}  // namespace chute::plot
