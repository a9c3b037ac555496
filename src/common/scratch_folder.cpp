#include "common/scratch_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "common/error.hpp"
#include "common/file_lock.hpp"

namespace chute {
namespace fs = std::filesystem;
namespace {

constexpr const char* lock_name = ".chute-lock";

int open_lock(const fs::path& file, int flags) {
  return ::open(file.c_str(), flags | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0600);
}

/// Locks the folder. The lock's file gets its name when it is locked: nobody finds it free before.
int lock_for_life(const fs::path& folder) {
  const auto unnamed = folder / ".new-lock";
  const int file = open_lock(unnamed, O_CREAT | O_EXCL);
  if (file < 0) return file;
  try_lock(file, LockKind::alone);
  std::error_code ignored;
  fs::rename(unnamed, folder / lock_name, ignored);
  return file;
}

/// Did a process leave this folder that is not there any more? One without a lock's file is being made by another.
bool is_left_over(const fs::path& folder) {
  struct stat status {};
  if (::lstat(folder.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != ::geteuid())
    return false;
  const int file = open_lock(folder / lock_name, 0);
  if (file < 0) return false;
  const bool free = try_lock(file, LockKind::alone) == TryLock::got;
  ::close(file);
  return free;
}

void remove_what_was_left(const fs::path& parent, const std::string& prefix) {
  std::error_code ignored;
  for (fs::directory_iterator entry(parent, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    const auto name = entry->path().filename().string();
    if (!name.starts_with(prefix) || !is_left_over(entry->path())) continue;
    std::error_code another_was_faster;
    fs::remove_all(entry->path(), another_was_faster);
  }
}

}  // namespace

ScratchFolder::ScratchFolder(std::string_view word) {
  const auto parent = fs::temp_directory_path();
  const auto prefix = fmt::format("chute-{}-", word);
  remove_what_was_left(parent, prefix);
  std::string name = (parent / (prefix + "XXXXXX")).string();
  if (!::mkdtemp(name.data()))
    throw WorkError(fmt::format("{}: cannot be made: {}", name, std::strerror(errno)));
  path_ = name;
  lock_ = lock_for_life(path_);
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace chute
