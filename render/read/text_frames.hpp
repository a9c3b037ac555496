#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "read/point_set.hpp"

/// Frames as text: dumps of LAMMPS and LIGGGHTS, and XYZ files. A file holds one frame or many.
namespace chute::read {

/// Where a frame stands in what its file holds.
struct TextPiece {
  std::uint64_t from = 0, size = 0;
  std::uint64_t first_line = 1;
  std::optional<double> time;  ///< a time that the file tells; of dumps without, the time step
  std::string units;           ///< of dumps, named at the file's begin only
  std::string cut_after;  ///< `FILE:LINE: …`: another frame begins behind this one, but the file ends in it
};

/// What the begin of a text says of its format; nothing if it is neither of the two.
std::optional<PointSet::Format> text_format(std::string_view begin);
/// The same of a file, packed or not; nothing if there is no such file.
std::optional<PointSet::Format> text_format_of(const std::filesystem::path& path);

/// The frames of a file, in its order, from one pass over it in which numbers of grains are read and nothing else. InputError `FILE:LINE: …` for a
/// frame that has a head of another kind, or is cut short, if it is the only one; a last one that is cut short is left out.
std::vector<TextPiece> find_pieces(const std::filesystem::path& path);

/// One frame. Places are those in the box: scaled ones are stretched, unwrapped ones brought back by their images, or by whole
/// periods. Properties of several columns are one array, and so is LAMMPS's quaternion (`orientation`). `wanted` says which columns are kept. InputError `FILE:LINE: …`.
PointSet parse_dump(const FileBytes& piece, const std::function<bool(std::string_view)>& wanted);
PointSet parse_xyz(const FileBytes& piece, const std::function<bool(std::string_view)>& wanted);

}  // namespace chute::read
