#include <sstream>

#include "common/error.hpp"
#include "in_memory.hpp"
#include "io/checkpoint_file.hpp"
#include "run/session.hpp"
#include "targets.hpp"

namespace chute::fuzz {
namespace {

/// Small runs of methods that keep different things; the first byte of the input chooses.
constexpr std::string_view start =
    "bed = { kind = \"row\", count = 6 }\n"
    "grains = { count = 5, diameter.mean = 1 }\n"
    "run = { duration = 1 }\n";
constexpr std::array<std::string_view, 4> methods{
    "[contact]\nnormal = { stiffness = 1000, restitution = 0.6 }\ntangential = { law = \"cundall-strack\", friction = 0.5, "
    "stiffness_ratio = 0.5 }\n",
    "[contact]\nrestitution = 0.6\nfriction = 0.5\n[engine]\nmethod = \"event\"\n",
    "[contact]\nrestitution = 0.6\nfriction = 0.5\n[engine]\nmethod = \"hybrid\"\n",
    "[contact]\nrestitution = 0\nfriction = 0.5\n[engine]\nmethod = \"contact\"\n"};

}  // namespace

void checkpoint(std::string_view bytes) {
  const FileInMemory file(bytes);
  try {
    io::check_checkpoint(file.path());
  } catch (const InputError&) {
  }
  if (bytes.empty()) return;
  const auto method = methods[static_cast<unsigned char>(bytes[0]) % methods.size()];
  run::Session session(scene::parse_scene(std::string(start) + std::string(method), "checkpoint.toml"), 1);
  std::istringstream state{std::string(bytes.substr(1))};
  session.load(state);
}

}  // namespace chute::fuzz
