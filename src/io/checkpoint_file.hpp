#pragma once
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>

namespace chute::io {

/// A checkpoint: a magic word, the scene it belongs to, its grains as a VTK file has them (so that other scenes and
/// methods can start from them), the state of engine and observers, and at the end a hash of all that. `save` writes the
/// state straight into the file, so that large runs need no second copy in memory.
void write_checkpoint(const std::filesystem::path& path, const std::string& scene, const std::string& grains,
                      const std::function<void(std::ostream&)>& save);

/// The state. InputError if the file is missing, truncated, damaged, or belongs to another scene.
std::string read_checkpoint(const std::filesystem::path& path, const std::string& scene);
/// The grains, as bytes of a VTK file, whatever the scene.
std::string read_checkpoint_grains(const std::filesystem::path& path);

}  // namespace chute::io
