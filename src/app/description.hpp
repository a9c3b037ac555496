#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>

namespace chute::app {

/// What a run directory, a VTK file or a table holds, as `chute info --json` prints it (README.md names the keys). InputError if
/// it is none of these, or damaged.
nlohmann::ordered_json describe_file(const std::filesystem::path& path);

}  // namespace chute::app
