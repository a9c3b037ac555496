#pragma once
#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "read/meanings.hpp"

namespace chute::write {

enum class Format { lammps_dump, xyz, csv, vtp };
inline constexpr std::array<std::string_view, 4> format_words{"lammps-dump", "xyz", "csv", "vtp"};

struct ConvertJob {
  std::vector<std::filesystem::path> sources;  ///< what read::find_frames takes, one after the other
  std::filesystem::path folder;
  Format format = Format::vtp;
  read::Meanings meanings;
  bool one_file = false;  ///< all frames in one file; not of VTK's
  bool from_one = false;  ///< FrameFacts::from_one
  /// Told after every frame; false stops.
  std::function<bool(std::size_t done, std::size_t all)> progress;
};

struct ConvertReport {
  std::size_t frames = 0, left_out = 0;
  bool tilted = false;  ///< a tilted box went into files that have no place for one
};

/// Reads frame after frame and writes each as soon as it is read: memory holds one. The folder must be new or empty, and is
/// made when the first frame has been read. InputError as read_frame; WorkError if a file cannot be written.
ConvertReport convert(const ConvertJob& job);

}  // namespace chute::write
