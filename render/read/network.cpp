#include "read/contacts.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "read/vtk_points.hpp"

namespace chute::read {

std::vector<Contact> parse_contacts(std::string bytes, const std::filesystem::path& path) {
  const VtkPoints points = parse_vtk(std::move(bytes), path);
  const PointArray* force = nullptr;
  for (const char* name : {"force", "normal_force", "Force", "normalForce", "forceNormal"})
    for (const auto& array : points.cell_arrays)
      if (array.name == name && !force) force = &array;
  if (points.lines.empty()) return {};
  if (!force)
    throw InputError(path.string() +
                     ": no cell array \"force\" or \"normal_force\", the strength of each contact");
  std::vector<Contact> contacts;
  contacts.reserve(points.lines.size());
  for (std::size_t i = 0; i < points.lines.size(); ++i) {
    const auto [a, b] = points.lines[i];
    double squared = 0;
    for (int c = 0; c < force->components; ++c) squared += std::pow(force->at(points.line_cells[i], c), 2);
    const Contact contact{
        {points.x[a], points.y[a], points.z[a]}, {points.x[b], points.y[b], points.z[b]}, std::sqrt(squared)};
    for (double value : {contact.from[0], contact.from[1], contact.from[2], contact.to[0], contact.to[1],
                         contact.to[2], contact.force})
      if (!std::isfinite(value))
        throw InputError(fmt::format("{}: contact {}: a value is not a finite number", path.string(), i));
    contacts.push_back(contact);
  }
  return contacts;
}

std::vector<Contact> read_contacts(const std::filesystem::path& path) {
  return parse_contacts(read_file(path), path);
}

}  // namespace chute::read
