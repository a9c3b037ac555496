#include "report/run_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/toml_reader.hpp"

namespace chute::report {
namespace fs = std::filesystem;
namespace {

Mean mean_of(const nlohmann::json& flow, const std::string& key) {
  const auto number = [&](const std::string& name) -> std::optional<double> {
    const auto found = flow.find(name);
    return found != flow.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
  };
  return {number(key), number(key + "_err")};
}

Record read_record(const fs::path& file) {
  try {
    const auto json = nlohmann::json::parse(read_file(file));
    Record r;
    r.version = json.value("version", ""), r.commit = json.value("commit", "");
    r.command = json.value("command", ""), r.machine = json.value("machine", "");
    r.started = json.value("started", ""), r.clock = json.value("clock", "time");
    r.end = json.value("end", ""), r.why = json.value("why", "");
    r.seed = json.value("seed", std::int64_t{0}), r.steps = json.value("steps", std::int64_t{0});
    r.threads = json.value("threads", std::int64_t{1});
    r.seconds = json.value("seconds", 0.0), r.time = json.value("time", 0.0);
    r.time_step = json.value("time_step", 0.0);
    if (const auto flow = json.find("flow"); flow != json.end() && flow->is_object())
      r.flow = {flow->value("verdict", ""), flow->value("from", 0.0), mean_of(*flow, "v_x"),
                mean_of(*flow, "omega"), mean_of(*flow, "kinetic")};
    return r;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: not the record of a run: {}", file.string(), error.what()));
  }
}

fs::path plain(const fs::path& directory) {
  auto path = directory.lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

}  // namespace

bool RunFiles::has(const std::string& file) const {
  std::error_code error;
  return fs::exists(path / file, error);
}

std::optional<read::Table> RunFiles::table(const std::string& file) const {
  if (!has(file)) return {};
  auto found = read::read_table(path / file);
  if (found.rows.empty()) return {};
  return found;
}

RunFiles read_run(const fs::path& directory) {
  RunFiles run;
  run.path = plain(directory);
  run.name = run.path.filename().string();
  if (run.name == "." || run.name == "..")
    run.name = fs::absolute(run.path).lexically_normal().filename().string();
  if (!run.has("run.json") || !run.has("scene.toml"))
    throw InputError(fmt::format("{}: not a run directory (no run.json and scene.toml); chute run makes one",
                                 directory.string()));
  run.record = read_record(run.path / "run.json");
  run.scene_text = read_file(run.path / "scene.toml");
  run.scene = parse_toml(run.scene_text, (run.path / "scene.toml").string());
  run.title = run.scene["title"].value_or(run.name);
  run.units = run.scene["units"].value_or(std::string("reduced"));
  run.dimensions = static_cast<int>(run.scene["dimensions"].value_or(std::int64_t{2}));
  return run;
}

std::vector<RunFiles> read_runs(std::span<const std::string> directories) {
  std::vector<RunFiles> runs;
  for (const auto& directory : directories) runs.push_back(read_run(directory));
  for (const auto& run : runs)
    if (run.units != runs.front().units)
      throw InputError(fmt::format("{} is in {} units and {} in {}: one page compares runs of the same units",
                                   runs.front().path.string(), runs.front().units, run.path.string(),
                                   run.units));
  std::vector<std::string> names;
  for (const auto& run : runs) names.push_back(run.name);
  for (auto& run : runs)
    if (std::count(names.begin(), names.end(), run.name) > 1) run.name = run.path.string();
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (runs[k].name == runs[i].name)
        throw InputError(fmt::format("{}: named twice", runs[i].path.string()));
  return runs;
}

}  // namespace chute::report
