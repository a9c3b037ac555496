#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace chute::lammps {

/// A frame of a dump of LAMMPS's, custom or local, as it writes it for a deck: numbers only.
struct DumpFrame {
  std::int64_t step = 0;
  std::vector<std::string> names;  ///< of the columns
  std::vector<double> values;      ///< row after row

  std::size_t rows() const { return names.empty() ? 0 : values.size() / names.size(); }
  double at(std::size_t row, std::size_t column) const { return values[row * names.size() + column]; }
};

/// Reads a file of one frame. InputError that names it if it is not one, or cut short.
DumpFrame read_dump_frame(const std::filesystem::path& file);

/// The steps of files STEM.STEP in a folder, in order.
std::vector<std::int64_t> steps_in(const std::filesystem::path& folder, const std::string& stem);

}  // namespace chute::lammps
