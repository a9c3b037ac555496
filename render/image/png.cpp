#include "image/png.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "common/atomic_file.hpp"
#include "common/error.hpp"

namespace chute::image {
namespace {

/// A damaged header can ask for any size; no picture of ours comes near this (1 GiB of memory).
constexpr std::uint64_t most_pixels = 1u << 28;

/// What libpng's callbacks throw: it is C, but built with unwind tables, and throwing through it is what its
/// own manual allows in place of longjmp.
struct PngFault {
  std::string message;
};

void on_error(png_structp, png_const_charp message) { throw PngFault{message}; }
void on_warning(png_structp, png_const_charp) {}  // e.g. odd colour profiles: not our business

struct Writer {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, on_error, on_warning);
  png_infop info = png_create_info_struct(png);
  ~Writer() { png_destroy_write_struct(&png, &info); }
};

struct Reader {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, on_error, on_warning);
  png_infop info = png_create_info_struct(png);
  std::string_view rest;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

void append(png_structp png, png_bytep data, png_size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}

void take(png_structp png, png_bytep data, png_size_t size) {
  auto& rest = static_cast<Reader*>(png_get_io_ptr(png))->rest;
  if (rest.size() < size) throw PngFault{"cut short"};
  std::memcpy(data, rest.data(), size);
  rest.remove_prefix(size);
}

bool is_ascii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](unsigned char c) { return c < 128; });
}

bool is_opaque(const Image& image) {
  for (std::size_t i = 3; i < image.rgba.size(); i += 4)
    if (image.rgba[i] != 255) return false;
  return true;
}

void add_text(Writer& writer, const Text& text) {
  std::vector<png_text> entries;
  for (const auto& [key, value] : text) {
    png_text entry{};
    // plain text for ASCII, which every tool shows; international text (UTF-8) for the rest
    entry.compression = is_ascii(value) ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
    entry.key = const_cast<char*>(key.c_str());
    entry.text = const_cast<char*>(value.c_str());
    entry.text_length = entry.compression == PNG_TEXT_COMPRESSION_NONE ? value.size() : 0;
    entry.itxt_length = entry.compression == PNG_TEXT_COMPRESSION_NONE ? 0 : value.size();
    entry.lang = const_cast<char*>("");
    entry.lang_key = const_cast<char*>("");
    entries.push_back(entry);
  }
  if (!entries.empty())
    png_set_text(writer.png, writer.info, entries.data(), static_cast<int>(entries.size()));
}

/// Runs `use` on a reader that has seen the header; every fault becomes one line about `name`.
template <class Use>
auto with_reader(std::string_view bytes, const std::string& name, Use&& use) {
  if (bytes.empty()) throw InputError(name + ": the file is empty, not a PNG picture");
  if (bytes.size() < 8 || png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, 8) != 0)
    throw InputError(name + ": not a PNG picture");
  Reader reader;
  reader.rest = bytes;
  png_set_read_fn(reader.png, &reader, take);
  png_set_crc_action(reader.png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  try {
    png_read_info(reader.png, reader.info);
    return use(reader);
  } catch (const PngFault& fault) {
    throw InputError(fmt::format("{}: damaged PNG picture: {}", name, fault.message));
  }
}

}  // namespace

std::string encode_png(const Image& image, const Text& text, int level, double dpi) {
  if (image.width <= 0 || image.height <= 0) throw WorkError("cannot write a picture without pixels as PNG");
  std::string bytes;
  Writer writer;
  try {
    png_set_write_fn(writer.png, &bytes, append, nullptr);
    const bool opaque = is_opaque(image);
    png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(image.width),
                 static_cast<png_uint_32>(image.height), 8, opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGBA,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_filter(writer.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
    png_set_compression_level(writer.png, level);
    png_set_sRGB(writer.png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
    if (dpi > 0) {
      const auto per_metre = static_cast<png_uint_32>(std::lround(dpi / 0.0254));
      png_set_pHYs(writer.png, writer.info, per_metre, per_metre, PNG_RESOLUTION_METER);
    }
    add_text(writer, text);
    png_write_info(writer.png, writer.info);
    if (opaque) png_set_filler(writer.png, 0, PNG_FILLER_AFTER);  // drops the alpha bytes
    for (int y = 0; y < image.height; ++y) png_write_row(writer.png, image.pixel(0, y));
    png_write_end(writer.png, nullptr);
  } catch (const PngFault& fault) {
    throw WorkError("cannot encode a PNG picture: " + fault.message);
  }
  return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image, const Text& text, int level,
               double dpi) {
  write_atomically(path, encode_png(image, text, level, dpi));
}

Image decode_png(std::string_view bytes, const std::string& name) {
  return with_reader(bytes, name, [](Reader& reader) {
    const auto pixels = std::uint64_t{png_get_image_width(reader.png, reader.info)} *
                        png_get_image_height(reader.png, reader.info);
    if (pixels > most_pixels)
      throw PngFault{fmt::format("{} pixels are more than this program takes", pixels)};
    png_set_expand(reader.png);  // palettes, fewer than 8 bits, transparency as a colour
    png_set_scale_16(reader.png);
    png_set_gray_to_rgb(reader.png);
    png_set_add_alpha(reader.png, 255, PNG_FILLER_AFTER);
    const int passes = png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
    Image image(static_cast<int>(png_get_image_width(reader.png, reader.info)),
                static_cast<int>(png_get_image_height(reader.png, reader.info)));
    for (int pass = 0; pass < passes; ++pass)
      for (int y = 0; y < image.height; ++y) png_read_row(reader.png, image.pixel(0, y), nullptr);
    png_read_end(reader.png, nullptr);  // a file without its end is cut short, even if all pixels came
    return image;
  });
}

Image read_png(const std::filesystem::path& path) { return decode_png(read_file(path), path.string()); }

std::map<std::string, std::string> read_png_text(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  return with_reader(bytes, path.string(), [](Reader& reader) {
    png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
    std::vector<png_byte> pixels(png_get_rowbytes(reader.png, reader.info));
    const bool interlaced = png_get_interlace_type(reader.png, reader.info) != PNG_INTERLACE_NONE;
    const auto height = png_get_image_height(reader.png, reader.info);
    for (int pass = 0; pass < (interlaced ? 7 : 1); ++pass)
      for (png_uint_32 y = 0; y < height; ++y) png_read_row(reader.png, pixels.data(), nullptr);
    png_read_end(reader.png, reader.info);
    std::map<std::string, std::string> found;
    png_textp texts = nullptr;
    int count = 0;
    png_get_text(reader.png, reader.info, &texts, &count);
    for (int i = 0; i < count; ++i) found.emplace(texts[i].key, texts[i].text ? texts[i].text : "");
    return found;
  });
}

}  // namespace chute::image
