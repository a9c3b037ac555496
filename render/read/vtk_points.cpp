#include "read/vtk_points.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkDataSetAttributes.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPImageDataReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <istream>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <streambuf>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/fields.hpp"
#include "read/image_data.hpp"
#include "read/legacy_vtk.hpp"
#include "read/vtk_complaints.hpp"
#include "read/vtk_process.hpp"
#include "read/xml_check.hpp"

namespace chute::read {
namespace {

using Wanted = std::function<bool(std::string_view)>;

/// Bytes in memory as a stream.
class Memory : public std::streambuf {
 public:
  explicit Memory(std::string& bytes) { setg(bytes.data(), bytes.data(), bytes.data() + bytes.size()); }

 private:
  pos_type seekoff(off_type by, std::ios_base::seekdir from, std::ios_base::openmode) override {
    const char* const base = from == std::ios_base::beg   ? eback()
                             : from == std::ios_base::cur ? gptr()
                                                          : egptr();
    const off_type to = base - eback() + by;
    if (to < 0 || to > egptr() - eback()) return pos_type(off_type(-1));
    setg(eback(), eback() + to, egptr());
    return to;
  }
  pos_type seekpos(pos_type to, std::ios_base::openmode mode) override {
    return seekoff(to, std::ios_base::beg, mode);
  }
};

/// VTK's reader keeps two copies of a string that it reads; of a million grains these are 300 MB. This one reads
/// where the bytes are.
template <class Reader>
class InPlace : public Reader {
 public:
  static InPlace* New() { VTK_STANDARD_NEW_BODY(InPlace); }
  vtkAbstractTypeMacro(InPlace, Reader);
  void read(std::string& bytes) {
    memory_.emplace(bytes), stream_.emplace(&*memory_);
    this->ReadFromInputStringOn();
  }

 protected:
  int OpenVTKString() override {
    stream_->clear();
    stream_->seekg(0);
    this->Stream = &*stream_;
    return 1;
  }
  void CloseVTKString() override {}

 private:
  std::optional<Memory> memory_;
  std::optional<std::istream> stream_;
};

template <class Reader>
vtkSmartPointer<vtkPointSet> read_xml(std::string& bytes, const Wanted& wanted,
                                      std::vector<std::string>& names) {
  vtkNew<InPlace<Reader>> reader;
  reader->read(bytes);
  reader->UpdateInformation();
  auto* arrays = reader->GetPointDataArraySelection();
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i) {
    names.emplace_back(arrays->GetArrayName(i));
    if (!wanted(names.back())) arrays->DisableArray(names.back().c_str());
  }
  reader->Update();
  return reader->GetErrorCode() == 0 ? vtkPointSet::SafeDownCast(reader->GetOutputAsDataSet()) : nullptr;
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
PointSet copied(vtkPointSet* set) {
  PointSet result;
  const auto count = static_cast<std::size_t>(set->GetNumberOfPoints());
  result.x.resize(count), result.y.resize(count), result.z.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    double p[3];
    set->GetPoint(static_cast<vtkIdType>(i), p);
    result.x[i] = p[0], result.y[i] = p[1], result.z[i] = p[2];
  }
  result.cells_in_all = static_cast<std::size_t>(set->GetNumberOfCells());
  result.point_arrays = arrays_of(set->GetPointData());
  result.cell_arrays = arrays_of(set->GetCellData());
  result.field_arrays = arrays_of(set->GetFieldData());
  for (int i = 0; i < set->GetFieldData()->GetNumberOfArrays(); ++i) {
    auto* text = vtkStringArray::SafeDownCast(set->GetFieldData()->GetAbstractArray(i));
    if (text && text->GetName() && text->GetNumberOfValues() > 0)
      result.field_texts.emplace_back(text->GetName(), text->GetValue(0));
  }
  // A polygonal file of grains has a vertex for each, which come first and tell nothing.
  auto* polygonal = vtkPolyData::SafeDownCast(set);
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = polygonal ? polygonal->GetNumberOfVerts() : 0; i < set->GetNumberOfCells(); ++i) {
    set->GetCellPoints(i, corners);
    if (corners->GetNumberOfIds() < 2) continue;
    auto& cell = result.cells.emplace_back();
    cell.number = static_cast<std::size_t>(i);
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k) {
      cell.corners.push_back(static_cast<std::size_t>(corners->GetId(k)));
      if (cell.corners.back() >= count)
        throw std::runtime_error("a line or polygon has a corner that is not there");
    }
  }
  return result;
}

