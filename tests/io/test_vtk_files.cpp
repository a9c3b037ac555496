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
#include <sstream>

#include "common/error.hpp"
#include "common/pvd.hpp"
#include "core/random.hpp"
#include "folder.hpp"
#include "io/grains_file.hpp"
#include "io/plain_grains.hpp"
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

/// Two moving discs and a fixed one, and a view of them.
template <int D>
struct Sample {
  Grains<D> grains;
  std::array<Array, D> force;
  Domain<D> domain;
  Sample() {
    const double place[][3] = {{1.25, 0, 9}, {-2, 1, 8}, {3, 2.5, 7}},
                 velocity[][3] = {{1, -1, 9}, {2, 0.1, 8}, {0, 0, 7}};
    const double radius[] = {0.5, 0.25, 1};
    for (int i = 0; i < 3; ++i) {
      Vec<D> r;
      for (int k = 0; k < D; ++k) r[k] = place[i][k];
      grains.add(r, radius[i], i + 1, 1, i < 2);
      for (std::size_t k = 0; k < D; ++k) grains.velocity[k].back() = velocity[i][k];
      for (std::size_t k = 0; k < turns<D>; ++k)
        grains.spin[k].back() = i - 3.0 + 10.0 * static_cast<double>(k);
      for (std::size_t k = 0; k < orientation_numbers<D>; ++k)
        grains.orientation[k].back() = 0.5 * i - static_cast<double>(k);
      grains.material.back() = 7 - i;
      for (std::size_t k = 0; k < D; ++k) force[k].push_back(5 + i + 3.0 * static_cast<double>(k));
    }
  }
  GrainsView view() const { return view_of(grains, force, domain, 1.5); }
};

const io::RunFacts facts{"SI", 2, {-1, 4, 0, 0, 0, 0}, {0.5, -0.25, 0}, {}, {}};

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

TEMPLATE_TEST_CASE_SIG("grains come back from VTK as they were, to the bit", "", ((int D), D), 2, 3) {
  const Sample<D> s;
  const auto& g = s.grains;
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
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      CHECK(data->GetPoint(id)[k] == (k < D ? g.position[axis % D][i] : 0));
      CHECK(value("velocity", k) == (k < D ? g.velocity[axis % D][i] : 0));
      CHECK(value("force", k) == (k < D ? s.force[axis % D][i] : 0));
      CHECK(value("angular_velocity", k) == (D == 3   ? g.spin[axis % turns<D>][i]
                                             : k == 2 ? g.spin[0][i]
                                                      : 0));
    }
    CHECK(value("id") == i);
    CHECK(value("type") == (i < 2 ? 1 : 0));
    CHECK(value("radius") == g.radius[i]);
    CHECK(value("mass") == g.mass[i]);
    CHECK(value("material") == g.material[i]);
    for (int k = 0; k < orientation_numbers<D>; ++k)
      CHECK(value(D == 2 ? "angle" : "orientation", k) == g.orientation[static_cast<std::size_t>(k)][i]);
  }
  CHECK((arrays->GetArray("angle") == nullptr) == (D == 3));
  CHECK(data->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0) == 1.5);
  check_facts(data);
}

TEMPLATE_TEST_CASE_SIG("a start reads the moving grains of a file as they were written", "", ((int D), D), 2,
                       3) {
  const Sample<D> s;
  const auto& g = s.grains;
  const auto bytes = io::grains_vtp(s.view(), facts);
  const auto read = io::parse_grains(bytes, "grains.vtp");
  REQUIRE(read.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < D; ++k) {
      CHECK(read[i].place[k] == g.position[k][i]);
      CHECK(read[i].velocity[k] == g.velocity[k][i]);
    }
    CHECK(read[i].spin[2] == g.spin[turns<D> - 1][i]);
    REQUIRE(read[i].orientation);
    for (std::size_t k = 0; k < orientation_numbers<D>; ++k)
      CHECK((*read[i].orientation)[k] == g.orientation[k][i]);
    CHECK(read[i].radius == g.radius[i]);
    CHECK(read[i].mass == g.mass[i]);
    CHECK(read[i].material == g.material[i]);
  }
}

