#include "app/description.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/fields.hpp"
#include "read/points_file.hpp"
#include "read/table.hpp"
#include "read/text_frames.hpp"
#include "run/flow.hpp"

namespace chute::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// What is known of the values, [lowest, highest]; null if nothing is.
Json range_of(const std::vector<double>& values) {
  double low = INFINITY, high = -INFINITY;
  for (double v : values)
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  return low > high ? Json() : Json::array({low, high});
}

/// The unit of an array that chute's own files have, in the units that the file names.
std::string unit_of(const std::string& name, const std::string& units) {
  const auto look = [&](const auto& known) -> std::string {
    for (const auto& field : known)
      if (field.name == name)
        return std::string(units == "SI"        ? field.si_unit
                           : units == "reduced" ? field.reduced
                                                : std::string_view());
    return "";
  };
  for (const auto& unit :
       {look(fields::grain_fields), look(fields::impact_fields), look(fields::contact_fields)})
    if (!unit.empty()) return unit;
  return "";
}

/// What a set of points holds; what comes before `points` is said by the caller.
void add_points(Json& into, const read::PointSet& points) {
  std::string units;
  Json texts = Json::object();
  for (const auto& [name, text] : points.field_texts) {
    texts[name] = text;
    if (name == fields::units) units = text;
  }
  Json arrays = Json::array();
  const auto add = [&](const char* where, const std::vector<read::PointArray>& found) {
    for (const auto& array : found) {
      Json entry{{"where", where},
                 {"name", array.name},
                 {"components", array.components},
                 {"range", range_of(array.values)},
                 {"unit", unit_of(array.name, units)}};
      if (!array.words.empty()) entry["range"] = Json(), entry["words"] = array.words;
      arrays.push_back(std::move(entry));
    }
  };
  add("point", points.point_arrays), add("cell", points.cell_arrays), add("field", points.field_arrays);
  into["points"] = points.x.size(), into["cells"] = points.cells.size();
  into["x"] = range_of(points.x), into["y"] = range_of(points.y), into["z"] = range_of(points.z);
  into["arrays"] = std::move(arrays), into["texts"] = std::move(texts);
  if (!points.lattice) return;
  const auto& box = *points.lattice;
  const auto list = [](const auto& values) {
    return Json(std::vector<double>(values.begin(), values.end()));
  };
  into["box"] = {
      {"origin", list(box.origin)},
      {"edges", Json::array({list(box.edges.col(0)), list(box.edges.col(1)), list(box.edges.col(2))})},
      {"periodic", box.periodic}};
}

Json of_vtk(const fs::path& path) {
  Json found{{"kind", "vtk"}, {"file", path.string()}};
  add_points(found, read::parse_points(read::read_parts(path)));
  return found;
}

/// A dump or an XYZ file: how many frames, their times, and what the first holds.
Json of_text_frames(const fs::path& path, read::PointSet::Format format) {
  const auto pieces = read::find_pieces(path);
  Json found{{"kind", format == read::PointSet::Format::dump ? "dump" : "xyz"},
             {"file", path.string()},
             {"frames", pieces.size()}};
  std::vector<double> times;
  for (const auto& piece : pieces)
    if (piece.time) times.push_back(*piece.time);
  found["time"] = range_of(times);
  found["cut_after"] = pieces.back().cut_after.empty() ? Json() : Json(pieces.back().cut_after);
  add_points(found, read::parse_points(read::read_parts(path)));
  return found;
}

Json of_table(const fs::path& path) {
  const auto table = read::read_table(path);
  Json columns = Json::array();
  for (const auto& name : table.header) {
    const auto column = table.summary(name);
    using Type = read::ColumnSummary::Type;
    Json entry{{"name", name},
               {"type", column.type == Type::number ? "number"
                        : column.type == Type::time ? "time"
                                                    : "text"},
               {"gaps", column.gaps},
               {"different", column.different}};
    if (column.type == Type::number)
      entry["range"] = std::isnan(column.low) ? Json() : Json::array({column.low, column.high});
    if (column.type == Type::time) entry["range"] = Json::array({column.low_text, column.high_text});
    columns.push_back(std::move(entry));
  }
  return {{"kind", "table"},
          {"file", path.string()},
          {"rows", table.rows.size()},
          {"comments", table.comments},
          {"columns", columns}};
}

Json of_run(const fs::path& path) {
  if (!fs::exists(path / "run.json")) throw InputError(path.string() + ": not a run directory (no run.json)");
  Json record;
  try {
    record = Json::parse(read_file(path / "run.json"));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(
        fmt::format("{}: not the record of a run: {}", (path / "run.json").string(), error.what()));
  }
  std::vector<Json> files;
  for (const auto& entry : fs::directory_iterator(path)) {
    const auto name = entry.path().filename().string();
    if (entry.is_directory())
      files.push_back(
          {{"name", name + "/"},
           {"files", std::distance(fs::directory_iterator(entry.path()), fs::directory_iterator{})}});
    else
      files.push_back({{"name", name}, {"bytes", entry.file_size()}});
  }
  std::sort(files.begin(), files.end(), [](const Json& a, const Json& b) { return a["name"] < b["name"]; });
  return {{"kind", "run"}, {"directory", path.string()}, {"record", record}, {"files", files}};
}

}  // namespace

Json describe_file(const fs::path& path) {
  if (!fs::exists(path)) throw InputError(path.string() + ": no such file or run");
  const auto extension = path.extension();
  if (fs::is_directory(path)) return of_run(path);
  if (extension == ".csv") return of_table(path);
  if (const auto format = read::text_format_of(path)) return of_text_frames(path, *format);
  constexpr std::array point_files{".vtp",  ".vtu",  ".vtk",  ".vts",  ".vtr",
                                   ".pvtp", ".pvtu", ".pvts", ".pvtr", ".vtm"};
  if (std::find(point_files.begin(), point_files.end(), extension) != point_files.end()) return of_vtk(path);
  throw InputError(fmt::format("{}: neither a run directory nor a {} or .csv file, a dump or an XYZ file",
                               path.string(), fmt::join(point_files, ", ")));
}

}  // namespace chute::app
