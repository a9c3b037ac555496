#include "read/contact_rows.hpp"

#include <fmt/format.h>

#include <cmath>
#include <type_traits>

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

constexpr double largest_number = 2e9;  // of a grain or a state: whatever is larger is no number of one

/// Forces need not be known. The first partner is a grain.
void check(const ContactRow& row, std::size_t number, const std::filesystem::path& path) {
  double sum = row.overlap;
  for (std::size_t k = 0; k < 3; ++k) sum += row.point[k] + row.normal[k] + row.branch[k];
  if (row.a < 0) throw InputError(fmt::format("{}: contact {}: a is no grain", path.string(), number));
  if (!std::isfinite(sum))
    throw InputError(fmt::format("{}: contact {}: place, normal, branch or overlap is not a finite number",
                                 path.string(), number));
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
        const double value = array.at(cell.number);
        using Number = std::remove_reference_t<decltype(to)>;
        if (std::is_integral_v<Number> && !(std::abs(value) < largest_number))
          throw InputError(
              fmt::format("{}: contact {}: {} is no whole number", path.string(), at - 1, field.name));
        to = static_cast<Number>(value);
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
  for (std::size_t k = 0; k < rows.size(); ++k) check(rows[k], k, path);
  return rows;
}

}  // namespace chute::read
