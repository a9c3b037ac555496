#include "read/points_file.hpp"

#include <fmt/format.h>

#include "common/error.hpp"
#include "read/byte_stream.hpp"
#include "read/dump_parts.hpp"
#include "read/text_frames.hpp"
#include "read/vtk_points.hpp"
#include "read/vtk_process.hpp"
#include "read/xml_check.hpp"

namespace chute::read {

std::vector<FileBytes> read_parts(const std::filesystem::path& path) {
  std::vector<FileBytes> files;
  if (text_format_of(path)) {
    const auto first = find_pieces(path).front();
    files.push_back({path, read_piece(path, first.from, first.size), first.first_line, first.units});
    return files;
  }
  std::string bytes = read_unpacked(path);
  const auto sources = part_sources(bytes);
  if (!sources) {
    files.push_back({path, std::move(bytes)});
    return files;
  }
  if (sources->empty()) throw InputError(path.string() + ": an index of parts that names none");
  for (const auto& source : *sources) {
    const auto part = path.parent_path() / source;
    files.push_back({part, read_unpacked(part)});
    if (!part_sources(files.back().bytes)) continue;
    if (has_vtk_process()) return {{path, std::move(bytes)}};  // VTK follows blocks in blocks
    throw InputError(fmt::format("{}: its part {} is an index itself", path.string(), source));
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
