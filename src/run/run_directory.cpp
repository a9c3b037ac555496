#include "run/run_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "measure/observer.hpp"
#include "run/record.hpp"

namespace chute::run {
namespace fs = std::filesystem;
namespace {

/// What a run leaves besides what observers write (and experiments: result.csv; and chute render: pictures).
constexpr std::array own_names{"scene.toml", "run.json", "result.csv", "checkpoint", "pictures"};
constexpr const char *old_run = ".chute-old-", *new_run = ".chute-new-";

/// Names that say nothing of whose folder it is: locks, and what a killed process left.
bool is_hidden(const fs::path& path) { return is_temporary(path) || FolderLock::is_name(path); }

bool is_own(const fs::path& path) {
  const auto name = path.filename().string();
  const auto observers = measure::all_files();
  return is_hidden(path) || std::ranges::count(own_names, name) > 0 ||
         std::ranges::count(observers, name) > 0;
}

bool is_used(const fs::path& folder) {
  return fs::exists(folder) && std::any_of(fs::directory_iterator(folder), {},
                                           [](const auto& entry) { return !is_hidden(entry.path()); });
}

/// Is there a run, or what is left of one that was cut off?
bool is_run(const fs::path& folder) {
  try {
    return nlohmann::json::parse(read_file(folder / "run.json")).value("program", "") == "chute";
  } catch (const std::exception&) {  // not there, or damaged
    // Pictures and tables alone may be anybody's.
    return (fs::exists(folder / "scene.toml") || fs::exists(folder / "run.json")) &&
           std::all_of(fs::directory_iterator(folder), {},
                       [](const auto& entry) { return is_own(entry.path()); });
  }
}

bool has_ended(const fs::path& folder) {
  try {
    return nlohmann::json::parse(read_file(folder / "run.json")).at("end") != "running";
  } catch (const std::exception&) {
    return false;
  }
}

/// Half-written files of killed processes go.
void tidy(const fs::path& folder) {
  remove_leftovers(folder);
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.is_directory(error) && is_own(entry.path())) remove_leftovers(entry.path());
}

/// The folders beside `path` that stand for it while it is replaced.
std::vector<fs::path> siblings_of(const fs::path& path, const std::string& what) {
  std::vector<fs::path> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_of(path), error)) {
    const auto name = entry.path().filename().string();
    const auto end = "-" + path.filename().string();
    if (name.starts_with(what) && name.ends_with(end) && name.size() == what.size() + 16 + end.size())
      found.push_back(entry.path());
  }
  return found;
}

/// Removes what is chute's; the rest moves to `heir`, unless such a name is there.
void empty_of_run(const fs::path& folder, const fs::path& heir) {
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
  for (const auto& entry : entries) {
    if (is_own(entry))
      fs::remove_all(entry);
    else if (!heir.empty() && !fs::exists(heir / entry.filename()))  // never over another
      fs::rename(entry, heir / entry.filename());
  }
}

void remove_run(const fs::path& folder, const fs::path& heir) {
  empty_of_run(folder, heir);
  std::error_code error;
  fs::remove(folder, error);  // not if something of other people's had to stay
}

}  // namespace

fs::path RunDirectory::sibling(const char* what) const {
  return path_.parent_path() / fmt::format("{}{}-{}", what, random_name(), path_.filename().string());
}

RunDirectory::RunDirectory(const fs::path& path, Existing existing) : path_(path) {
  const auto free_place = [this] {
    lock_.reset();
    std::error_code ignored;
    if (made_) fs::remove(path_, ignored);  // only if it is empty
  };
  try {
    prepare(existing);
  } catch (const WorkError&) {
    free_place();
    throw;
  } catch (const fs::filesystem_error& error) {
    free_place();
    throw WorkError(fmt::format("{}: cannot write: {}", path_.string(), error.code().message()));
  }
}

