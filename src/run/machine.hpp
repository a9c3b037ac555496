#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace chute::run {

/// What the scene would take beyond this machine, a sentence for each: memory, by its method's own estimate (the fact
/// "memory"), against that of the machine or of what the process may have of it; disk, against what is free where the
/// run is to lie. Nothing if it fits, or if nobody knows.
std::vector<std::string> beyond_machine(const scene::Scene& scene, const std::filesystem::path& directory);

/// InputError with the first of them, after the name of the scene's file.
void refuse_beyond_machine(const scene::Scene& scene, const std::string& name,
                           const std::filesystem::path& directory);

}  // namespace chute::run
