#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "read/grain_frame.hpp"

namespace chute::write {

/// One array of a frame as it goes into a file: under chute's name where chute has one for it.
struct FrameField {
  enum class Kind { whole, number, vector, quaternion, words, other } kind = Kind::number;
  std::string name;
  const read::PointArray* array;

  int components() const { return array->components; }
};

/// All arrays of a frame besides places and radii: id, type, material, mass, velocity, angular_velocity, angle or
/// orientation, and force first, then the file's others in its order. Columns of which these were made, such as vx, vy and vz
/// of a dump, do not come again.
std::vector<FrameField> fields_of(const read::GrainFrame& frame);

/// The field of that name, or null.
const FrameField* find_field(const std::vector<FrameField>& fields, std::string_view name);

/// The text with `_` for white space and for the characters that mean something where it goes.
std::string without(std::string text, std::string_view meaningful = {});

/// The shortest text that reads back to the same number. A species is its word, without what would end a column.
std::string text_of(const FrameField& field, std::size_t grain, int component);

}  // namespace chute::write
