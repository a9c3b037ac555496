#include "read/network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/fields.hpp"
#include "read/vtk_points.hpp"

namespace chute::read {

std::vector<ForceLink> parse_network(std::string bytes, const std::filesystem::path& path) {
  const PointSet points = parse_vtk(std::move(bytes), path);
  const PointArray* strength = nullptr;
  for (const std::string_view name :
       {fields::normal_force.name, fields::force.name, std::string_view("Force"),
        std::string_view("normalForce"), std::string_view("forceNormal")})
    for (const auto& array : points.cell_arrays)
      if (array.name == name && !strength) strength = &array;
  std::vector<ForceLink> links;
  for (const auto& cell : points.cells) {
    if (cell.corners.size() != 2) continue;
    if (!strength)
      throw InputError(path.string() +
                       ": no cell array \"normal_force\" or \"force\", the strength of each contact");
    const auto place = [&](std::size_t i) -> Eigen::Vector3d {
      return {points.x[i], points.y[i], points.z[i]};
    };
    const auto values = static_cast<std::size_t>(strength->components);
    const Eigen::Map<const Eigen::VectorXd> force(&strength->values[cell.number * values],
                                                  strength->components);
    const ForceLink link{place(cell.corners[0]), place(cell.corners[1]), force.norm()};
    if (!link.from.allFinite() || !link.to.allFinite() || !std::isfinite(link.force))
      throw InputError(
          fmt::format("{}: contact {}: a value is not a finite number", path.string(), links.size()));
    links.push_back(link);
  }
  return links;
}

std::vector<ForceLink> read_network(const std::filesystem::path& path) {
  return parse_network(read_file(path), path);
}

}  // namespace chute::read
