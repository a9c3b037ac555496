#include "app/description.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/fields.hpp"
#include "read/byte_stream.hpp"
#include "read/image_data.hpp"
#include "read/points_file.hpp"
#include "read/run_frames.hpp"
#include "read/table.hpp"
#include "read/text_frames.hpp"
#include "read/xml_check.hpp"
#include "run/flow.hpp"
#include "sweep/sweep.hpp"

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

/// What a grid of cells holds, under the same keys; its points are those of the grid.
void add_grid(Json& into, const read::ImageData& grid) {
  read::PointSet whole;
  for (const auto& [name, text] : {std::pair{fields::units, grid.units}, {fields::clock, grid.clock}})
    if (!text.empty()) whole.field_texts.emplace_back(name, text);
  if (grid.time) whole.field_arrays.push_back({std::string(fields::time_value), 1, {*grid.time}});
  whole.point_arrays = grid.point_arrays, whole.cell_arrays = grid.cell_arrays;
  add_points(into, whole);
  std::size_t points = 1, cells = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto count = static_cast<std::size_t>(grid.points[k]);
    points *= count, cells *= std::max<std::size_t>(1, count - 1);
    const double last = grid.origin[k] + static_cast<double>(count - 1) * grid.spacing[k];
    into[std::string(1, "xyz"[k])] = range_of({grid.origin[k], last});
  }
  into["points"] = points, into["cells"] = cells, into["grid"] = grid.points;
}

/// What files that make one set of points, or a grid, hold; when that is, if they say.
std::optional<double> add_files(Json& into, std::vector<read::FileBytes> files) {
  if (files.size() == 1 && read::is_image_data(files[0].bytes)) {
    const auto grid = read::parse_image_data(std::move(files[0].bytes), files[0].path);
    add_grid(into, grid);
    return grid.time;
  }
  const auto points = read::parse_points(std::move(files));
  add_points(into, points);
  for (const auto& array : points.field_arrays)
    if (array.name == fields::time_value && !array.values.empty()) return array.values[0];
  return {};
}

Json of_vtk(const fs::path& path) {
  Json found{{"kind", "vtk"}, {"file", path.string()}};
  add_files(found, read::read_parts(path));
  return found;
}

/// Frames in several files: an index of times, a folder, a pattern. As of a dump.
Json of_frames(const fs::path& source) {
  const auto frames = read::find_frames(source);
  std::set<fs::path> files;
  std::vector<double> times;
  for (const auto& frame : frames) {
    files.insert(frame.path), files.insert(frame.more.begin(), frame.more.end());
    if (frame.time) times.push_back(*frame.time);
  }
  Json first;
  const auto begin = add_files(first, read::read_files(frames.front()));
  if (times.empty() && begin) {  // they stand in the order of their names, with their times inside
    Json last;
    times.push_back(*begin);
    if (const auto end = add_files(last, read::read_files(frames.back()))) times.push_back(*end);
  }
  const auto& piece = frames.back().piece;
  Json found{{"kind", "frames"},
             {"file", source.string()},
             {"files", files.size()},
             {"frames", frames.size()},
             {"time", range_of(times)},
             {"cut_after", piece && !piece->cut_after.empty() ? Json(piece->cut_after) : Json()}};
  found.update(first);
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

Json of_sweep(const fs::path& path) {
  const auto state = sweep::sweep_state(path);
  Json axes = Json::array();
  for (const auto& axis : state.spec.axes)
    axes.push_back({{"key", axis.key}, {"values", axis.points()}, {"unit", axis.unit}});
  Json starts = Json::object();
  for (std::size_t v = 0; v < state.starts.size(); ++v)
    starts[std::string(measure::name(static_cast<measure::Verdict>(v)))] = state.starts[v];
  Json found{{"kind", "sweep"},     {"directory", path.string()}, {"title", state.title},
             {"axes", axes},        {"seeds", state.spec.seeds},  {"table", state.table},
             {"files", state.files}};
  if (state.spec.boundary)
    found["boundary"] = state.spec.boundary->axis.key;
  else
    found["points"] = state.points, found["found"] = state.found, found["starts"] = starts;
  return found;
}

/// By its content, packed or not.
bool is_vtk(const fs::path& file) {
  read::ByteStream stream(file);
  const auto begin = stream.next();
  return begin.starts_with("# vtk DataFile") || read::xml_head(begin).is_vtk;
}

/// By its name: then what is wrong with it is told as of such a file.
bool is_called_vtk(const fs::path& file) {
  const auto extension = file.extension().string();
  return extension.starts_with(".vt") || extension.starts_with(".pvt");
}

/// A folder of files that chute render takes one by one.
bool holds_frames(const fs::path& folder) {
  const auto entries = fs::directory_iterator(folder);
  return std::any_of(fs::begin(entries), fs::end(entries), [](const fs::directory_entry& entry) {
    return entry.is_regular_file() && (entry.path().extension() == ".pvd" || is_vtk(entry.path()) ||
                                       read::text_format_of(entry.path()).has_value());
  });
}

}  // namespace

Json describe_file(const fs::path& path) {
  if (!fs::exists(path)) {
    if (path.filename().string().find_first_of("%*?[") != std::string::npos) return of_frames(path);
    throw InputError(path.string() + ": no such file or run");
  }
  if (fs::is_directory(path)) {
    if (fs::exists(path / "sweep.toml")) return of_sweep(path);
    return fs::exists(path / "run.json") || !holds_frames(path) ? of_run(path) : of_frames(path);
  }
  const auto extension = path.extension();
  if (extension == ".csv") return of_table(path);
  if (extension == ".pvd" || extension == ".series") return of_frames(path);
  if (const auto format = read::text_format_of(path)) return of_text_frames(path, *format);
  if (is_called_vtk(path) || is_vtk(path)) return of_vtk(path);
  if (extension == ".tsv" || extension == ".txt" || extension == ".dat") return of_table(path);
  throw InputError(
      path.string() +
      ": neither a run directory nor a table (.csv, .tsv, .txt, .dat), a VTK file, an index of times (.pvd, .vtk.series), a dump or an XYZ file");
}

}  // namespace chute::app