/// Throws std::runtime_error that says what is wrong.
PointSet parse_xml(std::string& bytes, bool polydata, const Wanted& wanted) {
  if (const auto fault = xml_fault(bytes); !fault.empty()) throw std::runtime_error(fault);
  const Listening listening;
  std::vector<std::string> names;
  const auto set = polydata ? read_xml<vtkXMLPolyDataReader>(bytes, wanted, names)
                            : read_xml<vtkXMLUnstructuredGridReader>(bytes, wanted, names);
  if (!Listening::complaint().empty()) throw std::runtime_error(Listening::complaint());
  if (!set) throw std::runtime_error("VTK cannot read it");
  auto result = copied(set);
  result.point_names = std::move(names);
  return result;
}

/// Types of files of VTK's own that other readers than those here take. Image data are fields.
bool is_vtk_type(std::string_view type) {
  constexpr std::string_view known[] = {"StructuredGrid",
                                        "RectilinearGrid",
                                        "PStructuredGrid",
                                        "PRectilinearGrid",
                                        "PPolyData",
                                        "PUnstructuredGrid",
                                        "vtkMultiBlockDataSet",
                                        "vtkPartitionedDataSet",
                                        "vtkPartitionedDataSetCollection"};
  return std::find(std::begin(known), std::end(known), type) != std::end(known);
}

/// The grid that VTK has read, with its fields.
ImageData copied(vtkImageData* data) {
  ImageData result;
  int extent[6];
  data->GetExtent(extent);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto count = static_cast<long long>(extent[2 * k + 1]) - extent[2 * k] + 1;
    if (count > std::numeric_limits<int>::max()) throw std::runtime_error("its grid has too many points");
    result.points[k] = static_cast<int>(count);
    result.spacing[k] = data->GetSpacing()[k];
    result.origin[k] = data->GetOrigin()[k] + extent[2 * k] * result.spacing[k];
  }
  result.cell_arrays = arrays_of(data->GetCellData());
  result.point_arrays = arrays_of(data->GetPointData());
  auto* facts = data->GetFieldData();
  if (auto* time = vtkDataArray::SafeDownCast(facts->GetAbstractArray(fields::time_value.data()));
      time && time->GetNumberOfValues() > 0)
    result.time = time->GetTuple1(0);
  const auto text = [&](std::string_view name) {
    auto* found = vtkStringArray::SafeDownCast(facts->GetAbstractArray(name.data()));
    return found && found->GetNumberOfValues() > 0 ? std::string(found->GetValue(0)) : std::string();
  };
  result.units = text(fields::units), result.clock = text(fields::clock);
  return result;
}

/// Throws InputError if there are more or fewer values than places for them.
void check_size(const ImageData& data, const std::filesystem::path& path) {
  std::size_t points = 1, cells = 1;
  for (const int n : data.points)
    points *= static_cast<std::size_t>(n), cells *= static_cast<std::size_t>(std::max(1, n - 1));
  const auto check = [&](const std::vector<PointArray>& arrays, std::size_t count) {
    for (const auto& a : arrays)
      if (a.values.size() != count * static_cast<std::size_t>(a.components))
        throw InputError(fmt::format("{}: damaged or cut short: array \"{}\" does not fit the grid",
                                     path.string(), a.name));
  };
  check(data.cell_arrays, cells);
  check(data.point_arrays, points);
}

PointSet only(PointSet set, const Wanted& wanted) {
  std::erase_if(set.point_arrays, [&](const PointArray& array) { return !wanted(array.name); });
  return set;
}

/// A legacy file has to be read from end to end; what is not wanted is dropped.
PointSet parse_legacy(std::string_view bytes, const Wanted& wanted) {
  auto result = parse_legacy_vtk(bytes);
  for (const auto& array : result.point_arrays) result.point_names.push_back(array.name);
  std::erase_if(result.point_arrays, [&](const PointArray& array) { return !wanted(array.name); });
  return result;
}

}  // namespace

