#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "read/point_set.hpp"
#include "read/run_frames.hpp"

/// Dumps that LAMMPS's processes wrote side by side, each a file with the grains that it had: `dump.%` makes dump.0, dump.1 …
namespace chute::read {

/// Does this name files of parts: a `%` in its last part, where no file has that name itself?
bool names_parts(const std::filesystem::path& source);

/// The frames of `source`, such as `post/dump.%` or `post/dump.*.%`, in the order of their times; the parts of one time are one
/// frame. Frames at the end that some parts do not have yet are left out. InputError if a part is missing, or if one lacks a
/// time in between.
std::vector<FrameFile> frames_of_parts(const std::filesystem::path& source);

/// The name with `%` that some of these files' names make, if they look like parts: numbered from 0 without a gap, with the same
/// times. With a `*` where there are such for several times.
std::optional<std::string> parts_pattern(const std::vector<FrameFile>& frames);

/// The grains of all parts as one set. InputError if the parts have other columns, times or boxes, or one grain twice.
PointSet join_parts(std::vector<PointSet> sets, const std::vector<FileBytes>& files);

}  // namespace chute::read
