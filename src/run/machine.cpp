#include "run/machine.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "common/error.hpp"
#include "run/facts.hpp"
#include "scene/world.hpp"

namespace chute::run {
namespace {

namespace fs = std::filesystem;

constexpr double giga = 1e9;

/// Bytes that the process may have: the machine's, or the share that its control group leaves it.
double memory_here() {
  double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  for (const char* const limit :
       {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    double most = 0;
    if (std::ifstream in(limit); in >> most && most > 0) bytes = std::min(bytes, most);
  }
  return bytes;
}

/// Bytes free where the folder is or would be made; without end if that cannot be told.
double disk_free(fs::path folder) {
  std::error_code failed;
  folder = fs::absolute(folder.empty() ? "." : folder, failed);
  while (!fs::exists(folder, failed) && folder.has_relative_path()) folder = folder.parent_path();
  const auto space = fs::space(folder, failed);
  return failed ? std::numeric_limits<double>::infinity() : static_cast<double>(space.available);
}

double memory_of(const scene::Scene& scene) {
  constexpr double mega = 1e6;
  for (const auto& fact : scene.engine->facts(scene::setting_of(scene)))
    if (fact.name == "memory") return mega * fact.value;
  return 0;
}

}  // namespace

std::vector<std::string> beyond_machine(const scene::Scene& scene, const fs::path& directory) {
  std::vector<std::string> beyond;
  const auto compare = [&](const char* key, const char* what, double needed, double there, const char* has) {
    if (needed > there)
      beyond.push_back(fmt::format("{}: the run takes about {:.3g} GB of {}; {} {:.3g} GB", key,
                                   needed / giga, what, has, there / giga));
  };
  compare("grains.count", "memory", memory_of(scene), memory_here(), "this machine has");
  compare("output", "disk", disk_of(scene), disk_free(directory), "free there are");
  return beyond;
}

void refuse_beyond_machine(const scene::Scene& scene, const std::string& name, const fs::path& directory) {
  if (const auto beyond = beyond_machine(scene, directory); !beyond.empty())
    throw InputError(
        fmt::format("{}: {}; --beyond-machine lets it begin all the same", name, beyond.front()));
}

}  // namespace chute::run
