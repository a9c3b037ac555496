#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "common/error.hpp"
#include "common/file_lock.hpp"

namespace file_lock_tests {
namespace fs = std::filesystem;
using chute::FolderLock;

TEST_CASE("a folder is for one at a time, and the lock of a process that was killed is taken away") {
  const auto folder = fs::temp_directory_path() / ("chute-lock-" + std::to_string(::getpid()));
  fs::create_directory(folder);
  const auto file = folder / ".chute-lock";
  {
    const FolderLock lock(folder);
    CHECK(FolderLock::is_held(folder));
    CHECK_THROWS_AS(FolderLock(folder), chute::WorkError);
    FolderLock::remove_leftover(folder);  // somebody has it
    CHECK(fs::exists(file));
    CHECK(FolderLock::is_held(folder));
  }
  CHECK_FALSE(fs::exists(file));
  FolderLock::remove_leftover(folder);  // there is none
  std::ofstream(file) << "process 1 on nowhere";
  CHECK_FALSE(FolderLock::is_held(folder));
  FolderLock::remove_leftover(folder);
  CHECK(fs::is_empty(folder));
  fs::remove(folder);
}

}  // namespace file_lock_tests
