#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>

namespace chute {
class Temporary;
}
namespace chute::io {

/// What a checkpoint says of itself.
struct CheckpointHead {
  std::string scene;    ///< the complete one it belongs to
  std::string program;  ///< that wrote it: name, version, build
};

/// Bytes that somebody writes when they are asked for, and how many there will be.
struct Written {
  std::uint64_t size = 0;
  std::function<void(std::ostream&)> write;
};

/// A checkpoint: a magic word, its head, its grains as a VTK file has them (so that other scenes and methods can start from
/// them), the state of engine and observers, and at the end a hash of all that. Grains and state are written straight into
/// the file, so that large runs need no second copy in memory. WorkError that names the file if it cannot be written.
void write_checkpoint(const std::filesystem::path& path, const CheckpointHead& head, const Written& grains,
                      const std::function<void(std::ostream&)>& save);
/// The same, written but not yet in its place.
Temporary made_checkpoint(const std::filesystem::path& path, const CheckpointHead& head,
                          const Written& grains, const std::function<void(std::ostream&)>& save);

/// A checkpoint that was found whole. Its state is read from the file while somebody reads the stream, which ends with it.
struct Checkpoint {
  std::string program;  ///< that wrote it
  std::string scene;    ///< the complete one it belongs to
  std::unique_ptr<std::istream> state;
};
/// InputError if the file is missing, truncated or damaged.
Checkpoint read_checkpoint(const std::filesystem::path& path);
/// InputError if the file is missing, truncated or damaged.
void check_checkpoint(const std::filesystem::path& path);
/// The grains, as bytes of a VTK file, whatever the scene.
std::string read_checkpoint_grains(const std::filesystem::path& path);

}  // namespace chute::io
