#pragma once
#include <vtkCellArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <array>
#include <string>
#include <string_view>

#include "common/error.hpp"

/// Plain structs into VTK's data, and these into bytes.
namespace chute::vtk {

/// value(i, k) is component k of tuple i.
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
void add_numbers(vtkFieldData* to, std::string_view name, const std::array<double, N>& values) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(std::string(name).c_str());
  for (const double v : values) array->InsertNextValue(v);
  to->AddArray(array);
}

inline void add_text(vtkFieldData* to, std::string_view name, const std::string& text) {
  vtkNew<vtkStringArray> array;
  array->SetName(std::string(name).c_str());
  array->InsertNextValue(text);
  to->AddArray(array);
}

/// Points with one vertex cell each: some mappers draw only points that have one. place(i): three numbers.
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

/// A .vtp file. WorkError if there is no memory for it.
inline std::string bytes(vtkPolyData* data, bool compressed = true) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  if (compressed)
    writer->SetCompressorTypeToZLib();
  else
    writer->SetCompressorTypeToNone();
  writer->SetWriteToOutputString(true);
  if (!writer->Write()) throw WorkError("VTK could not encode a file: out of memory?");
  return writer->GetOutputString();
}

}  // namespace chute::vtk
