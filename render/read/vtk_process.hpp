#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "read/image_data.hpp"
#include "read/point_set.hpp"

/// VTK's own readers, in a process of their own: they trust counts in files, and a damaged one may end them. The process is started
/// when it is first needed, and reads one file after the other until it is ended by one, or its starter ends.
namespace chute::read {

/// For main() to call first. True if this process was started to read for another, which it has then done.
bool serve_vtk_files(int argc, char** argv);

/// Whether the program began with serve_vtk_files, so that it can be started so.
bool has_vtk_process();

/// The points, with their arrays, of any file that VTK 9.1 reads as data sets: structured and rectilinear grids, several blocks as
/// one set … Points that a part only repeats for its neighbours' sake are left out. InputError that names the file for what VTK
/// complains of, and for a file that takes too long, wants more memory than a file of its size should, or ends the reading process.
/// `named` are the files that it is an index of, relative to it: their sizes count, too.
PointSet read_by_vtk(const std::filesystem::path& path, const std::vector<std::string>& named = {});

/// The grid whose pieces a .pvti file names. InputError as above, also if they do not cover it.
ImageData image_by_vtk(const std::filesystem::path& path, const std::vector<std::string>& named);

}  // namespace chute::read
