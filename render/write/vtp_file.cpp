#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkLongLongArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <array>

#include "common/error.hpp"
#include "common/fields.hpp"
#include "write/frame_fields.hpp"
#include "write/frame_file.hpp"

namespace chute::write {
namespace {

using Kind = FrameField::Kind;

template <class VtkArray, class Value>
void add_array(vtkPointData* to, const std::string& name, std::size_t count, int components,
               const Value& value) {
  vtkNew<VtkArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(count));
  for (std::size_t i = 0; i < count; ++i)
    for (int c = 0; c < components; ++c) array->SetTypedComponent(static_cast<vtkIdType>(i), c, value(i, c));
  to->AddArray(array);
}

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

template <std::size_t N>
void add_numbers(vtkPolyData* data, std::string_view name, const std::array<double, N>& values) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(std::string(name).c_str());
  for (const double v : values) array->InsertNextValue(v);
  data->GetFieldData()->AddArray(array);
}

void add_text(vtkPolyData* data, std::string_view name, const std::string& text) {
  vtkNew<vtkStringArray> array;
  array->SetName(std::string(name).c_str());
  array->InsertNextValue(text);
  data->GetFieldData()->AddArray(array);
}

void add_facts(vtkPolyData* data, const read::GrainFrame& frame, const FrameFacts& facts) {
  if (facts.time) add_numbers(data, fields::time_value, std::array{*facts.time});
  if (!frame.units.empty()) add_text(data, fields::units, frame.units);
  if (!frame.clock.empty()) add_text(data, fields::clock, frame.clock);
  std::array<double, 6> domain{};
  for (std::size_t k = 0; k < 3; ++k) {
    const int axis = static_cast<int>(k);
    if (frame.period(axis) == 0 || (axis == 2 && frame.dimensions == 2)) continue;
    domain[2 * k] = frame.domain.min()[axis], domain[2 * k + 1] = frame.domain.max()[axis];
  }
  add_numbers(data, fields::domain, domain);
  if (frame.own || frame.gravity.norm() > 0)
    add_numbers(data, fields::gravity, std::array{frame.gravity[0], frame.gravity[1], frame.gravity[2]});
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
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(frame.size()));
  vtkNew<vtkCellArray> vertices;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const auto id = static_cast<vtkIdType>(i);
    points->SetPoint(id, frame.x[i], frame.y[i], frame.z[i]);
    vertices->InsertNextCell(1, &id);
  }
  data->SetPoints(points);
  data->SetVerts(vertices);
  auto* to = data->GetPointData();
  const auto all = fields_of(frame);
  const bool has_material = find_field(all, fields::material.name);
  for (const auto& field : all) add_field(to, field, name_of(frame, field, has_material), frame.size());
  add_array<vtkDoubleArray>(to, std::string(fields::radius.name), frame.size(), 1,
                            [&](std::size_t i, int) { return frame.radius[i]; });
  add_facts(data, frame, facts);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->SetWriteToOutputString(true);
  if (!writer->Write()) throw WorkError("VTK could not encode a file: out of memory?");
  return writer->GetOutputString();
}

std::string time_index(const std::vector<std::pair<double, std::string>>& files) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (const auto& [time, name] : files)
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time, name);
  return text + "  </Collection>\n</VTKFile>\n";
}

}  // namespace chute::write
