#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "app/description.hpp"
#include "app/progress.hpp"
#include "app/verbs.hpp"
#include "common/atomic_file.hpp"
#include "common/column_texts.hpp"
#include "common/error.hpp"
#include "common/file_lock.hpp"
#include "io/checkpoint_file.hpp"
#include "run/flow.hpp"
#include "run/record.hpp"

namespace chute::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// "min … max" of what is known.
std::string span_text(const Json& range) {
  if (!range.is_array()) return "nothing known";
  return fmt::format("{:.6g} … {:.6g}", range[0].get<double>(), range[1].get<double>());
}

std::string text_of(const Json& value) { return value.get<std::string>(); }

/// A unit on a terminal: \sqrt{gd} as sqrt(gd).
std::string plain_unit(std::string unit) {
  for (const auto& [from, to] : {std::pair{"\\sqrt{", "sqrt("}, {"}", ")"}})
    for (std::size_t at = 0; (at = unit.find(from, at)) != std::string::npos;)
      unit.replace(at, std::string_view(from).size(), to);
  return unit;
}

std::string vector_text(const Json& values) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", values[0].get<double>(), values[1].get<double>(),
                     values[2].get<double>());
}

void show_points(const Json& file) {
  if (file.contains("frames")) {
    fmt::print(
        "{}: {} frame{}{}, {} {}; of the first:\n", text_of(file["file"]), file["frames"].get<std::size_t>(),
        file["frames"] == 1 ? "" : "s",
        file.value("files", 1) > 1 ? fmt::format(" in {} files", file["files"].get<std::size_t>()) : "",
        file["texts"].contains("clock") ? text_of(file["texts"]["clock"]) : "time", span_text(file["time"]));
    if (file["cut_after"].is_string()) fmt::print("  left out at the end: {}\n", text_of(file["cut_after"]));
  }
  fmt::print("{}: {} points, {} {}\n", text_of(file["file"]), file["points"].get<std::size_t>(),
             file["cells"].get<std::size_t>(), file.contains("grid") ? "cells" : "lines and polygons");
  fmt::print("  place  x {}   y {}   z {}\n", span_text(file["x"]), span_text(file["y"]),
             span_text(file["z"]));
  for (const auto& array : file["arrays"]) {
    const int components = array["components"];
    const auto values =
        array.contains("words")
            ? fmt::format("{}", fmt::join(array["words"].get<std::vector<std::string>>(), ", "))
            : span_text(array["range"]);
    fmt::print("  {:<6} {:<18} {} component{}  {} {}\n", text_of(array["where"]), text_of(array["name"]),
               components, components == 1 ? " " : "s", values, plain_unit(text_of(array["unit"])));
  }
  for (const auto& [name, text] : file["texts"].items())
    fmt::print("  field  {:<18} {}\n", name, text_of(text));
  if (!file.contains("box")) return;
  const auto& box = file["box"];
  fmt::print("  box    from {}", vector_text(box["origin"]));
  for (std::size_t edge = 0; edge < 3; ++edge)
    fmt::print("{} {}{}", edge ? "," : ", edges", vector_text(box["edges"][edge]),
               box["periodic"][edge].get<bool>() ? " periodic" : "");
  fmt::print("\n");
}

/// Type, range and gaps of a column.
std::string column_text(const Json& column) {
  const auto type = text_of(column["type"]);
  std::string text;
  if (type == "number")
    text = span_text(column["range"]);
  else if (type == "time")
    text = fmt::format("text, times from {} to {}", text_of(column["range"][0]), text_of(column["range"][1]));
  else
    text = fmt::format("text, {} different", column["different"].get<std::size_t>());
  const auto gaps = column["gaps"].get<std::size_t>();
  return gaps == 0 ? text : fmt::format("{}, {} gap{}", text, gaps, gaps == 1 ? "" : "s");
}

void show_table(const Json& file) {
  for (const auto& comment : file["comments"])  // what columns mean is --columns' answer
    if (const auto text = text_of(comment); !text.starts_with(column_comment)) fmt::print("# {}\n", text);
  fmt::print("{}: {} rows\n", text_of(file["file"]), file["rows"].get<std::size_t>());
  for (const auto& column : file["columns"])
    fmt::print("  {:<18} {}\n", text_of(column["name"]), column_text(column));
}

/// `clock`: what the run's time counts.
void show_flow(const std::string& clock, const fs::path& path) {
  measure::Flow flow;
  try {
    flow = run::read_flow(path);
  } catch (const InputError&) {
    return;  // a run that has not written any series yet
  }
  const auto text = [](const Estimate& e) {
    return e.error ? fmt::format("{:.6g} ± {:.2g}", e.mean, *e.error) : fmt::format("{:.6g}", e.mean);
  };
  if (!std::isfinite(flow.from)) return;  // a run that has hardly begun
  fmt::print("the flow is {}; from {} = {:.6g} on: v_x = {}, omega = {}\n", measure::name(flow.verdict),
             clock == "time" ? std::string("t") : clock, flow.from, text(flow.v_x), text(flow.omega));
}

/// How far a run is that has not finished, and how to go on with it.
void show_progress(const Json& record, const fs::path& path) {
  const auto end = record.value("end", "");
  if (end == "finished" || !record.contains("duration")) return;
  const double time = record.value("time", 0.0), duration = record.value("duration", 0.0);
  const auto at = fmt::format("at {} = {:.6g} of {:.6g} ({:.0f} %)", record.value("clock", "time"), time,
                              duration, duration > 0 ? 100 * time / duration : 0);
  const bool alive = end == "running" && FolderLock::is_held(path);
  if (alive) {
    const double left = record.value("seconds_left", 0.0);
    fmt::print("running: {}{}; tables and frames.pvd are as of {}\n", at,
               left > 0 ? fmt::format(", about {} left", duration_text(left)) : "",
               record.value("written", "the begin"));
  } else {
    fmt::print("{}: {}; chute run {} --resume goes on\n", end == "running" ? "was cut off" : end, at,
               path.string());
  }
}

