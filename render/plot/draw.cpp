#include "plot/draw.hpp"

#include <cairo-pdf.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "image/png.hpp"
#include "plot/cairo_canvas.hpp"
#include "plot/svg.hpp"

namespace chute::plot {
namespace {

cairo_status_t collect(void* bytes, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

/// The bytes of a PDF; `prepare` sets its metadata.
std::string pdf_file(const DisplayList& list, const std::function<void(cairo_surface_t*)>& prepare) {
  std::string bytes;
  cairo_surface_t* surface = cairo_pdf_surface_create_for_stream(collect, &bytes, list.width, list.height);
  cairo_surface_set_fallback_resolution(surface, 600, 600);
  prepare(surface);
  cairo_t* cairo = cairo_create(surface);
  draw_on_cairo(cairo, list, 1, Target::file);
  cairo_show_page(cairo);
  cairo_destroy(cairo);
  cairo_surface_finish(surface);
  const auto status = cairo_surface_status(surface);
  cairo_surface_destroy(surface);
  check_cairo(status, "writing");
  return bytes;
}

/// The time of writing would make every PDF a different file. Blanks keep the offsets in the file's table
/// right.
void remove_creation_date(std::string& pdf) {
  const std::string key = "/CreationDate";
  const auto begin = pdf.rfind(key);
  if (begin == std::string::npos) return;
  const auto end = pdf.find(')', begin);
  if (end != std::string::npos && end - begin < 60) pdf.replace(begin, end + 1 - begin, end + 1 - begin, ' ');
}

}  // namespace

image::Image rasterise_by_cairo(const DisplayList& list, double dpi) {
  const int width = static_cast<int>(std::lround(list.width * dpi / 72));
  const int height = static_cast<int>(std::lround(list.height * dpi / 72));
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height);
  cairo_t* cairo = cairo_create(surface);
  draw_on_cairo(cairo, list, dpi / 72, Target::pixels);
  cairo_destroy(cairo);
  cairo_surface_flush(surface);
  check_cairo(cairo_surface_status(surface), "drawing");
  image::Image picture(width, height);
  const unsigned char* data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::uint32_t value = 0;
      std::memcpy(&value, data + static_cast<std::ptrdiff_t>(y) * stride + 4 * x, 4);
      const unsigned alpha = value >> 24;
      auto* p = picture.pixel(x, y);
      for (int c = 0; c < 3; ++c) {
        const unsigned channel = (value >> (16 - 8 * c)) & 255;
        p[c] = alpha ? static_cast<std::uint8_t>(std::min(255u, (channel * 255 + alpha / 2) / alpha)) : 0;
      }
      p[3] = static_cast<std::uint8_t>(alpha);
    }
  cairo_surface_destroy(surface);
  return picture;
}

namespace {

/// PNG's and PDF's words for the same thing; both are understood for both.
std::string png_keyword(const std::string& key) {
  return key == "Creator" ? "Software" : key == "Subject" ? "Description" : key;
}

}  // namespace

void draw_png(const DisplayList& list, const std::filesystem::path& path, double dpi,
              const Metadata& metadata) {
  image::Text text;
  for (const auto& [key, value] : metadata) text.emplace_back(png_keyword(key), value);
  image::write_png(path, rasterise(list, dpi), text, 6, dpi);
}

void draw_pdf(const DisplayList& list, const std::filesystem::path& path, const Metadata& metadata) {
  auto bytes = pdf_file(list, [&](cairo_surface_t* surface) {
    std::string others;
    for (const auto& [word, value] : metadata) {
      const auto key = png_keyword(word);
      const auto set = [&, &text = value](cairo_pdf_metadata_t which) {
        cairo_pdf_surface_set_metadata(surface, which, text.c_str());
      };
      if (key == "Title")
        set(CAIRO_PDF_METADATA_TITLE);
      else if (key == "Author")
        set(CAIRO_PDF_METADATA_AUTHOR);
      else if (key == "Description")
        set(CAIRO_PDF_METADATA_SUBJECT);
      else if (key == "Software")
        set(CAIRO_PDF_METADATA_CREATOR);
      else
        others += (others.empty() ? "" : "; ") + key + ": " + value;
    }
    if (!others.empty()) cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_KEYWORDS, others.c_str());
  });
  remove_creation_date(bytes);
  write_atomically(path, bytes);
}

void draw_svg(const DisplayList& list, const std::filesystem::path& path, const Metadata& metadata) {
  write_atomically(path, svg_text(list, metadata));
}

}  // namespace chute::plot
