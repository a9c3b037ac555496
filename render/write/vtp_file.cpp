#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkLongLongArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <array>

#include "common/fields.hpp"
#include "vtk/fill.hpp"
#include "write/frame_fields.hpp"
#include "write/frame_file.hpp"

namespace chute::write {
namespace {

using Kind = FrameField::Kind;
using vtk::add_array;
using vtk::add_numbers;
using vtk::add_text;

void add_field(vtkPointData* to, const FrameField& field, const std::string& name, std::size_t count) {
  if (field.kind == Kind::words) {
    vtkNew<vtkStringArray> array;
    array->SetName(name.c_str());
    for (std::size_t i = 0; i < count; ++i) array->InsertNextValue(text_of(field, i, 0));
    to->AddArray(array);
    return;
  }
  const auto value = [&](std::size_t i, int c) { return field.array->at(i, c); };
  if (field.kind == Kind::whole)
    add_array<vtkLongLongArray>(to, name, count, field.components(),
                                [&](std::size_t i, int c) { return static_cast<long long>(value(i, c)); });
  else
    add_array<vtkDoubleArray>(to, name, count, field.components(), value);
}

void add_facts(vtkPolyData* data, const read::GrainFrame& frame, const FrameFacts& facts) {
  if (facts.time) add_numbers(data->GetFieldData(), fields::time_value, std::array{*facts.time});
  if (!frame.units.empty()) add_text(data->GetFieldData(), fields::units, frame.units);
  if (!frame.clock.empty()) add_text(data->GetFieldData(), fields::clock, frame.clock);
  std::array<double, 6> domain{};
  for (std::size_t k = 0; k < 3; ++k) {
    const int axis = static_cast<int>(k);
    if (frame.period(axis) == 0 || (axis == 2 && frame.dimensions == 2)) continue;
    domain[2 * k] = frame.domain.min()[axis], domain[2 * k + 1] = frame.domain.max()[axis];
  }
  add_numbers(data->GetFieldData(), fields::domain, domain);
  if (frame.own || frame.gravity.norm() > 0)
    add_numbers(data->GetFieldData(), fields::gravity,
                std::array{frame.gravity[0], frame.gravity[1], frame.gravity[2]});
}

/// With its domain a file is one of chute's own, whose type 0 is the bed. Other programs' types are species; a dump that was
/// made of chute's frames has these beside, as `material`.
std::string name_of(const read::GrainFrame& frame, const FrameField& field, bool has_material) {
  if (frame.own || has_material || field.name != fields::type.name || field.kind != Kind::whole)
    return field.name;
  for (const double type : field.array->values)
    if (type == 0) return std::string(fields::material.name);
  return field.name;
}

}  // namespace

std::string vtp_frame(const read::GrainFrame& frame, const FrameFacts& facts) {
  vtkNew<vtkPolyData> data;
  vtk::add_vertices(data, frame.size(), [&](std::size_t i) {
    return std::array{frame.x[i], frame.y[i], frame.z[i]};
  });
  auto* to = data->GetPointData();
  const auto all = fields_of(frame);
  const bool has_material = find_field(all, fields::material.name);
  for (const auto& field : all) add_field(to, field, name_of(frame, field, has_material), frame.size());
  add_array<vtkDoubleArray>(to, fields::radius.name, frame.size(), 1,
                            [&](std::size_t i, int) { return frame.radius[i]; });
  add_facts(data, frame, facts);
  return vtk::bytes(data);
}

}  // namespace chute::write
