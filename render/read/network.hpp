#pragma once
#include <array>
#include <filesystem>
#include <vector>

namespace chute::read {

/// A contact: where its two grains are, and the magnitude of the force between them in the file's unit.
struct Contact {
  std::array<double, 3> from, to;
  double force;
};

/// Reads a contact network: VTK lines of two points each with a cell array `force` or `normal_force` (a
/// vector counts with its length). An empty network is fine. InputError, one line that names the file, as
/// read_frame.
std::vector<Contact> read_contacts(const std::filesystem::path& path);
std::vector<Contact> parse_contacts(std::string bytes, const std::filesystem::path& path);

}  // namespace chute::read
