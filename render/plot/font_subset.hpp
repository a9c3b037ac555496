#pragma once
#include <cstdint>
#include <set>
#include <string>

#include "plot/display_list.hpp"

namespace chute::plot {

/// The face reduced to these characters, as the bytes of an OpenType file: the same for the same characters.
/// WorkError if the font cannot be reduced.
std::string subset_font(Face face, const std::set<char32_t>& characters);

/// A character that the face shows as this glyph; 0 if there is none.
char32_t character_of(Face face, std::uint32_t glyph);

}  // namespace chute::plot
