#include "common/file_lock.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <thread>
#include <utility>

#include "common/error.hpp"

namespace chute {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view lock_name = ".chute-lock";

bool is_same(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

/// What the holder wrote of itself.
std::string who_has(int file) {
  std::array<char, 300> text{};
  const auto count = ::pread(file, text.data(), text.size() - 1, 0);
  return count > 0 ? std::string(text.data(), static_cast<std::size_t>(count)) : "another process";
}

}  // namespace

static TryLock change_lock(int file, short type) {
  struct flock whole {};
  whole.l_type = type;
  whole.l_whence = SEEK_SET;
  if (::fcntl(file, F_OFD_SETLK, &whole) == 0) return TryLock::got;
  return errno == EAGAIN || errno == EACCES ? TryLock::held_by_another : TryLock::not_possible;
}

TryLock try_lock(int file, LockKind kind) {
  return change_lock(file, kind == LockKind::alone ? F_WRLCK : F_RDLCK);
}

FolderLock::FolderLock(const fs::path& folder, LockKind kind, const std::string& part)
    : name_(part.empty() ? lock_name : fmt::format("{}-{}", lock_name, part)) {
  // Whoever had it may have removed or moved the folder or the lock's file while this process waited for its turn.
  constexpr int tries = 1000;
  // Or is just about to: who holds it together with others has it alone for a moment in the end.
  constexpr int waits = 20;
  constexpr auto moment = std::chrono::milliseconds(5);
  for (int k = 0, waited = 0; k < tries; ++k) {
    if (!take(folder, kind)) {
      if (kind == LockKind::together && waited++ < waits) {
        close();
        std::this_thread::sleep_for(moment);
        continue;
      }
      const auto who = who_has(file_);
      close();
      throw WorkError(
          fmt::format("{}: {}{}in use by {}", folder.string(), part, part.empty() ? "" : " ", who));
    }
    if (is_current(folder)) {
      if (kind == LockKind::alone) say_who();
      return;
    }
    close();
  }
  throw WorkError(fmt::format("{}: cannot be locked: it changes all the time", folder.string()));
}

bool FolderLock::take(const fs::path& folder, LockKind kind) {
  folder_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder_ >= 0) file_ = ::openat(folder_, name_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) {
    const int why = errno;
    close();
    throw WorkError(fmt::format("{}: cannot write: {}", folder.string(), std::strerror(why)));
  }
  return try_lock(file_, kind) != TryLock::held_by_another;
}

bool FolderLock::is_current(const fs::path& folder) const {
  struct stat mine {
  }, there{};
  return ::fstat(folder_, &mine) == 0 && ::stat(folder.c_str(), &there) == 0 && is_same(mine, there) &&
         has_its_name();
}

bool FolderLock::has_its_name() const {
  struct stat mine {
  }, there{};
  return ::fstat(file_, &mine) == 0 && ::fstatat(folder_, name_.c_str(), &there, 0) == 0 &&
         is_same(mine, there);
}

void FolderLock::say_who() const {
  std::array<char, 256> machine{};
  ::gethostname(machine.data(), machine.size() - 1);
  const auto text = fmt::format("process {} on {}, since {:%FT%TZ}", ::getpid(), machine.data(),
                                fmt::gmtime(std::time(nullptr)));
  // Only for people: that it cannot be written, on a full disk, does not make the lock worse.
  if (::ftruncate(file_, 0) == 0) [[maybe_unused]]
    const auto written = ::pwrite(file_, text.data(), text.size(), 0);
}

void FolderLock::close() {
  if (file_ >= 0) ::close(std::exchange(file_, -1));
  if (folder_ >= 0) ::close(std::exchange(folder_, -1));
}

FolderLock::~FolderLock() {
  // Of several who hold it together the last one removes the file: the others' lock would be of a file without a name.
  // Two that end at once keep each other from having it alone, until they let go: then one of them is the last.
  if (file_ >= 0) {
    auto alone = try_lock(file_, LockKind::alone);
    if (alone == TryLock::held_by_another) {
      change_lock(file_, F_UNLCK);
      alone = try_lock(file_, LockKind::alone);
    }
    if (alone != TryLock::held_by_another && has_its_name()) ::unlinkat(folder_, name_.c_str(), 0);
  }
  close();
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : name_(std::move(other.name_)),
      folder_(std::exchange(other.folder_, -1)),
      file_(std::exchange(other.file_, -1)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  std::swap(name_, other.name_);
  std::swap(folder_, other.folder_);
  std::swap(file_, other.file_);
  return *this;
}

bool FolderLock::is_held(const fs::path& folder) {
  const int file = ::open((folder / lock_name).c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return false;
  struct flock whole {
  };  // only asked for: a lock taken for a moment would turn away a process that starts just then
  whole.l_type = F_WRLCK, whole.l_whence = SEEK_SET;
  const bool held = ::fcntl(file, F_OFD_GETLK, &whole) == 0 && whole.l_type != F_UNLCK;
  ::close(file);
  return held;
}

void FolderLock::remove_leftover(const fs::path& folder) {
  const auto path = folder / lock_name;
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return;
  struct stat mine {
  }, there{};
  if (try_lock(file, LockKind::alone) == TryLock::got && ::fstat(file, &mine) == 0 &&
      ::stat(path.c_str(), &there) == 0 && is_same(mine, there))
    ::unlink(path.c_str());
  ::close(file);
}

bool FolderLock::is_name(const fs::path& file) { return file.filename().string().starts_with(lock_name); }

}  // namespace chute
