#include "io/checkpoint_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include "common/atomic_file.hpp"
#include "common/error.hpp"

namespace chute::io {
namespace {

constexpr std::string_view magic = "chute checkpoint 1\n";

std::uint32_t checksum(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const std::string& scene, const std::string& state) {
  const std::string body = scene + state;
  write_atomically(path, fmt::format("{}{:016x}{:016x}{:08x}\n", magic, scene.size(), state.size(),
                                     checksum(body)) +
                             body);
}

std::string read_checkpoint(const std::filesystem::path& path, const std::string& scene) {
  const std::string content = read_file(path);
  const auto fail = [&](std::string_view what) {
    throw InputError(fmt::format("{}: {}", path.string(), what));
  };
  constexpr std::size_t header = magic.size() + 16 + 16 + 8 + 1;
  if (content.size() < header || !content.starts_with(magic)) fail("not a checkpoint of this version of chute");
  const auto number = [&](std::size_t at, std::size_t digits) {
    return std::stoull(content.substr(magic.size() + at, digits), nullptr, 16);
  };
  std::size_t scene_size = 0, state_size = 0;
  std::uint32_t sum = 0;
  try {
    scene_size = number(0, 16);
    state_size = number(16, 16);
    sum = static_cast<std::uint32_t>(number(32, 8));
  } catch (const std::exception&) {
    fail("damaged header");
  }
  if (content.size() - header != scene_size + state_size) fail("truncated");
  const std::string_view body = std::string_view(content).substr(header);
  if (checksum(body) != sum) fail("damaged: its checksum does not match");
  if (body.substr(0, scene_size) != scene) fail("belongs to another scene");
  return std::string(body.substr(scene_size));
}

}  // namespace chute::io
