#include "plot/fonts.hpp"

#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
#include FT_BBOX_H
#include <fontconfig/fontconfig.h>
#include <hb-ft.h>
#include <hb.h>

#include <array>
#include <mutex>
#include <unordered_map>

#include "common/error.hpp"
#include "common/share_folder.hpp"

namespace chute::plot {
namespace {

constexpr std::array<const char*, 4> file_names{"STIXGeneral-Regular.otf", "STIXGeneral-Italic.otf",
                                                "STIXGeneral-Bold.otf", "STIXGeneral-BoldItalic.otf"};
constexpr std::array<const char*, faces_in_family> face_names{"regular", "italic", "bold", "bold italic"};

struct Family {
  std::string name;
  std::array<Fonts::Source, faces_in_family> faces;
};

/// What fontconfig has for one face of a family; an empty path if its best match is another family.
Fonts::Source find_face(const std::string& name, Face face) {
  FcPattern* wanted = FcPatternCreate();
  FcPatternAddString(wanted, FC_FAMILY, reinterpret_cast<const FcChar8*>(name.c_str()));
  FcPatternAddInteger(wanted, FC_SLANT, is_italic(face) ? FC_SLANT_ITALIC : FC_SLANT_ROMAN);
  FcPatternAddInteger(wanted, FC_WEIGHT, is_bold(face) ? FC_WEIGHT_BOLD : FC_WEIGHT_REGULAR);
  FcPatternAddInteger(wanted, FC_WIDTH, FC_WIDTH_NORMAL);
  FcPatternAddBool(wanted, FC_SCALABLE, FcTrue);
  FcConfigSubstitute(nullptr, wanted, FcMatchPattern);
  FcDefaultSubstitute(wanted);
  FcResult result = FcResultNoMatch;
  FcPattern* found = FcFontMatch(nullptr, wanted, &result);
  Fonts::Source source;
  bool same = false;
  FcChar8* text = nullptr;
  for (int k = 0; found && FcPatternGetString(found, FC_FAMILY, k, &text) == FcResultMatch; ++k)
    same = same || FcStrCmpIgnoreCase(text, reinterpret_cast<const FcChar8*>(name.c_str())) == 0;
  if (same && FcPatternGetString(found, FC_FILE, 0, &text) == FcResultMatch) {
    source.path = reinterpret_cast<const char*>(text);
    // the upper half of the index counts named instances of variable fonts
    if (FcPatternGetInteger(found, FC_INDEX, 0, &source.index) == FcResultMatch) source.index &= 0xffff;
  }
  if (found) FcPatternDestroy(found);
  FcPatternDestroy(wanted);
  return source;
}

/// All families that were asked for; never shrinks, so that faces in display lists stay what they are.
class Families {
 public:
  static Families& all() {
    static Families families;
    return families;
  }
  int number_of(const std::string& name) {
    const std::lock_guard lock(mutex_);
    for (std::size_t k = 0; k < families_.size(); ++k)
      if (families_[k].name == name) return static_cast<int>(k);
    // a face is a byte in display lists
    if ((families_.size() + 1) * faces_in_family > 255)
      throw InputError("more than 60 families of fonts in one program");
    Family family{name, {}};
    for (int k = 0; k < faces_in_family; ++k)
      family.faces[static_cast<std::size_t>(k)] = find_face(name, static_cast<Face>(k));
    if (family.faces[0].path.empty())
      throw InputError(
          fmt::format("no font \"{}\" on this machine; fc-list : family shows those that are there", name));
    families_.push_back(std::move(family));
    return static_cast<int>(families_.size()) - 1;
  }
  Family of(int number) {
    const std::lock_guard lock(mutex_);
    return families_.at(static_cast<std::size_t>(number));
  }

 private:
  std::mutex mutex_;
  std::vector<Family> families_;
  Families() {
    Family stix{"STIXGeneral", {}};
    for (std::size_t i = 0; i < file_names.size(); ++i)
      stix.faces[i].path = (share_folder() / "fonts" / file_names[i]).string();
    families_.push_back(std::move(stix));
  }
};

thread_local int current_family = 0;

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

int font_family(const std::string& name) { return Families::all().number_of(name); }
std::string family_name(int family) { return Families::all().of(family).name; }

FamilyScope::FamilyScope(int family) : before_(current_family) { current_family = family; }
FamilyScope::~FamilyScope() { current_family = before_; }
int FamilyScope::current() { return current_family; }

struct Fonts::Files {
  FT_Library library = nullptr;
  /// A face and what was read of it.
  struct Open {
    FT_Face face = nullptr;
    hb_font_t* shaper = nullptr;
    std::unordered_map<std::uint32_t, Drawn> drawn;
  };
  std::unordered_map<int, Open> open;