TEST_CASE("a file of grains that is damaged, or holds none, is refused in one line") {
  const auto bytes = io::grains_vtp(Sample<2>().view(), facts);
  for (const auto& damaged :
       {bytes.substr(0, bytes.size() / 2), std::string("no file of VTK's"), std::string()}) {
    const auto says = message<InputError>([&] { io::parse_grains(damaged, "grains.vtp"); });
    CHECK(says.starts_with("grains.vtp: "));
    CHECK(says.find('\n') == says.npos);
  }
  CHECK(message<InputError>([&] {
          io::parse_grains(io::impacts_vtp({}, facts), "impacts.vtp");
        }).starts_with("impacts.vtp: no grains"));
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

TEST_CASE("contacts are lines along their branches, with all that they tell") {
  const Sample<2> s;
  std::vector<Contact> contacts(2);
  contacts[0] = {0, 1, {1, 2, 0}, {0.6, 0.8, 0}, {-0.2, 1, 0}, 0.01, {3, 4, 0}, 5, -2, ContactState::slide};
  contacts[1] = {1, wall_id(2), {1, 2, 3}, {0, -1, 0}, {0, -0.5, 0}, 0.02, {0, -6, 0}, 6, 3};
  const auto data = read_back(io::contacts_vtp(s.view(), contacts, facts));
  REQUIRE(data->GetNumberOfLines() == 2);
  auto* lines = data->GetLines();
  lines->InitTraversal();
  for (vtkIdType c = 0; c < 2; ++c) {
    const auto& contact = contacts[static_cast<std::size_t>(c)];
    vtkIdType count = 0;
    const vtkIdType* ends = nullptr;
    lines->GetNextCell(count, ends);
    REQUIRE(count == 2);
    const auto value = [&](const char* name, int k = 0) {
      INFO(name);
      REQUIRE(data->GetCellData()->GetArray(name));
      return data->GetCellData()->GetArray(name)->GetComponent(c, k);
    };
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      CHECK(data->GetPoint(ends[0])[k] == s.view().place(static_cast<std::size_t>(contact.a))[axis]);
      CHECK(data->GetPoint(ends[1])[k] - data->GetPoint(ends[0])[k] == Approx(contact.branch[axis]));
      CHECK(value("point", k) == contact.point[axis]);
      CHECK(value("normal", k) == contact.normal[axis]);
      CHECK(value("branch", k) == contact.branch[axis]);
      CHECK(value("force", k) == contact.force[axis]);
    }
    CHECK(value("a") == static_cast<double>(contact.a));
    CHECK(value("b") == static_cast<double>(contact.b));
    CHECK(value("normal_force") == contact.normal_force);
    CHECK(value("shear_force") == contact.shear_force);
    CHECK(value("overlap") == contact.overlap);
    CHECK(value("state") == static_cast<int>(contact.state));
  }
  CHECK(data->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0) == 1.5);
  check_facts(data);
  CHECK(read_back(io::contacts_vtp(s.view(), {}, facts))->GetNumberOfLines() == 0);
}

