#include <catch2/catch.hpp>
#include <istream>
#include <ostream>

#include "common/error.hpp"
#include "folder.hpp"
#include "io/checkpoint_file.hpp"

using namespace chute;
using namespace chute::test;

namespace {

const std::string scene = "title = \"a scene\"\n";
const std::string program = "chute 1.2.3 (abc)";
const std::string grains = "grains as VTK has them";
const std::string state("grains \0 and so on", 18);
const io::Written as_written{grains.size(), [](std::ostream& out) { out << grains; }};

std::string state_of(const Folder& folder) {
  const auto checkpoint = io::read_checkpoint(folder / "checkpoint");
  // As StateInput does: it asks where the state ends, and comes back.
  auto& file = *checkpoint.state->rdbuf();
  const auto here = file.pubseekoff(0, std::ios::cur, std::ios::in),
             end = file.pubseekoff(0, std::ios::end, std::ios::in);
  file.pubseekpos(here, std::ios::in);
  std::string bytes(static_cast<std::size_t>(end - here), ' ');
  CHECK(file.sgetn(bytes.data(), end - here) == end - here);
  return bytes;
}

std::string saved(const Folder& folder) {
  io::write_checkpoint(folder / "checkpoint", {scene, program}, as_written,
                       [](std::ostream& out) { out << state; });
  return content(folder / "checkpoint");
}
std::string refused(const Folder& folder, const std::string& bytes) {
  write(folder / "checkpoint", bytes);
  return message<InputError>([&] { io::read_checkpoint(folder / "checkpoint"); });
}

}  // namespace

TEST_CASE("a checkpoint gives back what was saved") {
  const Folder folder;
  saved(folder);
  CHECK(state_of(folder) == state);
  CHECK(io::read_checkpoint(folder / "checkpoint").program == program);
  CHECK(io::read_checkpoint_grains(folder / "checkpoint") == grains);
  io::write_checkpoint(folder / "checkpoint", {scene, program}, as_written, [](std::ostream&) {});
  CHECK(state_of(folder).empty());
}

TEST_CASE("empty arrays, which have no address, do not disturb the sum") {
  const Folder folder;
  io::write_checkpoint(folder / "checkpoint", {scene, program}, as_written, [](std::ostream& out) {
    out << state;
    out.rdbuf()->sputn(nullptr, 0);
    out << state;
    out.rdbuf()->sputn(nullptr, 0);
  });
  CHECK(state_of(folder) == state + state);
}

TEST_CASE("a checkpoint cut anywhere is refused in one line") {
  const Folder folder;
  const auto whole = saved(folder);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    INFO("cut after " << size << " bytes");
    const auto says = refused(folder, whole.substr(0, size));
    CHECK(says.starts_with((folder / "checkpoint").string() + ": "));
    CHECK(says.find('\n') == says.npos);
  }
  CHECK(refused(folder, whole + "x").starts_with((folder / "checkpoint").string() + ": "));
}

TEST_CASE("a checkpoint with one flipped bit is refused in one line") {
  const Folder folder;
  const auto whole = saved(folder);
  for (std::size_t byte = 0; byte < whole.size(); ++byte)
    for (int bit = 0; bit < 8; ++bit) {
      INFO("byte " << byte << ", bit " << bit);
      auto damaged = whole;
      damaged[byte] = static_cast<char>(damaged[byte] ^ 1 << bit);
      const auto says = refused(folder, damaged);
      CHECK(says.starts_with((folder / "checkpoint").string() + ": "));
      CHECK(says.find('\n') == says.npos);
    }
}

TEST_CASE("a checkpoint tells whose it is") {
  const Folder folder;
  saved(folder);
  CHECK(io::read_checkpoint(folder / "checkpoint").scene == scene);
}

TEST_CASE("a missing checkpoint is an input error") {
  const Folder folder;
  CHECK(message<InputError>([&] { io::read_checkpoint(folder / "none"); }) ==
        (folder / "none").string() + ": cannot read: No such file or directory");
}

TEST_CASE("a save that fails leaves the old checkpoint whole and nothing beside it") {
  const Folder folder;
  const auto whole = saved(folder);
  struct Oops {};
  CHECK_THROWS_AS(io::write_checkpoint(folder / "checkpoint", {scene, program}, as_written,
                                       [](std::ostream& out) {
                                         out << "half";
                                         throw Oops{};
                                       }),
                  Oops);
  CHECK(content(folder / "checkpoint") == whole);
  CHECK(tree(folder.path()).size() == 1);
}
