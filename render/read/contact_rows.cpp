#include "read/contact_rows.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/fields.hpp"
#include "read/vtk_points.hpp"

namespace chute::read {
namespace {

const PointArray& array_of(const PointSet& set, const fields::Field& field, int components,
                           const std::filesystem::path& path) {
  for (const auto& array : set.cell_arrays)
    if (array.name == field.name && array.components == components) return array;
  throw InputError(fmt::format("{}: no cell array \"{}\" of {} components, which chute's contacts have",
                               path.string(), field.name, components));
}

}  // namespace

std::vector<ContactRow> read_contact_rows(const std::filesystem::path& path) {
  const PointSet set = parse_vtk(read_file(path), path);
  std::vector<ContactRow> rows;
  for (const auto& cell : set.cells)
    if (cell.corners.size() == 2) rows.emplace_back();
  if (rows.empty()) return rows;
  const auto scalar = [&](const fields::Field& field, auto ContactRow::*member) {
    const auto& array = array_of(set, field, 1, path);
    std::size_t at = 0;
    for (const auto& cell : set.cells)
      if (cell.corners.size() == 2) {
        auto& to = rows[at++].*member;
        to = static_cast<std::remove_reference_t<decltype(to)>>(array.at(cell.number));
      }
  };
  const auto vector = [&](const fields::Field& field, std::array<double, 3> ContactRow::*member) {
    const auto& array = array_of(set, field, 3, path);
    std::size_t at = 0;
    for (const auto& cell : set.cells)
      if (cell.corners.size() == 2) {
        for (int k = 0; k < 3; ++k)
          (rows[at].*member)[static_cast<std::size_t>(k)] = array.at(cell.number, k);
        ++at;
      }
  };
  scalar(fields::contact_a, &ContactRow::a);
  scalar(fields::contact_b, &ContactRow::b);
  vector(fields::point, &ContactRow::point);
  vector(fields::normal, &ContactRow::normal);
  vector(fields::branch, &ContactRow::branch);
  vector(fields::force, &ContactRow::force);
  scalar(fields::overlap, &ContactRow::overlap);
  scalar(fields::normal_force, &ContactRow::normal_force);
  scalar(fields::shear_force, &ContactRow::shear_force);
  scalar(fields::state, &ContactRow::state);
  return rows;
}

}  // namespace chute::read
