#include "common/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

#include "common/error.hpp"
#include "common/file_lock.hpp"

namespace chute {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view prefix = ".chute-";
constexpr std::size_t random_digits = 16;

[[noreturn]] void cannot_write(const fs::path& path, int why) {
  throw WorkError(fmt::format("{}: cannot write: {}", path.string(), std::strerror(why)));
}

/// Is it the only one who has this file, and is the file still there?
bool taken_alone(int file) {
  struct stat facts {};
  const auto lock = try_lock(file, LockKind::alone);
  return lock != TryLock::held_by_another && ::fstat(file, &facts) == 0 && facts.st_nlink > 0;
}

}  // namespace

std::string random_name() {
  std::uint64_t bits = 0;
  while (::getrandom(&bits, sizeof bits, 0) != sizeof bits) {
  }
  return fmt::format("{:016x}", bits);
}

fs::path folder_of(const fs::path& file) {
  const auto folder = file.parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

bool is_temporary(const fs::path& path) {
  const auto name = path.filename().string();
  if (!name.starts_with(prefix) || name.size() < prefix.size() + random_digits) return false;
  const auto digits = std::string_view(name).substr(prefix.size(), random_digits);
  const auto rest = name.substr(prefix.size() + random_digits);
  return digits.find_first_not_of("0123456789abcdef") == digits.npos && (rest.empty() || rest[0] == '.');
}

Temporary::Temporary(fs::path target) : target_(std::move(target)) {
  constexpr int tries = 100;  // each fails only if a cleaner took the new file for one that nobody writes
  for (int k = 0; k < tries; ++k) {
    path_ =
        target_.parent_path() / fmt::format("{}{}{}", prefix, random_name(), target_.extension().string());
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file_ < 0 && errno == EEXIST) continue;
    if (file_ < 0) fail();
    if (taken_alone(file_)) return;
    ::close(file_);
  }
  cannot_write(target_, EBUSY);
}

Temporary::Temporary(Temporary&& other) noexcept
    : target_(std::move(other.target_)),
      path_(std::move(other.path_)),
      file_(std::exchange(other.file_, -1)) {}

Temporary::~Temporary() {
  if (file_ < 0) return;
  ::unlink(path_.c_str());
  ::close(file_);
}

void Temporary::fail() const { cannot_write(target_, errno); }

void Temporary::done() { ::close(std::exchange(file_, -1)); }

void Temporary::write(std::string_view content) {
  while (!content.empty()) {
    const auto written = ::write(file_, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail();
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

void Temporary::begin_flush() const { ::sync_file_range(file_, 0, 0, SYNC_FILE_RANGE_WRITE); }

void Temporary::flush() {
  if (::fsync(file_) != 0) fail();
}

void Temporary::move_into_place() {
  if (::rename(path_.c_str(), target_.c_str()) != 0) fail();
  done();
}

bool Temporary::move_if_absent() {
  if (::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target_.c_str(), RENAME_NOREPLACE) == 0) {
    done();
    return true;
  }
  // Network file systems know no such rename, but links; the other name then goes with this object.
  if (errno != EEXIST && ::link(path_.c_str(), target_.c_str()) == 0) return true;
  if (errno != EEXIST) fail();
  return false;
}

void flush_file(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool good = file >= 0 && ::fsync(file) == 0;
  const int why = errno;
  if (file >= 0) ::close(file);
  if (!good) cannot_write(path, why);
}

void flush_folder(const fs::path& path) {
  const int folder = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // Some file systems, network ones above all, flush names by themselves and refuse to be asked.
  const bool good = folder >= 0 && (::fsync(folder) == 0 || errno == EINVAL || errno == EBADF);
  const int why = errno;
  if (folder >= 0) ::close(folder);
  if (!good) cannot_write(path, why);
}

void write_atomically(const fs::path& path, std::string_view content, Flush flush) {
  Temporary temporary(path);
  temporary.write(content);
  if (flush == Flush::now) temporary.flush();
  temporary.move_into_place();
  if (flush == Flush::now) flush_folder(folder_of(path));
}

bool write_if_absent(const fs::path& path, std::string_view content) {
  Temporary temporary(path);
  temporary.write(content);
  temporary.flush();
  if (!temporary.move_if_absent()) return false;
  flush_folder(folder_of(path));
  return true;
}

void remove_leftovers(const fs::path& folder) noexcept {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (!is_temporary(entry->path())) continue;
    const int file = ::open(entry->path().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (file < 0) continue;
    if (try_lock(file, LockKind::alone) == TryLock::got) ::unlink(entry->path().c_str());
    ::close(file);
  }
}

std::string read_file(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw InputError(path.string() + ": is a directory, not a file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(fmt::format("{}: cannot read: {}", path.string(), std::strerror(errno)));
  std::ostringstream content;
  content << in.rdbuf();
  return std::move(content).str();
}

}  // namespace chute
