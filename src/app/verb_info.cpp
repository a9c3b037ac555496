#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>

#include "app/verbs.hpp"
#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/fields.hpp"
#include "io/checkpoint_file.hpp"
#include "read/table.hpp"
#include "read/vtk_points.hpp"
#include "run/flow.hpp"
#include "run/record.hpp"

namespace chute::app {
namespace {

namespace fs = std::filesystem;

/// "min … max" of what is known.
std::string span_text(const std::vector<double>& values) {
  double low = INFINITY, high = -INFINITY;
  for (double v : values)
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  return low > high ? "nothing known" : fmt::format("{:.6g} … {:.6g}", low, high);
}

/// How much of a column of words there is.
std::string text_span(const std::vector<std::string>& values) {
  const std::set<std::string> different(values.begin(), values.end());
  return values.empty() ? "text" : fmt::format("text, {} different", different.size());
}

/// The unit of an array that chute's own files have, in the units that the file names.
std::string unit_of(const std::string& name, const std::string& units) {
  const auto look = [&](const auto& known) -> std::string {
    for (const auto& field : known)
      if (field.name == name) return std::string(units == "SI" ? field.si_unit : field.reduced);
    return "";
  };
  for (const auto& unit :
       {look(fields::grain_fields), look(fields::impact_fields), look(fields::contact_fields)})
    if (!unit.empty()) return unit;
  return "";
}

void show_arrays(const char* where, const std::vector<read::PointArray>& arrays, const std::string& units) {
  for (const auto& array : arrays)
    fmt::print("  {:<6} {:<18} {} component{}  {} {}\n", where, array.name, array.components,
               array.components == 1 ? " " : "s", span_text(array.values), unit_of(array.name, units));
}

void show_vtk(const fs::path& path) {
  const auto points = read::parse_vtk(read::read_parts(path));
  fmt::print("{}: {} points, {} lines and polygons\n", path.string(), points.x.size(), points.cells.size());
  fmt::print("  place  x {}   y {}   z {}\n", span_text(points.x), span_text(points.y), span_text(points.z));
  std::string units;
  for (const auto& [name, text] : points.field_texts)
    if (name == fields::units) units = text;
  show_arrays("point", points.point_arrays, units);
  show_arrays("cell", points.cell_arrays, units);
  show_arrays("field", points.field_arrays, units);
  for (const auto& [name, text] : points.field_texts) fmt::print("  field  {:<18} {}\n", name, text);
}

void show_table(const fs::path& path) {
  const auto table = read::read_table(path);
  for (const auto& comment : table.comments) fmt::print("# {}\n", comment);
  fmt::print("{}: {} rows\n", path.string(), table.rows.size());
  for (const auto& name : table.header) {
    fmt::print("  {:<18} {}\n", name,
               table.is_number(name) ? span_text(table.column(name)) : text_span(table.text(name)));
  }
}

void show_flow(const fs::path& path) {
  measure::Flow flow;
  try {
    flow = run::read_flow(path);
  } catch (const InputError&) {
    return;  // a run that has not written any series yet
  }
  const auto text = [](const Estimate& e) {
    return e.error ? fmt::format("{:.6g} ± {:.2g}", e.mean, *e.error) : fmt::format("{:.6g}", e.mean);
  };
  fmt::print("the flow is {}; from t = {:.6g} on: v_x = {}, omega = {}\n", measure::name(flow.verdict),
             flow.from, text(flow.v_x), text(flow.omega));
}

void show_run(const fs::path& path) {
  if (!fs::exists(path / "run.json")) throw InputError(path.string() + ": not a run directory (no run.json)");
  fmt::print("{}", run::read_record_text(path));
  show_flow(path);
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(path)) {
    const auto name = entry.path().filename().string();
    if (!entry.is_directory()) {
      files.push_back(fmt::format("  {:<20} {:>12} bytes", name, entry.file_size()));
      continue;
    }
    const auto inside = std::distance(fs::directory_iterator(entry.path()), fs::directory_iterator{});
    files.push_back(fmt::format("  {:<20} {:>12} files", name + "/", inside));
  }
  std::sort(files.begin(), files.end());
  for (const auto& file : files) fmt::print("{}\n", file);
}

/// Whether every file of a run holds what the run wrote into it.
void verify(const fs::path& path) {
  if (!fs::exists(path / "run.json")) throw InputError(path.string() + ": not a run directory (no run.json)");
  const auto sums = run::read_file_sums(path);
  auto wrong = io::differences(path, sums);
  std::size_t count = sums.size();
  if (const auto checkpoint = path / "checkpoint"; fs::exists(checkpoint)) {
    ++count;
    try {
      io::check_checkpoint(checkpoint);
    } catch (const InputError& error) {
      wrong.push_back(error.what());
    }
  }
  for (const auto& line : wrong) fmt::print("{}\n", line);
  if (!wrong.empty())
    throw WorkError(
        fmt::format("{}: {} of {} files are not as the run wrote them", path.string(), wrong.size(), count));
  fmt::print("{}: {} files are as the run wrote them\n", path.string(), count);
}

void info(const fs::path& path) {
  if (!fs::exists(path)) throw InputError(path.string() + ": no such file or run");
  const auto extension = path.extension();
  if (fs::is_directory(path)) return show_run(path);
  if (extension == ".csv") return show_table(path);
  constexpr std::array point_files{".vtp", ".vtu", ".vtk", ".pvtp", ".pvtu", ".vtm"};
  if (std::find(point_files.begin(), point_files.end(), extension) != point_files.end())
    return show_vtk(path);
  throw InputError(fmt::format("{}: neither a run directory nor a {} or .csv file", path.string(),
                               fmt::join(point_files, ", ")));
}

}  // namespace

void add_info(CLI::App& app) {
  auto* verb = app.add_subcommand("info", "Tell what a run, a VTK file or a table holds");
  struct Arguments {
    std::string path;
    bool verify = false;
  };
  auto a = std::make_shared<Arguments>();
  verb->add_option("path", a->path, "run directory, VTK file or CSV table")->required();
  verb->add_flag("--verify", a->verify, "compare every file of a run with the checksums in its run.json");
  verb->footer(
      "Exit status with --verify: 0 all files are whole, 1 some are not.\n"
      "Example: chute info out/demo/impacts.vtp\n"
      "         chute info --verify out/demo");
  verb->callback([a] { a->verify ? verify(a->path) : info(a->path); });
}

}  // namespace chute::app
