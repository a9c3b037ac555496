#include "plot/fonts.hpp"

#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
#include FT_BBOX_H
#include <hb-ft.h>
#include <hb.h>

#include <array>
#include <unordered_map>

#include "common/error.hpp"
#include "common/share_folder.hpp"

namespace chute::plot {
namespace {

constexpr std::array<const char*, 4> file_names{"STIXGeneral-Regular.otf", "STIXGeneral-Italic.otf",
                                                "STIXGeneral-Bold.otf", "STIXGeneral-BoldItalic.otf"};
constexpr std::array<const char*, 4> face_names{"regular", "italic", "bold", "bold italic"};

struct Drawn {
  Fonts::Metrics metrics;
  Path outline;
};

struct Collector {
  Path* path;
  double scale;
  bool open = false;
  Point at(const FT_Vector* v) const { return {v->x * scale, -v->y * scale}; }
};

int on_move(const FT_Vector* to, void* user) {
  auto& c = *static_cast<Collector*>(user);
  if (c.open) c.path->close();
  c.open = true;
  c.path->move(c.at(to));
  return 0;
}
int on_line(const FT_Vector* to, void* user) {
  auto& c = *static_cast<Collector*>(user);
  c.path->line(c.at(to));
  return 0;
}
int on_conic(const FT_Vector* control, const FT_Vector* to, void* user) {
  auto& c = *static_cast<Collector*>(user);
  const Point from = c.path->points.back(), q = c.at(control), end = c.at(to);
  c.path->cubic(from + (2.0 / 3) * (q - from), end + (2.0 / 3) * (q - end), end);
  return 0;
}
int on_cubic(const FT_Vector* a, const FT_Vector* b, const FT_Vector* to, void* user) {
  auto& c = *static_cast<Collector*>(user);
  c.path->cubic(c.at(a), c.at(b), c.at(to));
  return 0;
}

}  // namespace

struct Fonts::Files {
  FT_Library library = nullptr;
  std::array<FT_Face, 4> faces{};
  std::array<hb_font_t*, 4> shapers{};
  std::array<std::unordered_map<std::uint32_t, Drawn>, 4> drawn;

