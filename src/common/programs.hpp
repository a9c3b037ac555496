#pragma once
#include <filesystem>
#include <string>

namespace chute {

/// Where a program of that name is found in PATH; empty if nowhere.
std::filesystem::path find_program(const std::string& name);

}  // namespace chute
