#include "read/vtk_points.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <new>
#include <stdexcept>

#include "common/error.hpp"
#include "read/legacy_vtk.hpp"
#include "read/xml_check.hpp"

namespace chute::read {
namespace {

/// Where VTK sends its complaints: kept, not printed.
class Complaints : public vtkOutputWindow {
 public:
  static Complaints* New();
  vtkTypeMacro(Complaints, vtkOutputWindow);
  void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override { keep(text); }
  void DisplayWarningText(const char*) override {}
  void DisplayGenericWarningText(const char*) override {}
  void DisplayDebugText(const char*) override {}
  std::string first;

 private:
  void keep(const char* text) {
    if (!first.empty()) return;
    // "ERROR: In FILE, line N\nvtkClass (0x…): what is wrong\n"
    std::string_view what = text;
    if (what.starts_with("ERROR:")) what.remove_prefix(std::min(what.find('\n') + 1, what.size()));
    if (const auto address = what.find("): "); what.starts_with("vtk") && address != std::string_view::npos)
      what.remove_prefix(address + 3);
    for (char c : what) first += c == '\n' || c == '\r' ? ' ' : c;
    first.erase(first.find_last_not_of(" .") + 1);
    if (first.empty()) first = "VTK cannot read it";
    if (first.size() > 160) first = first.substr(0, 157) + "...";
  }
};
vtkStandardNewMacro(Complaints);

/// Sends VTK's complaints to `kept` while it lives. Its logger would print them as well.
struct Listening {
  vtkSmartPointer<vtkOutputWindow> before = vtkOutputWindow::GetInstance();
  vtkLogger::Verbosity verbosity = vtkLogger::GetCurrentVerbosityCutoff();
  vtkNew<Complaints> kept;
  Listening() {
    vtkOutputWindow::SetInstance(kept);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ~Listening() {
    vtkOutputWindow::SetInstance(before);
    vtkLogger::SetStderrVerbosity(verbosity);
  }
};

template <class Reader>
vtkSmartPointer<vtkPointSet> read_xml(std::string& bytes) {
  vtkNew<Reader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(bytes);
  reader->Update();
  return reader->GetErrorCode() == 0 ? vtkPointSet::SafeDownCast(reader->GetOutputAsDataSet()) : nullptr;
}

/// The value of attribute `type` of the element VTKFile, empty if the text does not start like a VTK XML
/// file.
std::string_view xml_type(std::string_view text) {
  const auto start = text.substr(0, 4096).find("<VTKFile");
  if (start == std::string_view::npos) return {};
  const auto element = text.substr(start, text.find('>', start) - start);
  const auto type = element.find("type=\"");
  if (type == std::string_view::npos) return {};
  const auto value = element.substr(type + 6);
  return value.substr(0, value.find('"'));
}

std::vector<PointArray> arrays_of(vtkFieldData* data) {
  std::vector<PointArray> arrays;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    auto* array = vtkDataArray::SafeDownCast(data->GetAbstractArray(i));
    if (!array || !array->GetName()) continue;
    PointArray& copy = arrays.emplace_back();
    copy.name = array->GetName();
    copy.components = array->GetNumberOfComponents();
    copy.values.resize(static_cast<std::size_t>(array->GetNumberOfValues()));
    for (vtkIdType k = 0; k < array->GetNumberOfTuples(); ++k)
      array->GetTuple(k, copy.values.data() + k * copy.components);
  }
  return arrays;
}

/// The arrays, points and lines of what VTK has read.
VtkPoints copied(vtkPointSet* set) {
  VtkPoints result;
  const auto count = static_cast<std::size_t>(set->GetNumberOfPoints());
  result.x.resize(count), result.y.resize(count), result.z.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    double p[3];
    set->GetPoint(static_cast<vtkIdType>(i), p);
    result.x[i] = p[0], result.y[i] = p[1], result.z[i] = p[2];
  }
  result.point_arrays = arrays_of(set->GetPointData());
  result.cell_arrays = arrays_of(set->GetCellData());
  result.field_arrays = arrays_of(set->GetFieldData());
  for (int i = 0; i < set->GetFieldData()->GetNumberOfArrays(); ++i) {
    auto* text = vtkStringArray::SafeDownCast(set->GetFieldData()->GetAbstractArray(i));
    if (text && text->GetName() && text->GetNumberOfValues() > 0)
      result.field_texts.emplace_back(text->GetName(), text->GetValue(0));
  }
  vtkNew<vtkIdList> cell;
  for (vtkIdType i = 0; i < set->GetNumberOfCells(); ++i) {
    set->GetCellPoints(i, cell);
    if (cell->GetNumberOfIds() != 2) continue;
    const auto a = static_cast<std::size_t>(cell->GetId(0)), b = static_cast<std::size_t>(cell->GetId(1));
    if (a >= count || b >= count) throw std::runtime_error("a line ends at a point that is not there");
    result.lines.push_back({a, b});
    result.line_cells.push_back(static_cast<std::size_t>(i));
  }
  return result;
}

/// Throws std::runtime_error that says what is wrong.
VtkPoints parse_xml(std::string& bytes, bool polydata) {
  if (const auto fault = xml_fault(bytes); !fault.empty()) throw std::runtime_error(fault);
  Listening listening;
  const auto set =
      polydata ? read_xml<vtkXMLPolyDataReader>(bytes) : read_xml<vtkXMLUnstructuredGridReader>(bytes);
  if (!listening.kept->first.empty()) throw std::runtime_error(listening.kept->first);
  if (!set) throw std::runtime_error("VTK cannot read it");
  return copied(set);
}

}  // namespace

VtkPoints parse_vtk(std::string bytes, const std::filesystem::path& path) {
  const auto fail = [&](const std::string& what) { throw InputError(path.string() + ": " + what); };
  if (bytes.empty()) fail("the file is empty");
  const std::string type(xml_type(bytes));
  if (!type.empty() && type != "PolyData" && type != "UnstructuredGrid")
    fail(fmt::format("a VTK file of type {}, expected PolyData or UnstructuredGrid", type));
  if (type.empty() && !bytes.starts_with("# vtk DataFile")) fail("not a VTK file");
  VtkPoints result;
  try {
    result = type.empty() ? parse_legacy_vtk(bytes) : parse_xml(bytes, type == "PolyData");
  } catch (const std::bad_alloc&) {
    fail("damaged: it asks for more memory than there is");
  } catch (const std::runtime_error& error) {
    fail(fmt::format("damaged or cut short: {}", error.what()));
  }
  for (const auto& array : result.point_arrays)
    if (array.values.size() != result.x.size() * static_cast<std::size_t>(array.components))
      fail(fmt::format("damaged or cut short: array \"{}\" does not fit the number of points", array.name));
  return result;
}

}  // namespace chute::read
