#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "image/image.hpp"
#include "plot/display_list.hpp"

/// Back ends: the same list as pixels, PDF or SVG.
namespace chute::plot {

/// What the file says about itself: Title, Author, Description (or Subject), Software (or Creator: what made
/// it), Source, and any other word. PDF has no place for the others: they become its keywords.
using Metadata = std::vector<std::pair<std::string, std::string>>;

inline constexpr double default_dpi = 300;

/// Pixels through Mesa's software OpenGL: the same on every run. `width` points become `width * dpi / 72`
/// pixels, rounded.
image::Image rasterise(const DisplayList& list, double dpi = default_dpi);

/// The same through Cairo: the other opinion that tests ask for.
image::Image rasterise_by_cairo(const DisplayList& list, double dpi = default_dpi);

/// All are atomic and give the same bytes for the same list and metadata; WorkError if the file cannot be
/// written.
void draw_png(const DisplayList& list, const std::filesystem::path& path, double dpi = default_dpi,
              const Metadata& metadata = {});
/// Exact page size; fonts embedded and subset; text can be selected and searched.
void draw_pdf(const DisplayList& list, const std::filesystem::path& path, const Metadata& metadata = {});
/// Text is text too, set in the file's own subset of STIXGeneral; editors want the font installed.
void draw_svg(const DisplayList& list, const std::filesystem::path& path, const Metadata& metadata = {});

/// Names and versions of the libraries that pixels depend on, for whoever stores pictures.
std::string drawing_versions();

}  // namespace chute::plot