  const Drawn& load(Face face, std::uint32_t glyph) {
    const auto i = static_cast<std::size_t>(face);
    const auto found = drawn[i].find(glyph);
    if (found != drawn[i].end()) return found->second;
    FT_Face file = faces[i];
    if (FT_Load_Glyph(file, glyph, FT_LOAD_NO_SCALE) != 0)
      throw WorkError(fmt::format("{}: cannot read glyph {}", Fonts::file(face), glyph));
    Drawn result;
    Collector collector{&result.outline, 1.0 / file->units_per_EM};
    FT_Outline_Funcs functions{on_move, on_line, on_conic, on_cubic, 0, 0};
    FT_Outline_Decompose(&file->glyph->outline, &functions, &collector);
    if (collector.open) result.outline.close();
    result.metrics.advance = file->glyph->metrics.horiAdvance * collector.scale;
    FT_BBox box{};
    FT_Outline_Get_BBox(&file->glyph->outline, &box);
    result.metrics.box = {box.xMin * collector.scale, -box.yMax * collector.scale, box.xMax * collector.scale,
                          -box.yMin * collector.scale};
    return drawn[i].emplace(glyph, std::move(result)).first->second;
  }
};

Fonts& Fonts::mine() {
  static thread_local Fonts fonts;
  return fonts;
}

std::string Fonts::file(Face face) {
  return (share_folder() / "fonts" / file_names[static_cast<std::size_t>(face)]).string();
}

Fonts::Fonts() : files_(std::make_unique<Files>()) {
  if (FT_Init_FreeType(&files_->library) != 0) throw WorkError("cannot start FreeType");
  for (std::size_t i = 0; i < file_names.size(); ++i) {
    const auto path = file(static_cast<Face>(i));
    if (FT_New_Face(files_->library, path.c_str(), 0, &files_->faces[i]) != 0)
      throw WorkError(path + ": cannot read this font; it belongs to the package fonts-stix");
    FT_Set_Char_Size(files_->faces[i], files_->faces[i]->units_per_EM * 64, 0, 72, 72);
    files_->shapers[i] = hb_ft_font_create(files_->faces[i], nullptr);
    hb_ft_font_set_load_flags(files_->shapers[i], FT_LOAD_NO_HINTING);
  }
}

Fonts::~Fonts() {
  for (auto* shaper : files_->shapers) hb_font_destroy(shaper);
  for (auto* face : files_->faces)
    if (face) FT_Done_Face(face);
  FT_Done_FreeType(files_->library);
}

std::string Fonts::versions() {
  return fmt::format("FreeType {}.{}.{}, HarfBuzz {}", FREETYPE_MAJOR, FREETYPE_MINOR, FREETYPE_PATCH,
                     hb_version_string());
}

void* Fonts::native(Face face) { return files_->faces[static_cast<std::size_t>(face)]; }

std::uint32_t Fonts::glyph(Face face, char32_t character) {
  const auto i = static_cast<std::size_t>(face);
  const auto id = FT_Get_Char_Index(files_->faces[i], character);
  if (id == 0)
    throw InputError(fmt::format("the font STIXGeneral {} lacks the character {} (U+{:04X})", face_names[i],
                                 encode_utf8(character), static_cast<std::uint32_t>(character)));
  return id;
}

const Fonts::Metrics& Fonts::metrics(Face face, std::uint32_t glyph) {
  return files_->load(face, glyph).metrics;
}
const Path& Fonts::outline(Face face, std::uint32_t glyph) { return files_->load(face, glyph).outline; }

std::vector<Fonts::Shaped> Fonts::shape(Face face, std::string_view text, double& advance) {
  for (char32_t c : decode_utf8(text)) glyph(face, c);
  const auto i = static_cast<std::size_t>(face);
  hb_buffer_t* buffer = hb_buffer_create();
  hb_buffer_add_utf8(buffer, text.data(), static_cast<int>(text.size()), 0, static_cast<int>(text.size()));
  hb_buffer_set_direction(buffer, HB_DIRECTION_LTR);
  hb_buffer_set_script(buffer, HB_SCRIPT_LATIN);
  hb_buffer_set_language(buffer, hb_language_from_string("en", -1));
  // ligatures off: a letter stays a letter where the text is copied or searched
  const hb_feature_t off[] = {{HB_TAG('l', 'i', 'g', 'a'), 0, 0, HB_FEATURE_GLOBAL_END},
                              {HB_TAG('c', 'l', 'i', 'g'), 0, 0, HB_FEATURE_GLOBAL_END}};
  hb_shape(files_->shapers[i], buffer, off, 2);
  unsigned count = 0;
  const auto* infos = hb_buffer_get_glyph_infos(buffer, &count);
  const auto* positions = hb_buffer_get_glyph_positions(buffer, &count);
  const double scale = 1.0 / (64.0 * files_->faces[i]->units_per_EM);
  std::vector<Shaped> shaped;
  double x = 0;
  for (unsigned k = 0; k < count; ++k) {
    shaped.push_back({infos[k].codepoint, x + positions[k].x_offset * scale, infos[k].cluster});
    x += positions[k].x_advance * scale;
  }
  hb_buffer_destroy(buffer);
  advance = x;
  return shaped;
}

std::u32string decode_utf8(std::string_view text) {
  std::u32string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const int length = first < 0x80 ? 1 : first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : first >= 0xc2 ? 2 : 0;
    char32_t c = length == 1 ? first : length ? first & (0xff >> (length + 1)) : 0;
    bool good = length > 0 && first < 0xf5 && i + static_cast<std::size_t>(length) <= text.size();
    for (int k = 1; good && k < length; ++k) {
      const auto next = static_cast<unsigned char>(text[i + static_cast<std::size_t>(k)]);
      good = (next & 0xc0) == 0x80;
      c = (c << 6) | (next & 0x3f);
    }
    if (!good) throw InputError("text is not UTF-8");
    out.push_back(c);
    i += static_cast<std::size_t>(length);
  }
  return out;
}

std::string encode_utf8(char32_t c) {
  std::string out;
  if (c < 0x80) {
    out += static_cast<char>(c);
  } else if (c < 0x800) {
    out += static_cast<char>(0xc0 | (c >> 6));
    out += static_cast<char>(0x80 | (c & 0x3f));
  } else if (c < 0x10000) {
    out += static_cast<char>(0xe0 | (c >> 12));
    out += static_cast<char>(0x80 | ((c >> 6) & 0x3f));
    out += static_cast<char>(0x80 | (c & 0x3f));
  } else {
    out += static_cast<char>(0xf0 | (c >> 18));
    out += static_cast<char>(0x80 | ((c >> 12) & 0x3f));
    out += static_cast<char>(0x80 | ((c >> 6) & 0x3f));
    out += static_cast<char>(0x80 | (c & 0x3f));
  }
  return out;
}

}  // namespace chute::plot
