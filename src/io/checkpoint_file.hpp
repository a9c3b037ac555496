#pragma once
#include <filesystem>
#include <string>

namespace chute::io {

/// A checkpoint is a header (magic word, length, CRC-32 of everything that follows, the scene it belongs to) and the
/// state of engine and observers.
void write_checkpoint(const std::filesystem::path& path, const std::string& scene, const std::string& state);

/// The state. InputError if the file is missing, truncated, damaged, or belongs to another scene.
std::string read_checkpoint(const std::filesystem::path& path, const std::string& scene);

}  // namespace chute::io
