#include "common/new_folder.hpp"

#include <system_error>
#include <utility>

#include "common/atomic_file.hpp"
#include "common/error.hpp"

namespace chute {
namespace fs = std::filesystem;
namespace {

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> inside;
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error))
    inside.push_back(entry->path());
  return inside;
}

}  // namespace

NewFolder::NewFolder(fs::path path, IsOwn own, std::string why)
    : path_(std::move(path)), own_(std::move(own)), why_(std::move(why)) {
  if (path_.empty()) throw InputError("the folder for what is written: its name is empty");
  refuse_used();
}

void NewFolder::refuse_used() const {
  std::error_code error;
  if (!fs::exists(path_, error)) return;
  if (!fs::is_directory(path_, error))
    throw InputError(path_.string() + ": is a file; name a new folder" + why_);
  bool locked = false, all_own = true;
  const auto inside = entries_of(path_);
  for (const auto& entry : inside) {
    const bool lock = FolderLock::is_name(entry);
    locked |= lock;
    all_own &= lock || is_temporary(entry) || own_(entry.filename());
  }
  if (inside.empty()) return;
  if (locked && FolderLock::is_held(path_)) const FolderLock tells_who(path_);  // throws
  if (!locked || !all_own) throw InputError(path_.string() + ": is not empty; name a new folder" + why_);
}

void NewFolder::make() {
  if (made_) return;
  std::error_code error;
  for (auto folder = path_; !folder.empty() && !fs::exists(folder, error); folder = folder.parent_path())
    fresh_.push_back(folder);
  fs::create_directories(path_, error);
  if (error) throw WorkError(path_.string() + ": cannot be made: " + error.message());
  refuse_used();  // somebody may have been here since
  lock_.emplace(path_);
  made_ = true;
  empty();
}

/// The lock goes last: whoever is killed here has left a folder that can be taken over.
void NewFolder::empty() const noexcept {
  std::error_code ignored;
  for (const auto& entry : entries_of(path_))
    if (!FolderLock::is_name(entry)) fs::remove_all(entry, ignored);
}

NewFolder::~NewFolder() {
  if (kept_ || !made_) return;
  empty();
  lock_.reset();
  std::error_code ignored;
  for (const auto& folder : fresh_) fs::remove(folder, ignored);  // only if it is empty
}

}  // namespace chute
