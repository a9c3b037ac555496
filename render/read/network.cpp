#include "read/network.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/fields.hpp"
#include "common/toml_reader.hpp"
#include "read/byte_stream.hpp"
#include "read/number.hpp"
#include "read/table.hpp"
#include "read/text_rows.hpp"
#include "read/vtk_points.hpp"

namespace chute::read {
namespace {

using Eigen::Vector3d;
using Columns = std::vector<PointArray>;

/// Names that programs give the strength of a contact, ours first; a vector counts with its length.
constexpr std::string_view usual_forces[] = {"normal_force", "force",  "Force",        "normalForce",
                                             "forceNormal",  "forceN", "force_normal", "normal force",
                                             "fn",           "Fn",     "F_n",          "f_n"};
constexpr std::array<std::string_view, 3> force_components{"fx", "fy", "fz"};

/// Columns that hold the ends of a contact, or name its grains.
constexpr std::array<std::string_view, 6> usual_places{"x1", "y1", "z1", "x2", "y2", "z2"};
constexpr std::array<std::string_view, 2> usual_pairs[] = {
    {"a", "b"}, {"id1", "id2"}, {"i", "j"}, {"patom1", "patom2"}};

const PointArray* find_in(const Columns& columns, std::string_view name) {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

/// The columns of contacts, whatever file they are of: rows, and what is said of them.
class Contacts {
 public:
  Contacts(std::filesystem::path path, Columns columns, std::size_t rows, const Meanings& meanings)
      : path_(std::move(path)), columns_(std::move(columns)), rows_(rows), meanings_(&meanings) {}

  std::size_t size() const { return rows_; }

  /// The strengths of all contacts.
  std::vector<double> forces() const {
    std::vector<const PointArray*> parts;
    if (!meanings_->force.empty()) {
      for (const auto& name : meanings_->force) parts.push_back(&named(name, "--force"));
    } else if (const auto* usual = usual_force()) {
      parts = {usual};
    } else {
      for (const auto name : force_components)
        if (const auto* part = find_in(columns_, name)) parts.push_back(part);
    }
    if (parts.empty())
      fail(
          fmt::format("no array \"normal_force\" or \"force\", the strength of each contact; --force names "
                      "one{}",
                      there()));
    std::vector<double> result(rows_, 0.0);
    for (std::size_t i = 0; i < rows_; ++i) {
      for (const auto* part : parts)
        for (int c = 0; c < part->components; ++c) result[i] += part->at(i, c) * part->at(i, c);
      result[i] = std::sqrt(result[i]);
    }
    return result;
  }

  /// The ends of all contacts from their rows; of a contact with a grain that is not there, not numbers.
  std::vector<std::pair<Vector3d, Vector3d>> ends(const GrainFrame* grains) const {
    if (const auto places = place_columns(); !places.empty()) return ends_at(places);
    const auto pair = pair_columns();
    if (!pair[0])
      fail(
          fmt::format("no lines, and no columns that tell the ends of contacts (x1 y1 z1 x2 y2 z2) or their "
                      "grains (a b, id1 id2); --ends names them{}",
                      there()));
    if (!grains) fail("contacts name grains by their ids, but no grains are given");
    return ends_of(*pair[0], *pair[1], *grains);
  }

  /// An option that names a column which is not there is a slip, also of a frame without contacts, whose columns are there.
  void check_names() const {
    if (columns_.empty()) return;
    for (const auto& name : meanings_->force) named(name, "--force");
    for (const auto& name : meanings_->ends) named(name, "--ends");
  }

  /// Leaves those columns that the other has, too.
  void keep_columns_of(const Contacts& other) {
    std::erase_if(columns_, [&](const PointArray& column) { return !find_in(other.columns_, column.name); });
  }

  [[noreturn]] void fail(const std::string& what) const { throw InputError(path_.string() + ": " + what); }

 private:
  std::filesystem::path path_;
  Columns columns_;
  std::size_t rows_;
  const Meanings* meanings_;

  std::string there() const {
    std::vector<std::string> names;
    for (const auto& column : columns_) names.push_back(column.name);
    return names.empty() ? "" : fmt::format("; there are: {}", fmt::join(names, ", "));
  }
  const PointArray& named(const std::string& name, const char* option) const {
    if (const auto* found = find_in(columns_, name)) return *found;
    fail(fmt::format("{}: no array \"{}\"{}", option, name, there()));
  }
  const PointArray* usual_force() const {
    for (const auto name : usual_forces)
      if (const auto* found = find_in(columns_, name)) return found;
    return nullptr;
  }
  std::vector<const PointArray*> place_columns() const {
    std::vector<const PointArray*> found;
    if (meanings_->ends.size() > 2) {
      for (const auto& name : meanings_->ends) found.push_back(&named(name, "--ends"));
      return found;
    }
    if (!meanings_->ends.empty()) return {};
    for (const auto name : usual_places)
      if (const auto* column = find_in(columns_, name)) found.push_back(column);
    // all six, or in the plane the four without z
    return found.size() == 6 || (found.size() == 4 && !find_in(columns_, "z1") && !find_in(columns_, "z2"))
               ? found
               : std::vector<const PointArray*>{};
  }
  std::array<const PointArray*, 2> pair_columns() const {
    if (meanings_->ends.size() == 2)
      return {&named(meanings_->ends[0], "--ends"), &named(meanings_->ends[1], "--ends")};
    for (const auto& names : usual_pairs) {
      const auto *a = find_in(columns_, names[0]), *b = find_in(columns_, names[1]);
      if (a && b) return {a, b};
    }
    return {};
  }

  std::vector<std::pair<Vector3d, Vector3d>> ends_at(const std::vector<const PointArray*>& places) const {
    const std::size_t dimensions = places.size() / 2;
    std::vector<std::pair<Vector3d, Vector3d>> found(rows_, {Vector3d::Zero(), Vector3d::Zero()});
    for (std::size_t i = 0; i < rows_; ++i)
      for (std::size_t c = 0; c < dimensions; ++c) {
        found[i].first[static_cast<Eigen::Index>(c)] = places[c]->at(i);
        found[i].second[static_cast<Eigen::Index>(c)] = places[dimensions + c]->at(i);
      }
    return found;
  }

  std::vector<std::pair<Vector3d, Vector3d>> ends_of(const PointArray& a, const PointArray& b,
                                                     const GrainFrame& grains) const {
    std::unordered_map<long long, std::size_t> of_id;
    const auto* ids = grains.find(fields::id.name);
    for (std::size_t i = 0; i < grains.size(); ++i)
      of_id.emplace(ids ? std::llround(ids->at(i)) : static_cast<long long>(i), i);
    const auto place = [&](double id) -> Vector3d {
      const auto found = std::isfinite(id) ? of_id.find(std::llround(id)) : of_id.end();
      return found == of_id.end() ? Vector3d::Constant(NAN).eval() : grains.centre(found->second);
    };
    std::vector<std::pair<Vector3d, Vector3d>> found;
    for (std::size_t i = 0; i < rows_; ++i) found.emplace_back(place(a.at(i)), place(b.at(i)));
    return found;
  }
};

/// A line between two grains' centres, VTK's usual contact, and the row that tells of it.
struct Line {
  Vector3d from, to;
  std::size_t row;
};

/// A network, or what one file has of it.
struct Part {
  Contacts contacts;
  enum class Kind { table, points, lines } kind = Kind::table;
  std::vector<Line> lines = {};
};

std::vector<ForceLink> links_of_lines(const Part& part, const Meanings& meanings) {
  const auto& contacts = part.contacts;
  std::vector<ForceLink> links;
  if (!meanings.ends.empty())
    contacts.fail("--ends is of contacts that are rows of a table; these are lines, which have their ends");
  contacts.check_names();
  if (part.lines.empty()) return links;
  const auto forces = contacts.forces();
  for (const auto& line : part.lines) {
    const ForceLink link{line.from, line.to, forces[line.row]};
    if (!link.from.allFinite() || !link.to.allFinite() || !std::isfinite(link.force))
      contacts.fail(fmt::format("contact {}: a value is not a finite number", links.size()));
    links.push_back(link);
  }
  return links;
}

std::vector<ForceLink> links_of(const Part& part, const Meanings& meanings, const GrainFrame* grains) {
  if (part.kind == Part::Kind::lines) return links_of_lines(part, meanings);
  const auto& contacts = part.contacts;
  std::vector<ForceLink> links;
  contacts.check_names();
  if (contacts.size() == 0) return links;
  const auto forces = contacts.forces();
  const auto ends = contacts.ends(grains);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (!std::isfinite(forces[i]))
      contacts.fail(fmt::format("contact {}: a value is not a finite number", i));
    if (ends[i].first.allFinite() && ends[i].second.allFinite())
      links.push_back({ends[i].first, ends[i].second, forces[i]});
  }
  return links;
}

/// A dump of entries: `ITEM: ENTRIES` with the names of its columns, or the numbers of those that it does not name.
Contacts entries_of(const FileBytes& piece, const Meanings& meanings) {
  TextLines lines(piece);
  std::optional<std::uint64_t> count;
  std::string_view line;
  while (lines.next(line)) {
    if (!line.starts_with("ITEM:")) continue;
    auto words = trimmed(line.substr(5));
    if (words == "NUMBER OF ENTRIES")
      count = count_in(lines, lines.needed("the number of entries"), "the number of entries");
    if (take_word(words) != "ENTRIES") continue;
    if (!count) lines.fail("entries without their number");
    std::vector<RowColumn> columns;
    for (auto name = take_word(words); !name.empty(); name = take_word(words))
      columns.push_back({std::string(name), true, RowColumn::Kind::numbers});
    return {piece.path, read_rows(lines, *count, columns), static_cast<std::size_t>(*count), meanings};
  }
  lines.fail("no ITEM: ENTRIES; contacts come from a dump local");
}

Contacts table_of(const FileBytes& file, const Meanings& meanings) {
  const auto table = parse_table(file.bytes, file.path);
  Columns columns;
  for (const auto& name : table.header)
    if (table.is_number(name)) columns.push_back({name, 1, table.column(name)});
  return {file.path, std::move(columns), table.rows.size(), meanings};
}

/// The lines of a VTK file, or its points as rows where it has none. A line that a part only repeats for its neighbours' sake, or
/// hides, is left out.
Part part_of_vtk(FileBytes file, const Meanings& meanings) {
  const auto path = file.path;
  PointSet points = parse_vtk(std::move(file.bytes), path);
  const auto place = [&](std::size_t i) -> Vector3d { return {points.x[i], points.y[i], points.z[i]}; };
  constexpr std::string_view ghosts = "vtkGhostType";  // of VTK's cells, bits
  constexpr int repeated_or_hidden = 1 | 32;
  const auto* flags = find_in(points.cell_arrays, ghosts);
  if (flags && (flags->components != 1 || flags->values.size() != points.cells_in_all)) flags = nullptr;
  bool has_lines = points.x.empty();
  std::vector<Line> lines;
  for (const auto& cell : points.cells) {
    if (cell.corners.size() != 2) continue;
    has_lines = true;
    if (flags && (static_cast<int>(flags->at(cell.number)) & repeated_or_hidden) != 0) continue;
    lines.push_back({place(cell.corners[0]), place(cell.corners[1]), cell.number});
  }
  if (has_lines)
    return {{path, std::move(points.cell_arrays), points.cells_in_all, meanings},
            Part::Kind::lines,
            std::move(lines)};
  const std::size_t rows = points.x.size();
  return {{path, std::move(points.point_arrays), rows, meanings}, Part::Kind::points};
}

Part part_of(FileBytes file, const Meanings& meanings) {
  if (file.path.extension() == ".csv") return {table_of(file, meanings)};
  if (file.bytes.starts_with("ITEM:")) return {entries_of(file, meanings)};
  return part_of_vtk(std::move(file), meanings);
}

/// Leaves the parts that tell of contacts, with those columns that all of them have: strengths are of one kind then. Points beside
/// lines are grains without contacts, not rows. Where no part has any contact, the first stands for all.
void make_alike(std::vector<Part>& parts) {
  if (parts.size() < 2) return;
  const bool have_lines =
      std::any_of(parts.begin(), parts.end(), [](const Part& part) { return !part.lines.empty(); });
  const auto is_empty = [&](const Part& part) {
    return part.kind == Part::Kind::lines    ? part.lines.empty()
           : part.kind == Part::Kind::points ? have_lines
                                             : part.contacts.size() == 0;
  };
  if (std::all_of(parts.begin(), parts.end(), is_empty))
    return void(parts.erase(parts.begin() + 1, parts.end()));
  std::erase_if(parts, is_empty);
  for (const auto& part : parts) parts.front().contacts.keep_columns_of(part.contacts);
  for (auto& part : parts) part.contacts.keep_columns_of(parts.front().contacts);
}

}  // namespace

std::vector<ForceLink> parse_network(std::vector<FileBytes> files, const Meanings& meanings,
                                     const GrainFrame* grains) {
  std::vector<Part> parts;
  for (auto& file : files) parts.push_back(part_of(std::move(file), meanings));
  make_alike(parts);
  std::vector<ForceLink> links;
  for (const auto& part : parts) {
    const auto some = links_of(part, meanings, grains);
    links.insert(links.end(), some.begin(), some.end());
  }
  return links;
}

std::vector<ForceLink> read_network(const std::filesystem::path& path) {
  return parse_network({FileBytes{path, read_file(path)}});
}

std::vector<FileBytes> network_bytes(const FrameFile& frame) {
  FrameFile network{frame.contacts, frame.more_contacts};
  network.piece = frame.contacts_piece, network.more_pieces = frame.more_contacts_pieces;
  return read_files(network);
}

}  // namespace chute::read
