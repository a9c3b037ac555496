#include "io/cells_file.hpp"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkXMLImageDataWriter.h>

#include "common/error.hpp"
#include "common/fields.hpp"
#include "vtk/fill.hpp"

namespace chute::io {
std::string cells_vti(const CellFields& cells, const RunFacts& facts) {
  vtkNew<vtkImageData> data;
  // A grid one cell thick lies in a plane: VTK takes one layer of points for that.
  std::array<int, 3> points{};
  for (std::size_t k = 0; k < 3; ++k) points[k] = k == 2 && facts.dimensions == 2 ? 1 : cells.count[k] + 1;
  data->SetDimensions(points.data());
  data->SetOrigin(cells.origin.data());
  data->SetSpacing(cells.side.data());
  for (const auto& field : cells.fields) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(field.name.c_str());
    array->SetNumberOfComponents(field.components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(field.values.size()) / field.components);
    for (std::size_t i = 0; i < field.values.size(); ++i)
      array->SetValue(static_cast<vtkIdType>(i), field.values[i]);
    data->GetCellData()->AddArray(array);
  }
  vtk::add_text(data->GetFieldData(), fields::units, facts.units);
  if (facts.clock != "time") vtk::add_text(data->GetFieldData(), fields::clock, facts.clock);
  vtk::add_numbers(data->GetFieldData(), fields::time_value, std::array{cells.time});
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(data);
  writer->SetWriteToOutputString(true);
  if (!writer->Write()) throw WorkError("VTK could not encode a file of cells: out of memory?");
  return writer->GetOutputString();
}

}  // namespace chute::io
