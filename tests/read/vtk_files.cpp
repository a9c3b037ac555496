#include "vtk_files.hpp"

#include <unistd.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cstdlib>

namespace vtk_files {
namespace {

void add(vtkFieldData* data, const std::string& name, const std::vector<double>& values, int components) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  for (double value : values) array->InsertNextValue(value);
  data->AddArray(array);
}

void add_arrays(const Content& content, vtkDataSet* set) {
  for (const auto& [name, values] : content.scalars) add(set->GetPointData(), name, values, 1);
  for (const auto& [name, values] : content.vectors) add(set->GetPointData(), name, values, 3);
  const auto cells = static_cast<std::size_t>(set->GetNumberOfCells());
  for (const auto& [name, values] : content.cells)
    add(set->GetCellData(), name, values, static_cast<int>(values.size() / std::max<std::size_t>(1, cells)));
  for (const auto& [name, values] : content.field)
    add(set->GetFieldData(), name, values, static_cast<int>(values.size()));
  if (!content.units.empty()) {
    vtkNew<vtkStringArray> text;
    text->SetName("units");
    text->InsertNextValue(content.units);
    set->GetFieldData()->AddArray(text);
  }
}

template <class Writer, class Set>
void write_with(Set* set, const std::filesystem::path& path) {
  vtkNew<Writer> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(set);
  writer->Write();
}

}  // namespace

Content three_grains() {
  Content c;
  c.points = {0.5, 0, 0, 1.5, 0.25, 0, 2.5, 1, 0};
  c.scalars = {{"radius", {0.5, 0.4, 0.3}}, {"type", {0, 1, 1}}, {"id", {0, 1, 2}}, {"angle", {0, 1, 2}}};
  c.vectors = {{"velocity", {0, 0, 0, 3, 4, 0, -1, 0, 0}}};
  c.field = {{"TimeValue", {2.5}}, {"domain", {0, 30, 0, 0, 0, 0}}, {"gravity", {0.6, -0.8, 0}}};
  c.units = "reduced";
  return c;
}

void write(const Content& content, const std::filesystem::path& path, Kind kind) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (std::size_t i = 0; i + 2 < content.points.size(); i += 3) points->InsertNextPoint(&content.points[i]);
  vtkNew<vtkCellArray> cells;
  if (content.lines.empty())
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) cells->InsertNextCell(1, &i);
  for (std::size_t i = 0; i + 1 < content.lines.size(); i += 2) {
    const vtkIdType pair[2] = {content.lines[i], content.lines[i + 1]};
    cells->InsertNextCell(2, pair);
  }
  if (kind == Kind::image) {
    vtkNew<vtkImageData> image;
    image->SetDimensions(2, 2, 1);
    return write_with<vtkXMLImageDataWriter>(image.Get(), path);
  }
  if (kind == Kind::unstructured) {
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(points);
    grid->SetCells(content.lines.empty() ? VTK_VERTEX : VTK_LINE, cells);
    add_arrays(content, grid);
    return write_with<vtkXMLUnstructuredGridWriter>(grid.Get(), path);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  if (!content.polygons.empty()) {
    vtkNew<vtkCellArray> polygons;
    for (const auto& corners : content.polygons) {
      const std::vector<vtkIdType> ids(corners.begin(), corners.end());
      polygons->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
    }
    data->SetPolys(polygons);
  } else {
    content.lines.empty() ? data->SetVerts(cells) : data->SetLines(cells);
  }
  add_arrays(content, data);
  if (kind == Kind::polydata) return write_with<vtkXMLPolyDataWriter>(data.Get(), path);
  vtkNew<vtkPolyDataWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(data);
  kind == Kind::legacy_ascii ? writer->SetFileTypeToASCII() : writer->SetFileTypeToBinary();
  writer->Write();
}

Folder::Folder() {
  auto pattern = (std::filesystem::temp_directory_path() / "chute-test-XXXXXX").string();
  path = ::mkdtemp(pattern.data());
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path, ignored);
}

}  // namespace vtk_files
