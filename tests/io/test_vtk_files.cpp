#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <catch2/catch.hpp>

#include "folder.hpp"
#include "io/vtk_files.hpp"

using namespace chute;
using namespace chute::test;

namespace {

/// What VTK itself reads back.
vtkSmartPointer<vtkPolyData> read_back(const std::string& bytes) {
  const Folder folder;
  write(folder / "file.vtp", bytes);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder / "file.vtp").c_str());
  reader->Update();
  REQUIRE(reader->GetErrorCode() == 0);
  return reader->GetOutput();
}

struct Sample2D {
  std::vector<double> x{1.25, -2, 3}, y{0, 1, 2.5}, vx{1, 2, 0}, vy{-1, 0.1, 0}, fx{5, 6, 7}, fy{8, 9, 10},
      spin{-3, 4, 0}, angle{0.5, -7, 0}, radius{0.5, 0.25, 1}, mass{1, 2, 3}, inertia{1, 1, 1};
  GrainsView view() const {
    GrainsView v;
    v.dimensions = 2;
    v.time = 1.5;
    v.moving = 2;
    v.position = {x, y, std::span<const double>{}};
    v.velocity = {vx, vy, std::span<const double>{}};
    v.force = {fx, fy, std::span<const double>{}};
    v.spin[0] = spin;
    v.angle[0] = angle;
    v.radius = radius;
    v.mass = mass;
    v.inertia = inertia;
    return v;
  }
};

const io::RunFacts facts{"SI", {-1, 4, 0, 0, 0, 0}, {0.5, -0.25, 0}};

void check_facts(vtkPolyData* data) {
  auto* field = data->GetFieldData();
  auto* units = vtkStringArray::SafeDownCast(field->GetAbstractArray("units"));
  REQUIRE(units);
  CHECK(units->GetValue(0) == "SI");
  for (int k = 0; k < 6; ++k)
    CHECK(field->GetArray("domain")->GetComponent(k, 0) == facts.domain[static_cast<std::size_t>(k)]);
  for (int k = 0; k < 3; ++k)
    CHECK(field->GetArray("gravity")->GetComponent(k, 0) == facts.gravity[static_cast<std::size_t>(k)]);
}

}  // namespace

TEST_CASE("2D grains come back from VTK as they were, to the bit") {
  const Sample2D s;
  const auto data = read_back(io::grains_vtp(s.view(), facts));
  REQUIRE(data->GetNumberOfPoints() == 3);
  CHECK(data->GetNumberOfVerts() == 3);
  auto* arrays = data->GetPointData();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto id = static_cast<vtkIdType>(i);
    const auto value = [&](const char* name, int k = 0) {
      INFO(name);
      REQUIRE(arrays->GetArray(name));
      return arrays->GetArray(name)->GetComponent(id, k);
    };
    CHECK(data->GetPoint(id)[0] == s.x[i]);
    CHECK(data->GetPoint(id)[1] == s.y[i]);
    CHECK(data->GetPoint(id)[2] == 0);
    CHECK(value("id") == i);
    CHECK(value("type") == (i < 2 ? 1 : 0));
    CHECK(value("radius") == s.radius[i]);
    CHECK(value("mass") == s.mass[i]);
    CHECK(value("velocity", 0) == s.vx[i]);
    CHECK(value("velocity", 1) == s.vy[i]);
    CHECK(value("velocity", 2) == 0);
    CHECK(value("angular_velocity", 0) == 0);
    CHECK(value("angular_velocity", 1) == 0);
    CHECK(value("angular_velocity", 2) == s.spin[i]);
    CHECK(value("angle") == s.angle[i]);
    CHECK(value("force", 0) == s.fx[i]);
    CHECK(value("force", 1) == s.fy[i]);
    CHECK(value("force", 2) == 0);
  }
  CHECK(data->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0) == 1.5);
  check_facts(data);
}

TEST_CASE("3D grains keep their third components") {
  Sample2D s;
  const std::vector<double> z{9, 8, 7}, w0{1, 2, 3}, w1{4, 5, 6};
  auto view = s.view();
  view.dimensions = 3;
  view.position[2] = view.velocity[2] = view.force[2] = z;
  view.spin = {w0, w1, z};
  const auto data = read_back(io::grains_vtp(view, facts));
  for (vtkIdType i = 0; i < 3; ++i) {
    CHECK(data->GetPoint(i)[2] == z[static_cast<std::size_t>(i)]);
    auto* spin = data->GetPointData()->GetArray("angular_velocity");
    CHECK(spin->GetComponent(i, 0) == w0[static_cast<std::size_t>(i)]);
    CHECK(spin->GetComponent(i, 1) == w1[static_cast<std::size_t>(i)]);
    CHECK(spin->GetComponent(i, 2) == z[static_cast<std::size_t>(i)]);
  }
  CHECK(data->GetPointData()->GetArray("angle") == nullptr);
}

