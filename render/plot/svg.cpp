#include "plot/svg.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "common/base64.hpp"
#include "image/png.hpp"
#include "plot/cairo_canvas.hpp"
#include "plot/font_subset.hpp"
#include "plot/fonts.hpp"

namespace chute::plot {
namespace {

constexpr const char* family = "STIXGeneral";

/// A length in points, to a thousandth.
std::string number(double value) {
  auto text = fmt::format("{:.3f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}
std::string pair(Point p) { return fmt::format("{} {}", number(p.x()), number(p.y())); }
std::string numbers(const std::vector<double>& values) {
  std::string out;
  for (double v : values) {
    if (!out.empty()) out += ' ';
    out += number(v);
  }
  return out;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return out;
}

/// ` fill="#0072b2" fill-opacity="0.3"`
std::string paint(const char* what, Color c) {
  const auto byte = [](double v) { return static_cast<int>(std::lround(255 * v)); };
  auto text = fmt::format(" {}=\"#{:02x}{:02x}{:02x}\"", what, byte(c.r), byte(c.g), byte(c.b));
  if (c.a < 1) text += fmt::format(" {}-opacity=\"{}\"", what, number(c.a));
  return text;
}

std::string path_data(const Path& path) {
  std::string out;
  std::size_t k = 0;
  const auto& p = path.points;
  for (auto verb : path.verbs) switch (verb) {
      case Path::Verb::move:
        out += fmt::format("M{}", pair(p[k++]));
        break;
      case Path::Verb::line:
        out += fmt::format("L{}", pair(p[k++]));
        break;
      case Path::Verb::cubic:
        out += fmt::format("C{} {} {}", pair(p[k]), pair(p[k + 1]), pair(p[k + 2]));
        k += 3;
        break;
      case Path::Verb::close:
        out += "Z";
        break;
    }
  return out;
}

/// What a reader takes the glyph for, if the face draws it so; else another character that it draws so (the
/// bar over a letter is read as a combining one and drawn as one that stands alone).
char32_t shown_character(Face face, std::uint32_t glyph, const std::string& text) {
  const auto read = decode_utf8(text);
  if (read.size() == 1 && Fonts::mine().glyph(face, read[0]) == glyph) return read[0];
  return character_of(face, glyph);
}

class Writer {
 public:
  std::string body;
  std::map<Face, std::set<char32_t>> used;  ///< characters by face

  void add(const FillItem& item) {
    end_text();
    body += "<path d=\"" + path_data(item.path) + "\"" + paint("fill", item.color) + "/>\n";
  }

  void add(const StrokeItem& item) {
    end_text();
    const auto& s = item.stroke;
    body += "<path d=\"" + path_data(item.path) + "\" fill=\"none\"" + paint("stroke", item.color) +
            " stroke-width=\"" + number(s.width) + "\"";
    if (s.cap != Cap::butt)
      body += fmt::format(" stroke-linecap=\"{}\"", s.cap == Cap::round ? "round" : "square");
    if (s.join != Join::miter)
      body += fmt::format(" stroke-linejoin=\"{}\"", s.join == Join::round ? "round" : "bevel");
    else if (s.miter_limit != 4)
      body += " stroke-miterlimit=\"" + number(s.miter_limit) + "\"";
    if (!s.dash.empty()) body += fmt::format(" stroke-dasharray=\"{}\"", numbers(s.dash));
    body += "/>\n";
  }

  /// Runs that stand on one origin are one label.
  void add(const GlyphRun& run) {
    const bool same =
        in_text_ && run.origin.x() == origin_.x() && run.origin.y() == origin_.y() && run.angle == angle_;
    if (!same) {
      end_text();
      in_text_ = true, origin_ = run.origin, angle_ = run.angle;
      body += "<text transform=\"translate(" + pair(origin_) + ")";
      if (angle_ != 0) body += " rotate(" + number(-angle_ * 180 / std::numbers::pi) + ")";
      body += "\">";
    }
    Span span;
    std::size_t byte = 0;
    double expected = 0;  // where the next letter stands by itself
    for (const auto& glyph : run.glyphs) {
      const auto bytes = static_cast<std::size_t>(glyph.bytes);
      const char32_t c = shown_character(run.face, glyph.id, run.text.substr(byte, bytes));
      byte += bytes;
      used[run.face].insert(c);
      const double off = std::abs(glyph.at.x() - expected);
      // readers that take only the first place of a span (librsvg) still see the spaces of mathematics
      if (!span.text.empty() && (off > 0.12 * run.size || glyph.at.y() != span.y)) put(run, span);
      if (!span.text.empty()) span.kerned |= off > 0.005;
      if (span.text.empty()) span.y = glyph.at.y();
      span.text += escaped(encode_utf8(c));
      span.x.push_back(glyph.at.x());
      expected = glyph.at.x() + run.size * Fonts::mine().metrics(run.face, glyph.id).advance;
    }
    put(run, span);
  }

  void add(const DotsItem& item) {
    end_text();
    if (item.at.size() > dots_kept_as_curves) return add_as_picture(item);
    body += fmt::format("<defs><path id=\"dot{}\" d=\"{}\"/></defs>\n<g{}>\n", shapes_, path_data(item.shape),
                        paint("fill", item.color));
    for (Point p : item.at)
      body += fmt::format("<use xlink:href=\"#dot{}\" x=\"{}\" y=\"{}\"/>\n", shapes_, number(p.x()),
                          number(p.y()));
    body += "</g>\n";
    ++shapes_;
  }

  void add(const PictureItem& item) {
    end_text();
    put_picture(item.picture, item.rect);
  }

  void add(const ClipBegin& clip) {
    end_text();
    clip_ = clip.rect;
    body += fmt::format(
        "<clipPath id=\"clip{}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n", clips_,
        number(clip_.left), number(clip_.top), number(clip_.width()), number(clip_.height()));
    body += fmt::format("<g clip-path=\"url(#clip{})\">\n", clips_++);
  }
  void add(const ClipEnd&) {
    end_text();
    body += "</g>\n";
  }

  void end_text() {
    if (in_text_) body += "</text>\n";
    in_text_ = false;
  }

 private:
  bool in_text_ = false;
  Point origin_{0, 0};
  double angle_ = 0;
  int shapes_ = 0, clips_ = 0;
  Rect clip_;

  /// Letters that follow one another on a baseline.
  struct Span {
    std::string text;
    std::vector<double> x;
    double y = 0;
    bool kerned =
        false;  ///< some stand nearer to each other, or farther apart, than they would by themselves
  };

  /// Writes and empties the span.
  void put(const GlyphRun& run, Span& span) {
    if (span.text.empty()) return;
    if (!span.kerned) span.x.resize(1);
    body += fmt::format("<tspan x=\"{}\" y=\"{}\" font-size=\"{}\"", numbers(span.x), number(span.y),
                        number(run.size));
    if (family_of(run.face) > 0)
      body += fmt::format(" font-family=\"'{}'\"", escaped(family_name(family_of(run.face))));
    if (is_italic(run.face)) body += " font-style=\"italic\"";
    if (is_bold(run.face)) body += " font-weight=\"bold\"";
    body += paint("fill", run.color) + ">" + span.text + "</tspan>";
    span = {};
  }

  void add_as_picture(const DotsItem& item) {
    const Rect box = visible_box(item, clip_);
    if (box.left >= box.right || box.top >= box.bottom) return;
    DisplayList page;
    page.width = box.width(), page.height = box.height(), page.background.a = 0;
    auto& moved = std::get<DotsItem>(page.items.emplace_back(item));
    for (Point& p : moved.at) p = p - Point{box.left, box.top};
    put_picture(rasterise_by_cairo(page, dots_dpi), box);
  }

  void put_picture(const image::Image& picture, const Rect& box) {
    body += fmt::format(
        "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
        "xlink:href=\"data:image/png;base64,{}\"/>\n",
        number(box.left), number(box.top), number(box.width()), number(box.height()),
        base64(image::encode_png(picture)));
  }
};

std::string font_faces(const std::map<Face, std::set<char32_t>>& used) {
  std::string style;
  for (const auto& [face, characters] : used) {
    const int number = family_of(face);
    const bool is_otf = Fonts::source(face).path.ends_with(".otf");
    style += fmt::format(
        "@font-face{{font-family:{};font-style:{};font-weight:{};src:url(data:font/{};base64,{})}}\n",
        number == 0 ? std::string(family) : "'" + escaped(family_name(number)) + "'",
        is_italic(face) ? "italic" : "normal", is_bold(face) ? "bold" : "normal", is_otf ? "otf" : "ttf",
        base64(subset_font(face, characters)));
  }
  return style;
}

}  // namespace

std::string svg_text(const DisplayList& list, const Metadata& metadata) {
  Writer writer;
  for (const auto& item : list.items) std::visit([&](const auto& i) { writer.add(i); }, item);
  writer.end_text();
  const auto width = number(list.width), height = number(list.height);
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
      "width=\"{}pt\" height=\"{}pt\" viewBox=\"0 0 {} {}\" version=\"1.1\">\n",
      width, height, width, height);
  std::string rest;
  for (const auto& [key, value] : metadata)
    if (key == "Title")
      out += "<title>" + escaped(value) + "</title>\n";
    else
      rest += escaped(key) + ": " + escaped(value) + "\n";
  if (!rest.empty()) out += "<desc>" + rest + "</desc>\n";
  const auto fonts = font_faces(writer.used);
  if (!fonts.empty()) out += "<style>\n" + fonts + "</style>\n";
  if (list.background.a > 0)
    out +=
        "<rect width=\"" + width + "\" height=\"" + height + "\"" + paint("fill", list.background) + "/>\n";
  out += fmt::format(
      "<g font-family=\"{}, 'STIX Two Text', 'Times New Roman', serif\" xml:space=\"preserve\" "
      "font-kerning=\"none\">\n",
      family);
  return out + writer.body + "</g>\n</svg>\n";
}

}  // namespace chute::plot