void RunDirectory::prepare(Existing existing) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {}", path_.string(), what));
  };
  if (!path_.has_filename()) path_ = path_.parent_path();  // "run/"
  if (fs::exists(path_) && !fs::is_directory(path_)) refuse("is a file, not a folder for a run");
  if (is_used(path_) && !is_run(path_)) refuse("holds files that are not a run; give another folder with -o");
  if (!fs::exists(path_)) {
    // Between the two renames of a replacement, where one is not to be had, the old run stands beside its place.
    const auto old = siblings_of(path_, old_run);
    if (old.size() == 1 && !FolderLock::is_held(old.front()))
      fs::rename(old.front(), path_);
    else
      made_ = fs::create_directories(path_);
    flush_folder(folder_of(path_));
  }
  lock_.emplace(path_);
  const bool used = is_used(path_);
  if (used && !is_run(path_)) refuse("holds files that are not a run; give another folder with -o");
  if (used && existing == Existing::refuse)
    refuse("a run is already there; give --resume to go on with it, --force to replace it, or -o another");
  fresh_ = !used;
  resumes_ = used && existing == Existing::resume && fs::exists(path_ / "checkpoint");
  if (used && existing == Existing::resume && !resumes_ && has_ended(path_))
    refuse("has no checkpoint to resume from; give --force to start again");
  tidy(path_);
  replaces_ = used && existing == Existing::replace;
  if (!replaces_) return;
  path_ = fs::canonical(path_);  // a link to the folder stays a link
  beside_ = sibling(new_run);
  fs::create_directory(*beside_);
  new_lock_.emplace(*beside_);
}

void RunDirectory::claim(const RunRecord& record) {
  if (!replaces_) return write_record(file("run.json"), record);
  write_record(*beside_ / "run.json", record);
  exchange();
  flush_folder(folder_of(path_));
}

/// The new folder comes to its place and the old one goes beside it.
void RunDirectory::exchange() {
  const auto old = sibling(old_run);
  if (::renameat2(AT_FDCWD, beside_->c_str(), AT_FDCWD, path_.c_str(), RENAME_EXCHANGE) == 0) {
    exchanged_ = true;
    if (::rename(beside_->c_str(), old.c_str()) == 0) beside_ = old;
    return;
  }
  // Some file systems cannot exchange. Who comes between these two renames finds the old run beside its place.
  if (::rename(path_.c_str(), old.c_str()) == 0 && ::rename(beside_->c_str(), path_.c_str()) == 0) {
    exchanged_ = true;
    beside_ = old;
    return;
  }
  throw WorkError(fmt::format("{}: cannot move the old run aside: {}", path_.string(), std::strerror(errno)));
}

void RunDirectory::finish() {
  try {
    for (const auto* what : {old_run, new_run})
      for (const auto& folder : siblings_of(path_, what)) {
        if (folder != beside_ && FolderLock::is_held(folder)) continue;
        remove_run(folder, path_);
      }
  } catch (const fs::filesystem_error& error) {
    throw WorkError(fmt::format("{}: cannot remove: {}", error.path1().string(), error.code().message()));
  }
}

void RunDirectory::leave_no_trace() const noexcept {
  try {
    made_ ? remove_run(path_, {}) : empty_of_run(path_, {});
  } catch (const fs::filesystem_error&) {
    // What stays is still a run that --force replaces.
  }
}

void RunDirectory::put_back() noexcept {
  std::error_code error;
  if (fs::exists(path_ / "checkpoint", error)) return;
  if (fresh_) return leave_no_trace();
  if (!replaces_ || !beside_) return;
  if (exchanged_ && ::renameat2(AT_FDCWD, beside_->c_str(), AT_FDCWD, path_.c_str(), RENAME_EXCHANGE) != 0)
    return;
  try {
    remove_run(*beside_, {});
  } catch (const fs::filesystem_error&) {
    // The next run that finishes here removes what is left.
  }
}

}  // namespace chute::run
