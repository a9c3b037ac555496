#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "image/image.hpp"

namespace chute::image {

/// Metadata in the order in which it is written: keyword (1 to 79 Latin-1 letters, "Title", "Software" …) and
/// text.
using Text = std::vector<std::pair<std::string, std::string>>;

/// zlib levels. `fast` is what frames are written with; `small` is for the few pictures kept in a repository.
inline constexpr int fast_level = 2, small_level = 9;

/// The picture as a PNG file's bytes: 8 bits, RGB if every pixel is opaque, else RGBA, one filter (up). The
/// same picture gives the same bytes: no time is written. `dpi` > 0 says how large a pixel is in print.
std::string encode_png(const Image& image, const Text& text = {}, int level = fast_level, double dpi = 0);

/// Writes it atomically. WorkError if the file cannot be written.
void write_png(const std::filesystem::path& path, const Image& image, const Text& text = {},
               int level = fast_level, double dpi = 0);

/// Any PNG, turned into 8-bit RGBA; gray, palette, 16 bits and interlaced ones too. InputError `NAME: what`
/// if the bytes are no PNG, are cut short or are damaged.
Image decode_png(std::string_view bytes, const std::string& name);
Image read_png(const std::filesystem::path& path);

/// The text that a PNG file carries, before or after its pixels. InputError as read_png.
std::map<std::string, std::string> read_png_text(const std::filesystem::path& path);

}  // namespace chute::image
