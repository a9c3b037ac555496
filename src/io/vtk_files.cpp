#include "io/vtk_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkLongLongArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>

#include "common/error.hpp"
#include "common/fields.hpp"
#include "common/material_names.hpp"
#include "vtk/fill.hpp"

namespace chute::io {
namespace {

using vtk::add_array;
using vtk::add_numbers;
using vtk::add_text;
using vtk::add_vertices;

void add_facts(vtkPolyData* data, const RunFacts& facts) {
  add_text(data->GetFieldData(), fields::units, facts.units);
  if (facts.clock != "time") add_text(data->GetFieldData(), fields::clock, facts.clock);
  add_numbers(data->GetFieldData(), fields::domain, facts.domain);
  add_numbers(data->GetFieldData(), fields::gravity, facts.gravity);
}

std::string bytes(vtkPolyData* data, Packing packing = Packing::compressed) {
  return vtk::bytes(data, packing == Packing::compressed);
}

/// A field of the grains. Vectors and turns have three components in files whatever the dimension: of a vector in the
/// plane the third is 0, and a turn about the plane's normal is the third.
void add_field(vtkDataSetAttributes* to, const FieldView& field, std::size_t count) {
  const auto name = field.what.file->name;
  if (!field.words.empty())
    return add_array<vtkIntArray>(to, name, count, 1, [&](std::size_t i, int) { return field.words[i]; });
  const int own = static_cast<int>(field.numbers.size());
  const bool spatial = field.what.kind == FieldKind::vector || field.what.kind == FieldKind::turn;
  const int shift = field.what.kind == FieldKind::turn ? 3 - own : 0;
  add_array<vtkDoubleArray>(to, name, count, spatial ? 3 : own, [&](std::size_t i, int k) {
    const int c = k - shift;
    return c >= 0 && c < own ? field.numbers[static_cast<std::size_t>(c)][i] : 0;
  });
}

}  // namespace

std::string grains_vtp(const GrainsView& grains, const RunFacts& facts, Packing packing) {
  vtkNew<vtkPolyData> data;
  const std::size_t n = grains.size();
  add_vertices(data, n, [&](std::size_t i) { return grains.place(i); });
  auto* to = data->GetPointData();
  add_array<vtkLongLongArray>(to, fields::id.name, n, 1, [&](std::size_t i, int) { return grains.id_of(i); });
  add_array<vtkIntArray>(to, fields::type.name, n, 1,
                         [&](std::size_t i, int) { return i < grains.moving ? 1 : 0; });
  for (const auto& field : grains.fields) add_field(to, field, n);
  add_array<vtkDoubleArray>(to, fields::force.name, n, 3, [&](std::size_t i, int k) {
    const auto& column = grains.force[static_cast<std::size_t>(k)];
    return column.empty() ? 0 : column[i];
  });
  add_numbers(data->GetFieldData(), fields::time_value, std::array{grains.time});
  add_facts(data, facts);
  if (!facts.materials.empty())
    add_text(data->GetFieldData(), fields::materials, fmt::format("{}", fmt::join(facts.materials, ",")));
  return bytes(data, packing);
}

std::string impacts_vtp(std::span<const Impact> impacts, const RunFacts& facts) {
  vtkNew<vtkPolyData> data;
  const std::size_t n = impacts.size();
  add_vertices(data, n, [&](std::size_t i) { return impacts[i].place; });
  auto* to = data->GetPointData();
  const auto number = [&](const fields::Field& field, double Impact::*member) {
    add_array<vtkDoubleArray>(to, field.name, n, 1, [&](std::size_t i, int) { return impacts[i].*member; });
  };
  number(fields::time, &Impact::time);
  number(fields::gamma, &Impact::gamma);
  number(fields::phi, &Impact::phi);
  number(fields::v_n, &Impact::v_n);
  number(fields::v_t, &Impact::v_t);
  number(fields::flight, &Impact::flight);
  number(fields::gamma_before, &Impact::gamma_before);
  add_array<vtkIntArray>(to, fields::rolling.name, n, 1,
                         [&](std::size_t i, int) { return impacts[i].rolling ? 1 : 0; });
  add_array<vtkLongLongArray>(to, fields::bead.name, n, 1,
                              [&](std::size_t i, int) { return impacts[i].bead; });
  add_array<vtkLongLongArray>(to, fields::grain.name, n, 1,
                              [&](std::size_t i, int) { return impacts[i].grain; });
  add_facts(data, facts);
  return bytes(data);
}

std::string contacts_vtp(const GrainsView& grains, std::span<const Contact> contacts, const RunFacts& facts) {
  vtkNew<vtkPolyData> data;
  const std::size_t n = contacts.size();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  for (const auto& contact : contacts) {
    const auto from = grains.place(static_cast<std::size_t>(contact.a));
    std::array<double, 3> to{};
    for (std::size_t k = 0; k < 3; ++k) to[k] = from[k] + contact.branch[k];
    const std::array<vtkIdType, 2> ends{points->InsertNextPoint(from.data()),
                                        points->InsertNextPoint(to.data())};
    lines->InsertNextCell(2, ends.data());
  }
  data->SetPoints(points);
  data->SetLines(lines);
  auto* to = data->GetCellData();
  const auto number = [&](const fields::Field& field, double Contact::*member) {
    add_array<vtkDoubleArray>(to, field.name, n, 1, [&](std::size_t i, int) { return contacts[i].*member; });
  };
  const auto vector = [&](const fields::Field& field, std::array<double, 3> Contact::*member) {
    add_array<vtkDoubleArray>(to, field.name, n, 3, [&](std::size_t i, int k) {
      return (contacts[i].*member)[static_cast<std::size_t>(k)];
    });
  };
  const auto id_of = [&](std::int64_t k) {
    return is_wall(k) ? k : grains.id_of(static_cast<std::size_t>(k));
  };
  add_array<vtkLongLongArray>(to, fields::contact_a.name, n, 1,
                              [&](std::size_t i, int) { return id_of(contacts[i].a); });
  add_array<vtkLongLongArray>(to, fields::contact_b.name, n, 1,
                              [&](std::size_t i, int) { return id_of(contacts[i].b); });
  vector(fields::point, &Contact::point);
  vector(fields::normal, &Contact::normal);
  vector(fields::branch, &Contact::branch);
  number(fields::overlap, &Contact::overlap);
  vector(fields::force, &Contact::force);
  number(fields::normal_force, &Contact::normal_force);
  number(fields::shear_force, &Contact::shear_force);
  add_array<vtkIntArray>(to, fields::state.name, n, 1,
                         [&](std::size_t i, int) { return static_cast<int>(contacts[i].state); });
  if (std::ranges::any_of(contacts, [](const Contact& c) { return c.impulse_time > 0; })) {
    const auto impulse = [&](const fields::Field& field, double Contact::*force) {
      add_array<vtkDoubleArray>(to, field.name, n, 1, [&](std::size_t i, int) {
        return contacts[i].impulse_time * contacts[i].*force;
      });
    };
    impulse(fields::normal_impulse, &Contact::normal_force);
    impulse(fields::shear_impulse, &Contact::shear_force);
    number(fields::mobilisation, &Contact::mobilisation);
  }
  add_numbers(data->GetFieldData(), fields::time_value, std::array{grains.time});
  add_facts(data, facts);
  return bytes(data);
}

std::string walls_vtp(const RunFacts& facts) {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  std::vector<int> wall;
  for (const auto& face : facts.walls) {
    std::vector<vtkIdType> ids;
    for (const auto& corner : face.corners) ids.push_back(points->InsertNextPoint(corner.data()));
    cells->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
    wall.push_back(face.wall);
  }
  data->SetPoints(points);
  if (facts.dimensions == 2)
    data->SetLines(cells);
  else
    data->SetPolys(cells);
  add_array<vtkIntArray>(data->GetCellData(), fields::wall.name, wall.size(), 1,
                         [&](std::size_t i, int) { return wall[i]; });
  add_facts(data, facts);
  return bytes(data);
}

}  // namespace chute::io
