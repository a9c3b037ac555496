#include <sys/resource.h>
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <csignal>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "folder.hpp"

using namespace chute;
using namespace chute::test;

namespace {

/// While it lives, no file may grow beyond `bytes`: what a full disk does to a write, without filling one.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);  // a write then fails instead of ending the process
    const rlimit small{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

}  // namespace

TEST_CASE("a file appears whole, and replaces the old one") {
  const Folder folder;
  std::string bytes;
  for (int i = 0; i < 100'000; ++i) bytes += static_cast<char>(i * 7);
  write_atomically(folder / "a.bin", bytes);
  CHECK(read_file(folder / "a.bin") == bytes);
  write_atomically(folder / "a.bin", "short");
  CHECK(read_file(folder / "a.bin") == "short");
  write_atomically(folder / "empty", "");
  CHECK(read_file(folder / "empty").empty());
  CHECK(tree(folder.path()).size() == 2);  // nothing beside them
}

TEST_CASE("a full disk leaves the old file and nothing beside it") {
  const Folder folder;
  write_atomically(folder / "series.csv", "the old one");
  std::string said;
  {
    const SmallDisk disk(4096);
    said = message<WorkError>([&] { write_atomically(folder / "series.csv", std::string(10'000, 'x')); });
  }
  CHECK(said == (folder / "series.csv").string() + ": cannot write: File too large");
  CHECK(tree(folder.path()) == std::map<std::string, std::string>{{"series.csv", "the old one"}});
}

TEST_CASE("a folder that is not there, or is a file, is an error that names the file") {
  const Folder folder;
  CHECK(message<WorkError>([&] { write_atomically(folder / "none/a", "x"); }) ==
        (folder / "none/a").string() + ": cannot write: No such file or directory");
  write(folder / "file", "x");
  CHECK(message<WorkError>([&] { write_atomically(folder / "file/a", "x"); }) ==
        (folder / "file/a").string() + ": cannot write: Not a directory");
}

TEST_CASE("a folder that may not be written leaves the old file") {
  if (::geteuid() == 0) return;  // root may write anywhere
  const Folder folder;
  write(folder / "a", "the old one");
  ::chmod(folder.path().c_str(), 0555);
  const auto said = message<WorkError>([&] { write_atomically(folder / "a", "x"); });
  ::chmod(folder.path().c_str(), 0755);
  CHECK(said == (folder / "a").string() + ": cannot write: Permission denied");
  CHECK(tree(folder.path()) == std::map<std::string, std::string>{{"a", "the old one"}});
}

TEST_CASE("a name that cannot be replaced leaves nothing beside it") {
  const Folder folder;
  fs::create_directories(folder / "taken/inside");  // a folder that is not empty cannot be renamed over
  CHECK(message<WorkError>([&] {
          write_atomically(folder / "taken", "x");
        }).starts_with((folder / "taken").string() + ": cannot write: "));
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder.path())) ++entries;
  CHECK(entries == 1);
}

TEST_CASE("a writer that throws leaves the old file and nothing beside it") {
  const Folder folder;
  write_atomically(folder / "frame.vtp", "the old one");
  struct Oops {};
  fs::path given;
  CHECK_THROWS_AS(replace_atomically(folder / "frame.vtp",
                                     [&](const fs::path& temporary) {
                                       given = temporary;
                                       write(temporary, "half of the");
                                       throw Oops{};
                                     }),
                  Oops);
  CHECK(given.parent_path() == folder.path());  // the same file system, so that a rename is enough
  CHECK(given.extension() == ".vtp");
  CHECK(tree(folder.path()) == std::map<std::string, std::string>{{"frame.vtp", "the old one"}});
}

TEST_CASE("files that cannot be read are input errors") {
  const Folder folder;
  CHECK(message<InputError>([&] { read_file(folder / "none"); }) ==
        (folder / "none").string() + ": cannot read: No such file or directory");
  CHECK(message<InputError>([&] { read_file(folder.path()); }) ==
        folder.path().string() + ": is a directory, not a file");
}
