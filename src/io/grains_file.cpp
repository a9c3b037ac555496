#include "io/grains_file.hpp"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkDataSetReader.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/vector.hpp>
#include <regex>
#include <sstream>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/fields.hpp"
#include "common/in_child.hpp"

namespace chute::io {

template <class Archive>
static void serialize(Archive& a, GrainRecord& g) {
  a(g.place, g.velocity, g.spin, g.radius, g.mass, g.orientation, g.material);
}

namespace {

vtkDataArray* array_of(vtkDataSet* data, const fields::Field& field, int components) {
  auto* array = data->GetPointData()->GetArray(std::string(field.name).c_str());
  return array && array->GetNumberOfComponents() == components ? array : nullptr;
}

std::vector<GrainRecord> records_of(vtkDataSet* data, const std::string& name) {
  auto* radius = data ? array_of(data, fields::radius, 1) : nullptr;
  if (!radius) throw InputError(name + ": no grains: its points have no array radius");
  if (array_of(data, fields::body, 1) && data->GetFieldData()->HasArray(std::string(fields::units).c_str()))
    throw InputError(name + ": its grains are not round; only round ones can be started from");
  auto *type = array_of(data, fields::type, 1), *mass = array_of(data, fields::mass, 1),
       *velocity = array_of(data, fields::velocity, 3), *spin = array_of(data, fields::angular_velocity, 3),
       *angle = array_of(data, fields::angle, 1), *orientation = array_of(data, fields::orientation, 4),
       *material = array_of(data, fields::material, 1);
  std::vector<GrainRecord> grains;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    if (type && type->GetComponent(i, 0) == 0) continue;  // fixed: the bed is the scene's own
    GrainRecord& g = grains.emplace_back();
    data->GetPoint(i, g.place.data());
    g.radius = radius->GetComponent(i, 0);
    if (mass) g.mass = mass->GetComponent(i, 0);
    if (velocity) velocity->GetTuple(i, g.velocity.data());
    if (spin) spin->GetTuple(i, g.spin.data());
    if (orientation) orientation->GetTuple(i, g.orientation.emplace().data());
    if (angle) g.orientation = {angle->GetComponent(i, 0), 0, 0, 0};
    if (material) g.material = static_cast<int>(material->GetComponent(i, 0));
  }
  return grains;
}

/// What a reader of VTK's makes of a file, as bytes for the parent process.
template <class Reader>
std::string read_with(Reader* reader, const std::string& name) {
  vtkObject::GlobalWarningDisplayOff();
  reader->Update();
  if (reader->GetErrorCode() != 0)
    throw InputError(name + ": cannot be read: truncated, damaged or no VTK file");
  auto grains = records_of(reader->GetOutput(), name);
  std::ostringstream bytes;
  cereal::PortableBinaryOutputArchive archive(bytes);
  archive(grains);
  return std::move(bytes).str();
}

std::vector<GrainRecord> from_child(const std::function<std::string()>& work, const std::string& name) {
  std::istringstream bytes(
      in_child(work, name + ": cannot be read: it is damaged, and VTK's reader failed on it"));
  cereal::PortableBinaryInputArchive archive(bytes);
  std::vector<GrainRecord> grains;
  archive(grains);
  if (grains.empty()) throw InputError(name + ": holds no moving grains");
  for (const auto& g : grains)
    if (!(g.radius > 0) ||
        !std::isfinite(g.place[0] + g.place[1] + g.place[2] + g.velocity[0] + g.velocity[1] + g.velocity[2]))
      throw InputError(name + ": a grain has no radius, or a place or velocity that is not a number");
  return grains;
}

}  // namespace

std::vector<GrainRecord> read_grains(const std::filesystem::path& file) {
  const auto name = file.string();
  if (!std::filesystem::is_regular_file(file)) throw InputError(name + ": no such file");
  const auto read = [&](auto* reader) {
    reader->SetFileName(name.c_str());
    return read_with(reader, name);
  };
  return from_child(
      [&]() -> std::string {
        if (file.extension() == ".vtu") return read(vtkNew<vtkXMLUnstructuredGridReader>().Get());
        if (file.extension() == ".vtk") return read(vtkNew<vtkDataSetReader>().Get());
        return read(vtkNew<vtkXMLPolyDataReader>().Get());
      },
      name);
}

std::vector<GrainRecord> parse_grains(const std::string& bytes, const std::string& name) {
  return from_child(
      [&] {
        vtkNew<vtkXMLPolyDataReader> reader;
        reader->ReadFromInputStringOn();
        reader->SetInputString(bytes);
        return read_with(reader.Get(), name);
      },
      name);
}

std::vector<std::pair<double, std::filesystem::path>> read_pvd(const std::filesystem::path& file) {
  const auto text = read_file(file);
  static const std::regex entry("timestep=\"([^\"]*)\"[^>]*file=\"([^\"]*)\"");
  std::vector<std::pair<double, std::filesystem::path>> files;
  for (std::sregex_iterator at(text.begin(), text.end(), entry), end; at != end; ++at)
    files.emplace_back(std::stod((*at)[1]), file.parent_path() / (*at)[2].str());
  if (files.empty()) throw InputError(file.string() + ": names no frames");
  return files;
}

}  // namespace chute::io
