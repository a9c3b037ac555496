#include "run/run_directory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "common/error.hpp"
#include "measure/observer.hpp"

namespace chute::run {
namespace fs = std::filesystem;
namespace {

/// What a run leaves besides what observers write (and experiments: result.csv).
constexpr std::array own_names{"scene.toml", "run.json", "result.csv", "checkpoint"};

bool is_run(const fs::path& path) { return fs::exists(path / "scene.toml") && fs::exists(path / "run.json"); }

}  // namespace

RunDirectory::RunDirectory(fs::path path, Existing existing) : path_(std::move(path)) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {}", path_.string(), what));
  };
  try {
    if (fs::exists(path_) && !fs::is_directory(path_)) refuse("is a file, not a folder for a run");
    const bool used = fs::exists(path_) && !fs::is_empty(path_);
    if (used && !is_run(path_)) refuse("holds files that are not a run; give another folder with -o");
    if (used && existing == Existing::refuse)
      refuse("a run is already there; give --resume to go on with it, --force to replace it, or -o another");
    if (used && existing == Existing::resume) {
      resumes_ = fs::exists(path_ / "checkpoint");
      if (!resumes_) refuse("has no checkpoint to resume from; give --force to start again");
    }
    if (used && existing == Existing::replace) {
      for (const char* name : own_names) fs::remove_all(path_ / name);
      for (const auto& name : measure::all_files()) fs::remove_all(path_ / name);
    }
    fs::create_directories(path_);
  } catch (const fs::filesystem_error& error) {
    throw WorkError(fmt::format("{}: cannot write: {}", path_.string(), error.code().message()));
  }
}

}  // namespace chute::run
