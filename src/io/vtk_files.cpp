#include "io/vtk_files.hpp"

#include <fmt/format.h>
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

#include <cmath>

#include "common/error.hpp"
#include "common/fields.hpp"

namespace chute::io {
namespace {

template <class VtkArray, class Value>
void add_array(vtkDataSetAttributes* to, std::string_view name, std::size_t count, int components,
               Value&& value) {
  vtkNew<VtkArray> array;
  array->SetName(std::string(name).c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(count));
  for (std::size_t i = 0; i < count; ++i)
    for (int k = 0; k < components; ++k) array->SetTypedComponent(static_cast<vtkIdType>(i), k, value(i, k));
  to->AddArray(array);
}

template <std::size_t N>
void add_numbers(vtkPolyData* data, std::string_view name, const std::array<double, N>& values) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(std::string(name).c_str());
  for (double v : values) array->InsertNextValue(v);
  data->GetFieldData()->AddArray(array);
}

void add_facts(vtkPolyData* data, const RunFacts& facts) {
  vtkNew<vtkStringArray> units;
  units->SetName(std::string(fields::units).c_str());
  units->InsertNextValue(facts.units);
  data->GetFieldData()->AddArray(units);
  add_numbers(data, fields::domain, facts.domain);
  add_numbers(data, fields::gravity, facts.gravity);
}

/// Points with one vertex cell each: some mappers draw only points that have one.
template <class Place>
void add_vertices(vtkPolyData* data, std::size_t count, Place&& place) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(count));
  vtkNew<vtkCellArray> vertices;
  vertices->AllocateExact(static_cast<vtkIdType>(count), static_cast<vtkIdType>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const auto id = static_cast<vtkIdType>(i);
    const std::array<double, 3> r = place(i);
    points->SetPoint(id, r.data());
    vertices->InsertNextCell(1, &id);
  }
  data->SetPoints(points);
  data->SetVerts(vertices);
}

std::string bytes(vtkPolyData* data) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->SetWriteToOutputString(true);
  if (!writer->Write()) throw WorkError("VTK could not encode a file: out of memory?");
  return writer->GetOutputString();
}

double component(const std::array<std::span<const double>, 3>& field, std::size_t i, int k) {
  const auto& column = field[static_cast<std::size_t>(k)];
  return column.empty() ? 0 : column[i];
}

}  // namespace

std::string grains_vtp(const GrainsView& grains, const RunFacts& facts) {
  vtkNew<vtkPolyData> data;
  const std::size_t n = grains.size();
  const auto place = [&](std::size_t i) {
    return std::array{component(grains.position, i, 0), component(grains.position, i, 1),
                      component(grains.position, i, 2)};
  };
  add_vertices(data, n, place);
  auto* to = data->GetPointData();
  const bool flat = grains.dimensions == 2;
  // A turn about the plane's normal is the z component of the files' vectors.
  const auto turn = [&](const auto& field, std::size_t i, int k) {
    return flat ? (k == 2 ? field[0][i] : 0) : field[static_cast<std::size_t>(k)][i];
  };
  add_array<vtkLongLongArray>(to, fields::id.name, n, 1, [](std::size_t i, int) { return i; });
  add_array<vtkIntArray>(to, fields::type.name, n, 1,
                         [&](std::size_t i, int) { return i < grains.moving ? 1 : 0; });
  add_array<vtkDoubleArray>(to, fields::radius.name, n, 1,
                            [&](std::size_t i, int) { return grains.radius[i]; });
  add_array<vtkDoubleArray>(to, fields::mass.name, n, 1, [&](std::size_t i, int) { return grains.mass[i]; });
  add_array<vtkDoubleArray>(to, fields::velocity.name, n, 3,
                            [&](std::size_t i, int k) { return component(grains.velocity, i, k); });
  add_array<vtkDoubleArray>(to, fields::angular_velocity.name, n, 3,
                            [&](std::size_t i, int k) { return turn(grains.spin, i, k); });
  if (flat)
    add_array<vtkDoubleArray>(to, fields::angle.name, n, 1,
                              [&](std::size_t i, int) { return grains.angle[0][i]; });
  add_array<vtkDoubleArray>(to, fields::force.name, n, 3,
                            [&](std::size_t i, int k) { return component(grains.force, i, k); });
  add_numbers(data, fields::time_value, std::array{grains.time});
  add_facts(data, facts);
  return bytes(data);
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

std::string contacts_vtp(const GrainsView& grains, std::span<const ContactRecord> contacts,
                         const RunFacts& facts) {
  vtkNew<vtkPolyData> data;
  const std::size_t n = contacts.size();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  for (const auto& contact : contacts) {
    std::array<double, 3> from{}, to{};
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      from[axis] = component(grains.position, static_cast<std::size_t>(contact.i), k);
      to[axis] = component(grains.position, static_cast<std::size_t>(contact.j), k);
      const double length = facts.domain[2 * axis + 1] - facts.domain[2 * axis];
      if (length > 0) to[axis] -= length * std::round((to[axis] - from[axis]) / length);
    }
    const std::array<vtkIdType, 2> ends{points->InsertNextPoint(from.data()),
                                        points->InsertNextPoint(to.data())};
    lines->InsertNextCell(2, ends.data());
  }
  data->SetPoints(points);
  data->SetLines(lines);
  auto* to = data->GetCellData();
  const auto number = [&](const char* name, double ContactRecord::*member) {
    add_array<vtkDoubleArray>(to, name, n, 1, [&](std::size_t i, int) { return contacts[i].*member; });
  };
  number("normal_force", &ContactRecord::normal_force);
  number("shear_force", &ContactRecord::shear_force);
  number("overlap", &ContactRecord::overlap);
  add_numbers(data, fields::time_value, std::array{grains.time});
  add_facts(data, facts);
  return bytes(data);
}

std::string pvd(std::span<const double> times, std::span<const std::string> files) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (std::size_t i = 0; i < files.size(); ++i)
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", times[i], files[i]);
  return text + "  </Collection>\n</VTKFile>\n";
}

}  // namespace chute::io
