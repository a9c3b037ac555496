#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "plot/display_list.hpp"

namespace chute::plot {

/// The number of a family of fonts that this machine has, by the name that fontconfig knows it by; 0 is STIXGeneral, which comes
/// with chute. InputError if there is none of that name.
int font_family(const std::string& name);
/// Its name.
std::string family_name(int family);

/// While it lives, the calling thread sets texts in that family; what the family has no character for is set in STIXGeneral.
class FamilyScope {
 public:
  explicit FamilyScope(int family);
  ~FamilyScope();
  FamilyScope(const FamilyScope&) = delete;
  FamilyScope& operator=(const FamilyScope&) = delete;
  static int current();

 private:
  int before_;
};

/// Fonts, read once per thread: metrics, shaping and outlines. STIXGeneral is the Debian package fonts-stix.
/// All lengths in em (multiply by the size), y downwards.
class Fonts {
 public:
  /// The calling thread's own. WorkError if a font file is missing or damaged.
  static Fonts& mine();

  struct Metrics {
    double advance = 0;
    Rect box;  ///< of the ink; empty for a space
  };

  bool has(Face face, char32_t character);
  /// Glyph of a code point. InputError naming the character if the face lacks it: never a gap.
  std::uint32_t glyph(Face face, char32_t character);
  const Metrics& metrics(Face face, std::uint32_t glyph);
  const Path& outline(Face face, std::uint32_t glyph);

  struct Shaped {
    std::uint32_t glyph = 0;
    double x = 0;          ///< of its origin
    std::size_t byte = 0;  ///< of the text where its letter begins
  };
  /// Kerned upright or slanted text. InputError naming a missing character or broken UTF-8.
  std::vector<Shaped> shape(Face face, std::string_view text, double& advance);

  /// The file that a face is read from, and which of the fonts in it, for back ends that embed it.
  struct Source {
    std::string path;
    int index = 0;
  };
  static Source source(Face face);
  /// "FreeType 2.12.1, HarfBuzz 6.0.0"
  static std::string versions();
  /// The FreeType face (FT_Face), for the back ends' own libraries.
  void* native(Face face);

  ~Fonts();
  Fonts(const Fonts&) = delete;
  Fonts& operator=(const Fonts&) = delete;

 private:
  Fonts();
  struct Files;
  std::unique_ptr<Files> files_;
};

/// UTF-8 to code points; InputError if it is broken.
std::u32string decode_utf8(std::string_view text);
std::string encode_utf8(char32_t character);

}  // namespace chute::plot
