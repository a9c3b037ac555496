#include "read/vtk_any.hpp"

#include <fmt/format.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDataSet.h>
#include <vtkDataSetAttributes.h>
#include <vtkFieldData.h>
#include <vtkGenericDataObjectReader.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLGenericDataObjectReader.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "read/vtk_complaints.hpp"

namespace chute::read {
namespace {

vtkSmartPointer<vtkDataObject> read_object(const std::filesystem::path& path) {
  std::string begin(16, '\0');
  std::ifstream(path, std::ios::binary).read(begin.data(), static_cast<std::streamsize>(begin.size()));
  if (begin.starts_with("# vtk DataFile")) {
    vtkNew<vtkGenericDataObjectReader> reader;
    reader->SetFileName(path.c_str());
    reader->ReadAllScalarsOn(), reader->ReadAllVectorsOn(), reader->ReadAllFieldsOn(),
        reader->ReadAllTensorsOn();
    reader->ReadAllNormalsOn(), reader->ReadAllTCoordsOn(), reader->ReadAllColorScalarsOn();
    reader->Update();
    return reader->GetOutput();
  }
  vtkNew<vtkXMLGenericDataObjectReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// Puts parts together. An array that a part with points lacks, or has with other components, is left out.
class Gathering {
 public:
  void take(vtkDataSet* part) {
    const auto points = part->GetNumberOfPoints();
    set.cells_in_all += static_cast<std::size_t>(part->GetNumberOfCells());
    if (first_) take_facts(part->GetFieldData());
    first_ = false;
    if (points == 0) return;
    auto* ghosts = vtkUnsignedCharArray::SafeDownCast(
        part->GetPointData()->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()));
    std::vector<vtkIdType> kept;
    for (vtkIdType i = 0; i < points; ++i) {
      constexpr int repeated = vtkDataSetAttributes::DUPLICATEPOINT | vtkDataSetAttributes::HIDDENPOINT;
      if (ghosts && i < ghosts->GetNumberOfValues() && (ghosts->GetValue(i) & repeated)) continue;
      kept.push_back(i);
      double p[3];
      part->GetPoint(i, p);
      set.x.push_back(p[0]), set.y.push_back(p[1]), set.z.push_back(p[2]);
    }
    auto arrays = arrays_of(part->GetPointData(), points, kept);
    if (set.point_arrays.empty() && !any_) {
      set.point_arrays = std::move(arrays);
    } else {
      std::erase_if(set.point_arrays, [&](PointArray& array) {
        const auto other = std::find_if(arrays.begin(), arrays.end(), [&](const PointArray& a) {
          return a.name == array.name && a.components == array.components &&
                 a.words.empty() == array.words.empty();
        });
        if (other == arrays.end()) return true;
        join(array, *other);
        return false;
      });
    }
    any_ = true;
  }

  PointSet set;

 private:
  bool first_ = true, any_ = false;

  static void join(PointArray& into, const PointArray& from) {
    for (const double value : from.values) {
      if (from.words.empty()) {
        into.values.push_back(value);
        continue;
      }
      const auto& word = from.words[static_cast<std::size_t>(value)];
      auto found = std::find(into.words.begin(), into.words.end(), word);
      if (found == into.words.end()) found = into.words.insert(into.words.end(), word);
      into.values.push_back(static_cast<double>(found - into.words.begin()));
    }
  }

  static std::vector<PointArray> arrays_of(vtkFieldData* data, vtkIdType points,
                                           const std::vector<vtkIdType>& kept) {
    std::vector<PointArray> arrays;
    for (int k = 0; k < data->GetNumberOfArrays(); ++k) {
      auto* any = data->GetAbstractArray(k);
      if (!any->GetName() || any->GetNumberOfTuples() != points) continue;
      PointArray copy{any->GetName(), any->GetNumberOfComponents(), {}};
      if (auto* numbers = vtkDataArray::SafeDownCast(any)) {
        std::vector<double> tuple(static_cast<std::size_t>(copy.components));
        for (const auto i : kept) {
          numbers->GetTuple(i, tuple.data());
          copy.values.insert(copy.values.end(), tuple.begin(), tuple.end());
        }
      } else if (auto* texts = vtkStringArray::SafeDownCast(any); texts && copy.components == 1) {
        for (const auto i : kept) {
          const std::string word = texts->GetValue(i);
          auto found = std::find(copy.words.begin(), copy.words.end(), word);
          if (found == copy.words.end()) found = copy.words.insert(copy.words.end(), word);
          copy.values.push_back(static_cast<double>(found - copy.words.begin()));
        }
      } else {
        continue;
      }
      arrays.push_back(std::move(copy));
    }
    return arrays;
  }

  void take_facts(vtkFieldData* data) {
    for (int k = 0; data && k < data->GetNumberOfArrays(); ++k) {
      auto* any = data->GetAbstractArray(k);
      if (!any->GetName() || any->GetNumberOfValues() == 0) continue;
      if (auto* texts = vtkStringArray::SafeDownCast(any))
        set.field_texts.emplace_back(any->GetName(), texts->GetValue(0));
      auto* numbers = vtkDataArray::SafeDownCast(any);
      if (!numbers) continue;
      PointArray copy{any->GetName(), any->GetNumberOfComponents(), {}};
      copy.values.resize(static_cast<std::size_t>(any->GetNumberOfValues()));
      for (vtkIdType i = 0; i < numbers->GetNumberOfTuples(); ++i)
        numbers->GetTuple(i, copy.values.data() + i * copy.components);
      set.field_arrays.push_back(std::move(copy));
    }
  }
};

}  // namespace

PointSet read_any_vtk(const std::filesystem::path& path) {
  const Listening listening;
  const auto object = read_object(path);
  if (!Listening::complaint().empty()) throw std::runtime_error(Listening::complaint());
  if (!object) throw std::runtime_error("VTK cannot read it");
  Gathering gathering;
  if (auto* part = vtkDataSet::SafeDownCast(object)) {
    gathering.take(part);
  } else if (auto* parts = vtkCompositeDataSet::SafeDownCast(object)) {
    const auto leaf = vtkSmartPointer<vtkCompositeDataIterator>::Take(parts->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
      if (auto* one = vtkDataSet::SafeDownCast(leaf->GetCurrentDataObject())) gathering.take(one);
  } else {
    throw std::runtime_error(fmt::format("a {}, which has no points", object->GetClassName()));
  }
  for (const auto& array : gathering.set.point_arrays) gathering.set.point_names.push_back(array.name);
  return std::move(gathering.set);
}

}  // namespace chute::read
