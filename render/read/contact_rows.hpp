#pragma once
#include <array>
#include <filesystem>
#include <vector>

namespace chute::read {

/// A contact with all that chute's files tell of it: see common/fields.hpp.
struct ContactRow {
  long long a = 0, b = 0;
  std::array<double, 3> point{}, normal{}, branch{}, force{};
  double overlap = 0, normal_force = 0, shear_force = 0;
  int state = 0;
};

/// Reads a contact network (contacts/NNNNNN.vtp). InputError, one line that names the file, as read_frame; also if it lacks
/// the array of one of these.
std::vector<ContactRow> read_contact_rows(const std::filesystem::path& path);

}  // namespace chute::read
