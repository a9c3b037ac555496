#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "common/scratch_folder.hpp"

namespace scratch_folder_tests {
namespace fs = std::filesystem;
using chute::ScratchFolder;

TEST_CASE("a scratch folder goes with its object") {
  fs::path path;
  {
    const ScratchFolder scratch("test-goes");
    path = scratch.path();
    std::ofstream(path / "something") << "more";
    CHECK(fs::is_regular_file(path / "something"));
  }
  CHECK(!fs::exists(path));
}

TEST_CASE("what a killed process left is removed by the next, and nothing else") {
  const ScratchFolder mine("test-killed");
  const auto unlocked =
      mine.path().parent_path() / "chute-test-killed-unmade";  // another process may be making it
  fs::create_directory(unlocked);
  int to_parent[2];
  REQUIRE(::pipe(to_parent) == 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const ScratchFolder left("test-killed");
    const auto name = left.path().string();
    if (::write(to_parent[1], name.data(), name.size()) < 0) ::_exit(1);
    ::_exit(0);  // no destructor runs
  }
  REQUIRE(child > 0);
  ::close(to_parent[1]);
  std::string name(300, '\0');
  name.resize(static_cast<std::size_t>(std::max<ssize_t>(0, ::read(to_parent[0], name.data(), name.size()))));
  ::close(to_parent[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(fs::is_directory(name));
  const ScratchFolder next("test-killed");
  CHECK(!fs::exists(name));
  CHECK(fs::is_directory(mine.path()));
  CHECK(fs::is_directory(unlocked));
  fs::remove(unlocked);
}

}  // namespace scratch_folder_tests
