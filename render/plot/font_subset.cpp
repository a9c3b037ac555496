#include "plot/font_subset.hpp"

#include <ft2build.h>
#include FT_FREETYPE_H
#include <hb-subset.h>

#include <memory>
#include <unordered_map>

#include "common/error.hpp"
#include "plot/fonts.hpp"

namespace chute::plot {
namespace {

template <auto destroy>
struct Destroy {
  template <class T>
  void operator()(T* thing) const {
    destroy(thing);
  }
};
template <class T, auto destroy>
using Owned = std::unique_ptr<T, Destroy<destroy>>;

}  // namespace

std::string subset_font(Face face, const std::set<char32_t>& characters) {
  const auto [path, index] = Fonts::source(face);
  const Owned<hb_blob_t, hb_blob_destroy> file(hb_blob_create_from_file_or_fail(path.c_str()));
  if (!file) throw WorkError(path + ": cannot read this font");
  const Owned<hb_face_t, hb_face_destroy> whole(hb_face_create(file.get(), static_cast<unsigned>(index)));
  const Owned<hb_subset_input_t, hb_subset_input_destroy> input(hb_subset_input_create_or_fail());
  if (!input) throw WorkError("HarfBuzz cannot make a subset: out of memory");
  for (char32_t c : characters) hb_set_add(hb_subset_input_unicode_set(input.get()), c);
  // letters are placed one by one: rules for placing and joining them are not needed
  for (const hb_tag_t table : {HB_TAG('G', 'S', 'U', 'B'), HB_TAG('G', 'P', 'O', 'S'),
                               HB_TAG('G', 'D', 'E', 'F'), HB_TAG('k', 'e', 'r', 'n')})
    hb_set_add(hb_subset_input_set(input.get(), HB_SUBSET_SETS_DROP_TABLE_TAG), table);
  const Owned<hb_face_t, hb_face_destroy> part(hb_subset_or_fail(whole.get(), input.get()));
  if (!part) throw WorkError(path + ": HarfBuzz cannot make a subset of this font");
  const Owned<hb_blob_t, hb_blob_destroy> blob(hb_face_reference_blob(part.get()));
  unsigned length = 0;
  const char* bytes = hb_blob_get_data(blob.get(), &length);
  return {bytes, length};
}

char32_t character_of(Face face, std::uint32_t glyph) {
  static thread_local std::unordered_map<int, std::unordered_map<std::uint32_t, char32_t>> characters;
  auto& known = characters[static_cast<int>(face)];
  if (known.empty()) {
    const auto file = static_cast<FT_Face>(Fonts::mine().native(face));
    FT_UInt id = 0;
    for (FT_ULong c = FT_Get_First_Char(file, &id); id != 0; c = FT_Get_Next_Char(file, c, &id))
      known.emplace(id, static_cast<char32_t>(c));
  }
  const auto found = known.find(glyph);
  return found == known.end() ? 0 : found->second;
}

}  // namespace chute::plot
