#pragma once
#include <filesystem>

#include "image/image.hpp"

namespace chute::app {

/// Is it a picture that can be compared: PNG, or PDF and SVG, which are drawn first?
bool is_picture(const std::filesystem::path& file);

/// The picture in a file, on white where it is a drawing: PDF by pdftoppm (first page), SVG by rsvg-convert, both at 150 pixels an inch.
/// InputError if it cannot be read; WorkError that names the Debian package if the program that draws it is not there.
image::Image read_picture(const std::filesystem::path& file);

}  // namespace chute::app
