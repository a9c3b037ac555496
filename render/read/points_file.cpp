#include "read/points_file.hpp"

#include <fmt/format.h>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/hash.hpp"
#include "read/byte_stream.hpp"
#include "read/dump_parts.hpp"
#include "read/text_frames.hpp"
#include "read/vtk_points.hpp"
#include "read/xml_check.hpp"

namespace chute::read {

namespace {

constexpr int most_indexes = 64;  // indexes in indexes, which may name each other in a circle

/// What stands for the bytes of all files that this one names, and those that they name.
void add_named(Hash& hash, const std::filesystem::path& file, std::string_view bytes, int depth) {
  if (depth == most_indexes) return;
  for (const auto& name : named_files(bytes)) {
    const auto path = file.parent_path() / name;
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) continue;  // VTK says so
    const auto part = read_file(path);
    hash.add(fmt::format("{} ", part.size()));
    hash.add(part);
    add_named(hash, path, part, depth + 1);
  }
}

/// A file of VTK's, whose own reader follows it where it is an index.
FileBytes for_vtk(const std::filesystem::path& path, std::string bytes) {
  FileBytes file{path, std::move(bytes)};
  if (named_files(file.bytes).empty()) return file;
  Hash hash;
  add_named(hash, path, file.bytes, 0);
  file.named = hash.hex();
  return file;
}

/// The files that an index leads to, through further indexes.
void gather(std::vector<FileBytes>& files, const std::filesystem::path& path, int depth) {
  if (depth == most_indexes)
    throw InputError(
        fmt::format("{}: indexes lead to indexes, more than {} deep", path.string(), most_indexes));
  auto bytes = read_unpacked(path);
  const auto sources = part_sources(bytes);
  if (!sources) {
    files.push_back(for_vtk(path, std::move(bytes)));
    return;
  }
  if (sources->empty()) throw InputError(path.string() + ": an index of parts that names none");
  for (const auto& source : *sources) gather(files, path.parent_path() / source, depth + 1);
}

}  // namespace

std::vector<FileBytes> read_parts(const std::filesystem::path& path) {
  std::vector<FileBytes> files;
  if (text_format_of(path)) {
    const auto first = find_pieces(path).front();
    files.push_back({path, read_piece(path, first.from, first.size), first.first_line, first.units});
  } else {
    gather(files, path, 0);
  }
  return files;
}

PointSet parse_points(std::vector<FileBytes> parts, const std::function<bool(std::string_view)>& wanted) {
  if (parts.size() == 1)
    if (const auto format = text_format(parts[0].bytes))
      return *format == PointSet::Format::dump ? parse_dump(parts[0], wanted) : parse_xyz(parts[0], wanted);
  if (parts.size() > 1 && text_format(parts[0].bytes) == PointSet::Format::dump) {
    std::vector<PointSet> sets;
    for (const auto& part : parts) sets.push_back(parse_dump(part, wanted));
    return join_parts(std::move(sets), parts);
  }
  return parse_vtk(std::move(parts), wanted);
}

}  // namespace chute::read
