#include "starts/from_file.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/error.hpp"
#include "io/checkpoint_file.hpp"
#include "io/grains_file.hpp"

namespace chute::starts {
namespace {

namespace fs = std::filesystem;

std::vector<io::GrainRecord> grains_of(const FromFile& start) {
  const fs::path path = start.from;
  if (!fs::exists(path))
    throw InputError(fmt::format("grains.start.from: {}: no such run or file", start.from));
  if (!fs::is_directory(path)) return io::read_grains(path);
  if (!start.frame && !start.time) {
    const auto checkpoint = path / "checkpoint";
    if (!fs::exists(checkpoint))
      throw InputError(
          fmt::format("grains.start.from: {}: not a run with a checkpoint; give frame or time", start.from));
    return io::parse_grains(io::read_checkpoint_grains(checkpoint), checkpoint.string());
  }
  const auto frames = io::read_pvd(path / "frames.pvd");
  if (start.frame) {
    const auto k = static_cast<std::size_t>(*start.frame);
    if (k >= frames.size())
      throw InputError(fmt::format("grains.start.frame: {} is not there, the run has frames 0 to {}", k,
                                   frames.size() - 1));
    return io::read_grains(frames[k].second);
  }
  for (const auto& [time, file] : frames)
    if (std::abs(time - *start.time) <= 1e-9 * std::max(1.0, std::abs(time))) return io::read_grains(file);
  throw InputError(fmt::format("grains.start.time: no frame at {}, they go from {} to {}", *start.time,
                               frames.front().first, frames.back().first));
}

}  // namespace

std::optional<Refusal> FromFile::misfit(const Opening& opening) const {
  if (opening.independent)
    return Refusal{"grains.start.from",
                   "grains that were in touch cannot go on as if they did not feel each other"};
  return {};
}

std::vector<Launch> FromFile::begin(const Opening& opening) const {
  std::vector<Launch> launches;
  for (const auto& g : grains_of(*this)) {
    if (opening.dimensions == 2 && g.place[2] != 0)
      throw InputError(fmt::format(
          "grains.start.from: {}: its grains do not lie in a plane z = 0; needs dimensions = 3", from));
    launches.push_back({g.place, g.velocity, g.spin, g.radius, g.orientation, g.mass, g.material});
    const double height = g.place[static_cast<std::size_t>(opening.dimensions) - 1];
    if (!above || height > *above) launches.back().velocity[0] += velocity;
  }
  return launches;
}

}  // namespace chute::starts