PointSet parse_vtk(std::string bytes, const std::filesystem::path& path, const Wanted& wanted) {
  const auto fail = [&](const std::string& what) { throw InputError(path.string() + ": " + what); };
  if (bytes.empty()) fail("the file is empty");
  const auto [is_xml, type] = xml_head(bytes);
  const bool other = is_xml && type != "PolyData" && type != "UnstructuredGrid";
  if (other && is_vtk_type(type) && has_vtk_process())
    return only(read_by_vtk(path, named_files(bytes)), wanted);
  if (other) fail(fmt::format("a VTK file of type \"{}\", expected PolyData or UnstructuredGrid", type));
  if (!is_xml && !bytes.starts_with("# vtk DataFile")) fail("not a VTK file");
  if (is_xml) bytes.resize(without_tail(bytes).size());
  PointSet result;
  try {
    result = is_xml ? parse_xml(bytes, type == "PolyData", wanted) : parse_legacy(bytes, wanted);
  } catch (const NotTaken& error) {
    if (has_vtk_process()) return only(read_by_vtk(path), wanted);
    fail(error.what());
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

PointSet parse_vtk(std::vector<FileBytes> parts, const Wanted& wanted) {
  PointSet whole;
  for (auto& file : parts) {
    auto part = parse_vtk(std::move(file.bytes), file.path, wanted);
    if (part.x.empty() && &file != &parts.front()) continue;
    if (whole.x.empty()) {
      whole = std::move(part);
      continue;
    }
    const std::size_t before = whole.x.size(), cells_before = whole.cells_in_all;
    for (auto [into, from] : {std::pair{&whole.x, &part.x}, {&whole.y, &part.y}, {&whole.z, &part.z}})
      into->insert(into->end(), from->begin(), from->end());
    const auto join = [](std::vector<PointArray>& into, const std::vector<PointArray>& from) {
      std::erase_if(into, [&](PointArray& array) {
        const auto other = std::find_if(from.begin(), from.end(), [&](const PointArray& b) {
          return b.name == array.name && b.components == array.components;
        });
        if (other == from.end()) return true;
        array.values.insert(array.values.end(), other->values.begin(), other->values.end());
        return false;
      });
    };
    join(whole.point_arrays, part.point_arrays);
    join(whole.cell_arrays, part.cell_arrays);
    std::erase_if(whole.point_names, [&](const std::string& name) {
      return std::find(part.point_names.begin(), part.point_names.end(), name) == part.point_names.end();
    });
    for (auto& cell : part.cells) {
      cell.number += cells_before;
      for (auto& corner : cell.corners) corner += before;
      whole.cells.push_back(std::move(cell));
    }
    whole.cells_in_all += part.cells_in_all;
  }
  return whole;
}

ImageData parse_image_data(std::string bytes, const std::filesystem::path& path) {
  const auto fail = [&](const std::string& what) { throw InputError(path.string() + ": " + what); };
  if (bytes.empty()) fail("the file is empty");
  const auto [is_xml, type] = xml_head(bytes);
  ImageData result;
  if (type == "PImageData" && has_vtk_process()) {
    result = image_by_vtk(path, named_files(bytes));
    check_size(result, path);
    return result;
  }
  if (type != "ImageData")
    fail(is_xml ? fmt::format("a VTK file of type \"{}\", expected ImageData", type)
                : "not a VTK file of image data (.vti)");
  bytes.resize(without_tail(bytes).size());
  if (const auto fault = xml_fault(bytes); !fault.empty()) fail("damaged or cut short: " + fault);
  try {
    const Listening listening;
    vtkNew<InPlace<vtkXMLImageDataReader>> reader;
    reader->read(bytes);
    reader->Update();
    auto* data = vtkImageData::SafeDownCast(reader->GetOutputAsDataSet());
    if (!Listening::complaint().empty()) throw std::runtime_error(Listening::complaint());
    if (reader->GetErrorCode() != 0 || !data) throw std::runtime_error("VTK cannot read it");
    result = copied(data);
  } catch (const std::bad_alloc&) {
    fail("damaged: it asks for more memory than there is");
  } catch (const std::runtime_error& error) {
    fail(fmt::format("damaged or cut short: {}", error.what()));
  }
  check_size(result, path);
  return result;
}

ImageData read_image_pieces(const std::filesystem::path& path) {
  const Listening listening;
  vtkNew<vtkXMLPImageDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  if (!Listening::complaint().empty()) throw std::runtime_error(Listening::complaint());
  auto* data = vtkImageData::SafeDownCast(reader->GetOutputAsDataSet());
  if (reader->GetErrorCode() != 0 || !data) throw std::runtime_error("VTK cannot read it");
  auto result = copied(data);
  // Which cells a piece repeats for its neighbours' sake is no field of the whole.
  for (auto* arrays : {&result.cell_arrays, &result.point_arrays})
    std::erase_if(*arrays, [](const PointArray& array) {
      return array.name == vtkDataSetAttributes::GhostArrayName();
    });
  return result;
}

}  // namespace chute::read