TEST_CASE("a wall is drawn where it crosses the room") {
  const io::Room room{0, 4, 0, 2, -1, 3};
  const auto of = [](std::vector<io::WallFace> faces, int dimensions) {
    return io::RunFacts{"SI", dimensions, {}, {}, std::move(faces), {}};
  };
  const auto flat = read_back(io::walls_vtp(of(io::faces_of(Wall<3>{{{0, 0, 1}}, {{0, 0, 1}}}, 0, room), 3)));
  REQUIRE(flat->GetNumberOfPolys() == 1);
  REQUIRE(flat->GetNumberOfPoints() == 4);
  CHECK(flat->GetBounds()[0] == Approx(0).margin(1e-9));
  CHECK(flat->GetBounds()[1] == Approx(4));
  CHECK(flat->GetBounds()[3] == Approx(2));
  CHECK(flat->GetBounds()[4] == Approx(1));
  CHECK(flat->GetBounds()[5] == Approx(1));
  CHECK(io::faces_of(Wall<3>{{{0, 0, 9}}, {{0, 0, 1}}}, 0, room).empty());  // not in the room
  const auto line =
      read_back(io::walls_vtp(of(io::faces_of(Wall<2>{{}, {{-0.6, 0.8}}}, 0, {0, 2, -5, 5, 0, 0}), 2)));
  REQUIRE(line->GetNumberOfLines() == 1);
  CHECK(line->GetBounds()[1] == Approx(2));
  CHECK(line->GetBounds()[3] == Approx(1.5));

  Wall<2> segment{{{1, 1}}, {{0, 1}}};
  segment.outline = Segment{{{2, 0}}};
  const auto ending = read_back(io::walls_vtp(of(io::faces_of(segment, 0, {}), 2)));  // whatever the room
  CHECK(ending->GetBounds()[0] == Approx(-1));
  CHECK(ending->GetBounds()[1] == Approx(3));
  Wall<3> pipe{{{0, 0, 5}}};
  pipe.outline = Cylinder<3>{{{0, 1, 0}}, 2, 0};
  const auto staves = read_back(io::walls_vtp(of(io::faces_of(pipe, 0, {-1, 1, -3, 3, 4, 6}), 3)));
  CHECK(staves->GetNumberOfPolys() > 30);
  CHECK(staves->GetBounds()[4] == Approx(3).margin(1e-9));
  CHECK(staves->GetBounds()[5] == Approx(7).margin(1e-9));
  CHECK(staves->GetBounds()[2] == -3);  // as long as the room
  CHECK(staves->GetBounds()[3] == 3);
}

TEST_CASE("files are binary, compressed, and the same bytes each time") {
  const Sample<2> s;
  const auto bytes = io::grains_vtp(s.view(), facts);
  CHECK(bytes == io::grains_vtp(s.view(), facts));
  CHECK(bytes.find("format=\"appended\"") != bytes.npos);
  CHECK(bytes.find("vtkZLibDataCompressor") != bytes.npos);
  CHECK(bytes.find("encoding=\"raw\"") != bytes.npos);
}

TEST_CASE("the time index names every file with its time") {
  const std::vector<double> times{0, 0.1, 1e-7};
  const std::vector<std::string> files{"frames/000000.vtp", "frames/000001.vtp", "frames/000002.vtp"};
  const auto text = pvd(times, files);
  CHECK(text.find("<DataSet timestep=\"0.1\" part=\"0\" file=\"frames/000001.vtp\"/>") != text.npos);
  CHECK(text.find("<DataSet timestep=\"1e-07\" part=\"0\" file=\"frames/000002.vtp\"/>") != text.npos);
}

namespace {

/// The piecewise writer against VTK's own.
template <int D>
void check_plain(const io::RunFacts& about) {
  Sample<D> sample;
  for (int i = 0; i < 20000; ++i) {  // more than are put together at once
    Random random(1, Purpose::start, static_cast<std::uint64_t>(i));
    Vec<D> r;
    for (int k = 0; k < D; ++k) r[k] = 1e3 * random.normal();
    sample.grains.add(r, random.uniform(), 1e-9 * random.uniform(), 1, false);
    for (std::size_t k = 0; k < D; ++k) sample.force[k].push_back(random.normal());
  }
  for (const bool forces : {true, false}) {
    if (!forces)
      for (auto& column : sample.force) column.clear();
    const io::PlainGrains plain(sample.view(), about);
    std::ostringstream out;
    plain.write(out);
    CHECK(out.str().size() == plain.size());
    CHECK((out.str() == io::grains_vtp(sample.view(), about, io::Packing::plain)));
  }
}

}  // namespace

TEST_CASE("grains that are written piece by piece are the bytes that VTK writes") {
  check_plain<2>(facts);
  auto shaken = facts;
  shaken.clock = "shakes", shaken.dimensions = 3;
  check_plain<3>(shaken);
}
