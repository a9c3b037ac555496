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
    "incline.angle = \"18 deg\"\n"
    "bed = { kind = \"row\", count = 6 }\n"
    "grains = { count = 5, diameter.mean = 1 }\n"
    "run = { duration = 1 }\n"
    "contact.normal = { stiffness = 1000, restitution = 0.6 }\n"
    "contact.tangential = { law = \"cundall-strack\", friction = 0.5, stiffness_ratio = 0.5 }\n"
    "engine.method = ";
constexpr std::array<std::string_view, 4> methods{"\"soft\"\n", "\"event\"\n", "\"hybrid\"\n",
                                                  "\"contact\"\n"};

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