TEST_CASE("impacts come back from VTK as they were") {
  std::vector<Impact> impacts(2);
  impacts[0] = {1.25, 7, 3, {0.1, 0.2, 0.3}, 0.4, -0.5, -0.6, 0.7, 0.01, -0.3, true};
  impacts[1] = {2.5, 8, 4, {1, 2, 3}, -0.4, 0.5, -1.6, -0.7};
  const auto data = read_back(io::impacts_vtp(impacts, facts));
  REQUIRE(data->GetNumberOfPoints() == 2);
  for (vtkIdType i = 0; i < 2; ++i) {
    const auto& impact = impacts[static_cast<std::size_t>(i)];
    const auto value = [&](const char* name) {
      return data->GetPointData()->GetArray(name)->GetComponent(i, 0);
    };
    CHECK(value("time") == impact.time);
    CHECK(value("gamma") == impact.gamma);
    CHECK(value("phi") == impact.phi);
    CHECK(value("v_n") == impact.v_n);
    CHECK(value("v_t") == impact.v_t);
    CHECK((std::isnan(impact.flight) ? std::isnan(value("flight")) : value("flight") == impact.flight));
    CHECK((i == 0 ? value("gamma_before") == -0.3 : std::isnan(value("gamma_before"))));
    CHECK(value("rolling") == impact.rolling);
    CHECK(value("bead") == static_cast<double>(impact.bead));
    CHECK(value("grain") == static_cast<double>(impact.grain));
    for (int k = 0; k < 3; ++k) CHECK(data->GetPoint(i)[k] == impact.place[static_cast<std::size_t>(k)]);
  }
  check_facts(data);
  CHECK(read_back(io::impacts_vtp({}, facts))->GetNumberOfPoints() == 0);
}

TEST_CASE("contacts are lines between nearest images") {
  Sample2D s;
  s.x = {-0.9, 3.8, 1};
  s.y = {1, 1, 1.5};
  const std::vector<ContactRecord> contacts{{0, 1, 0.01, 5, -2}, {0, 2, 0.02, 6, 3}};
  const auto data = read_back(io::contacts_vtp(s.view(), contacts, facts));
  REQUIRE(data->GetNumberOfLines() == 2);
  auto* lines = data->GetLines();
  lines->InitTraversal();
  for (vtkIdType c = 0; c < 2; ++c) {
    vtkIdType count = 0;
    const vtkIdType* ends = nullptr;
    lines->GetNextCell(count, ends);
    REQUIRE(count == 2);
    const double from = data->GetPoint(ends[0])[0], to = data->GetPoint(ends[1])[0];
    CHECK(from == -0.9);
    CHECK(to == Approx(c == 0 ? 3.8 - 5 : 1));  // across the period, not through the whole domain
    const auto& contact = contacts[static_cast<std::size_t>(c)];
    const auto value = [&](const char* name) {
      return data->GetCellData()->GetArray(name)->GetComponent(c, 0);
    };
    CHECK(value("normal_force") == contact.normal_force);
    CHECK(value("shear_force") == contact.shear_force);
    CHECK(value("overlap") == contact.overlap);
  }
  CHECK(data->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0) == 1.5);
  check_facts(data);
  CHECK(read_back(io::contacts_vtp(s.view(), {}, facts))->GetNumberOfLines() == 0);
}

TEST_CASE("files are binary, compressed, and the same bytes each time") {
  const Sample2D s;
  const auto bytes = io::grains_vtp(s.view(), facts);
  CHECK(bytes == io::grains_vtp(s.view(), facts));
  CHECK(bytes.find("format=\"appended\"") != bytes.npos);
  CHECK(bytes.find("vtkZLibDataCompressor") != bytes.npos);
  CHECK(bytes.find("encoding=\"raw\"") != bytes.npos);
}

TEST_CASE("the time index names every file with its time") {
  const std::vector<double> times{0, 0.1, 1e-7};
  const std::vector<std::string> files{"frames/000000.vtp", "frames/000001.vtp", "frames/000002.vtp"};
  const auto text = io::pvd(times, files);
  CHECK(text.find("<DataSet timestep=\"0.1\" part=\"0\" file=\"frames/000001.vtp\"/>") != text.npos);
  CHECK(text.find("<DataSet timestep=\"1e-07\" part=\"0\" file=\"frames/000002.vtp\"/>") != text.npos);
}
