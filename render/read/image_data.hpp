#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "read/grain_frame.hpp"

namespace chute::read {

/// VTK image data: fields on a grid of equal cells, or of points.
struct ImageData {
  std::optional<double> time;  ///< field data `TimeValue`, if the file says
  std::string units;           ///< "SI", "reduced", or empty if the file does not say
  std::string clock;           ///< what the time counts, "updates"; empty: it is a time
  std::array<double, 3> origin{}, spacing{1, 1, 1};
  std::array<int, 3> points{1, 1, 1};  ///< of the grid; cells are one less along each axis, but at least one
  std::vector<PointArray> cell_arrays, point_arrays;
};

/// Fields of one kind as values at evenly spaced places: cells' middles, or the points.
struct GridField {
  std::array<double, 3> first{}, step{1, 1, 1};  ///< place of the first value, and from each to the next
  std::array<int, 3> count{1, 1, 1};
  std::string units, clock;
  std::optional<double> time;
  std::vector<double> values;  ///< x fastest
};

/// Whether these bytes are image data: a grid (.vti), or an index of its pieces (.pvti).
bool is_image_data(std::string_view bytes);

/// Reads a .vti file, or the pieces that a .pvti file names as one grid. InputError, one line that names the file, if it is missing,
/// cut short or something else; also if no piece has a part of the grid.
ImageData read_image_data(const std::filesystem::path& path);
ImageData parse_image_data(std::string bytes, const std::filesystem::path& path);

/// What image_by_vtk does, in this process. Throws std::runtime_error with what VTK complains of, without the file's name.
ImageData read_image_pieces(const std::filesystem::path& path);

/// The field of that name; `NAME:x`, `:y`, `:z` is a component, of several components the magnitude else. InputError with the
/// nearest name if there is none.
GridField field_of(const ImageData& data, const std::string& name, const std::filesystem::path& path);

}  // namespace chute::read