  Open& of(Face face) {
    const auto [at, is_new] = open.try_emplace(static_cast<int>(face));
    auto& one = at->second;
    if (!is_new) return one;
    const auto [path, index] = Fonts::source(face);
    if (FT_New_Face(library, path.c_str(), index, &one.face) != 0) {
      open.erase(at);
      throw WorkError(path + ": cannot read this font" +
                      (family_of(face) == 0 ? "; it belongs to the package fonts-stix" : ""));
    }
    FT_Set_Char_Size(one.face, one.face->units_per_EM * 64, 0, 72, 72);
    one.shaper = hb_ft_font_create(one.face, nullptr);
    hb_ft_font_set_load_flags(one.shaper, FT_LOAD_NO_HINTING);
    return one;
  }

  const Drawn& load(Face face, std::uint32_t glyph) {
    auto& [file, shaper, drawn] = of(face);
    const auto found = drawn.find(glyph);
    if (found != drawn.end()) return found->second;
    if (FT_Load_Glyph(file, glyph, FT_LOAD_NO_SCALE) != 0)
      throw WorkError(fmt::format("{}: cannot read glyph {}", Fonts::source(face).path, glyph));
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
    return drawn.emplace(glyph, std::move(result)).first->second;
  }
};

Fonts& Fonts::mine() {
  static thread_local Fonts fonts;
  return fonts;
}

Fonts::Source Fonts::source(Face face) {
  const auto family = Families::all().of(family_of(face));
  const auto& own = family.faces[static_cast<std::size_t>(in_family(face, 0))];
  return own.path.empty() ? family.faces[0] : own;  // a family without this face has its regular one for it
}

Fonts::Fonts() : files_(std::make_unique<Files>()) {
  if (FT_Init_FreeType(&files_->library) != 0) throw WorkError("cannot start FreeType");
  for (int i = 0; i < faces_in_family; ++i) files_->of(static_cast<Face>(i));
}

Fonts::~Fonts() {
  for (auto& [number, open] : files_->open) {
    hb_font_destroy(open.shaper);
    FT_Done_Face(open.face);
  }
  FT_Done_FreeType(files_->library);
}

std::string Fonts::versions() {
  return fmt::format("FreeType {}.{}.{}, HarfBuzz {}", FREETYPE_MAJOR, FREETYPE_MINOR, FREETYPE_PATCH,
                     hb_version_string());
}

void* Fonts::native(Face face) { return files_->of(face).face; }

bool Fonts::has(Face face, char32_t character) {
  return FT_Get_Char_Index(files_->of(face).face, character) != 0;
}

std::uint32_t Fonts::glyph(Face face, char32_t character) {
  const auto id = FT_Get_Char_Index(files_->of(face).face, character);
  if (id == 0)
    throw InputError(fmt::format("the font {} {} lacks the character {} (U+{:04X})",
                                 family_name(family_of(face)),
                                 face_names[static_cast<std::size_t>(in_family(face, 0))],
                                 encode_utf8(character), static_cast<std::uint32_t>(character)));
  return id;
}

const Fonts::Metrics& Fonts::metrics(Face face, std::uint32_t glyph) {
  return files_->load(face, glyph).metrics;
}
const Path& Fonts::outline(Face face, std::uint32_t glyph) { return files_->load(face, glyph).outline; }

std::vector<Fonts::Shaped> Fonts::shape(Face face, std::string_view text, double& advance) {
  for (char32_t c : decode_utf8(text)) glyph(face, c);
  auto& file = files_->of(face);
  hb_buffer_t* buffer = hb_buffer_create();
  hb_buffer_add_utf8(buffer, text.data(), static_cast<int>(text.size()), 0, static_cast<int>(text.size()));
  hb_buffer_set_direction(buffer, HB_DIRECTION_LTR);
  hb_buffer_set_script(buffer, HB_SCRIPT_LATIN);
  hb_buffer_set_language(buffer, hb_language_from_string("en", -1));
  // ligatures off: a letter stays a letter where the text is copied or searched
  const hb_feature_t off[] = {{HB_TAG('l', 'i', 'g', 'a'), 0, 0, HB_FEATURE_GLOBAL_END},
                              {HB_TAG('c', 'l', 'i', 'g'), 0, 0, HB_FEATURE_GLOBAL_END}};
  hb_shape(file.shaper, buffer, off, 2);
  unsigned count = 0;
  const auto* infos = hb_buffer_get_glyph_infos(buffer, &count);
  const auto* positions = hb_buffer_get_glyph_positions(buffer, &count);
  const double scale = 1.0 / (64.0 * file.face->units_per_EM);
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