void show_account(const Json& record) {
  if (!record.contains("energy")) return;
  const auto& energy = record["energy"];
  fmt::print("the energy account is off by {:.2g} % of what was turned over: {}\n",
             100 * energy["part"].get<double>(), text_of(energy["verdict"]));
}

void show_run(const Json& run, const fs::path& path) {
  fmt::print("{}", run::read_record_text(path));
  show_progress(run["record"], path);
  show_flow(run["record"].value("clock", "time"), path);
  show_account(run["record"]);
  for (const auto& file : run["files"]) {
    const bool folder = file.contains("files");
    fmt::print("  {:<20} {:>12} {}\n", text_of(file["name"]),
               file[folder ? "files" : "bytes"].get<std::uintmax_t>(), folder ? "files" : "bytes");
  }
}

void show_sweep(const Json& sweep) {
  const auto title = text_of(sweep["title"]);
  fmt::print("{}{}{}\n", text_of(sweep["directory"]), title.empty() ? "" : ": ", title);
  for (const auto& axis : sweep["axes"])
    fmt::print("  {:<28} {} {}\n", text_of(axis["key"]),
               fmt::join(axis["values"].get<std::vector<double>>(), ", "), text_of(axis["unit"]));
  fmt::print("  {:<28} 1 to {}\n", "seed", sweep["seeds"].get<int>());
  if (sweep.contains("boundary")) {
    fmt::print("boundaries along {}: {} points so far; ", text_of(sweep["boundary"]),
               sweep["files"].get<int>());
  } else {
    fmt::print("{} of {} points are there; starts:", sweep["found"].get<int>(), sweep["points"].get<int>());
    for (const auto& [verdict, count] : sweep["starts"].items())
      if (count.get<int>() > 0) fmt::print(" {} {}", count.get<int>(), verdict);
    fmt::print("; ");
  }
  const bool done = sweep["table"].get<bool>() && sweep.value("found", 0) == sweep.value("points", 0);
  fmt::print("{}\n", done ? "its tables are there"
                          : fmt::format("chute sweep {} --resume goes on", text_of(sweep["directory"])));
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

/// What the columns of a table, or the arrays of a VTK file, mean.
void columns(const fs::path& path) {
  const auto found = describe_file(path);
  const auto kind = text_of(found["kind"]);
  std::vector<std::string> names;
  std::string comments;
  if (kind == "table") {
    for (const auto& column : found["columns"]) names.push_back(text_of(column["name"]));
    for (const auto& comment : found["comments"]) comments += text_of(comment);
  } else if (kind == "vtk" || kind == "frames") {
    for (const auto& array : found["arrays"])
      if (array["where"] != "field") names.push_back(text_of(array["name"]));
  } else {
    throw InputError(path.string() + ": --columns tells of a table or a VTK file; chute info " +
                     path.string() + " names those of a run");
  }
  const auto* table = find_table_text(path.filename().string(), names);
  if (!table)
    throw InputError(path.string() + ": not a file as chute writes them: what its columns mean is not known");
  const bool si = kind != "table" ? found["texts"].value("units", "") == "SI"
                                  : comments.find("units: SI") != comments.npos;
  fmt::print("{}: a row is {}\n", path.string(), table->rows);
  for (const auto& name : names) {
    const auto column = column_text(*table, name);
    const auto unit = !column ? std::string() : si ? column->si : column->reduced;
    fmt::print("  {:<18} {:<22} {}\n", name, unit,
               column ? column->meaning : "not known: an axis of the sweep, or another program's");
  }
}

void info(const fs::path& path, bool json) {
  const auto found = describe_file(path);
  if (json)
    return fmt::print("{}\n", found.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  const auto kind = text_of(found["kind"]);
  if (kind == "run") show_run(found, path);
  if (kind == "sweep") show_sweep(found);
  if (kind == "table") show_table(found);
  if (kind == "vtk" || kind == "frames" || kind == "dump" || kind == "xyz") show_points(found);
}

}  // namespace

void add_info(CLI::App& app) {
  auto* verb =
      app.add_subcommand("info", "Tell what a run, a VTK file, a dump, an XYZ file or a table holds");
  struct Arguments {
    std::string path;
    bool json = false, verify = false, columns = false;
  };
  auto a = std::make_shared<Arguments>();
  verb->add_option(
      "path", a->path,
      "run directory, folder of a sweep, CSV table; VTK file, dump of LAMMPS or XYZ file, or a folder, an index of times "
      "or a pattern of these, as chute render takes them");
  verb->add_flag("--columns", a->columns,
                 "what the columns of a table or the arrays of a VTK file mean; without a file: of all");
  auto* json = verb->add_flag("--json", a->json, "for programs: keys as in README.md");
  verb->add_flag("--verify", a->verify, "compare every file of a run with the checksums in its run.json")
      ->excludes(json);
  verb->footer(
      "Exit status with --verify: 0 all files are whole, 1 some are not.\n"
      "Example: chute info out/demo/impacts.vtp\n"
      "         chute info --verify out/demo");
  verb->callback([a] {
    if (a->path.empty() && a->columns) return fmt::print("{}", column_tables());
    if (a->path.empty()) throw InputError("info: name a run, a sweep, a VTK file or a table");
    if (a->columns) return columns(a->path);
    a->verify ? verify(a->path) : info(a->path, a->json);
  });
}

}  // namespace chute::app
