#include <catch2/catch.hpp>

#include "two_grains.hpp"

namespace symmetry_tests {
using namespace chute;
using namespace chute::test;

namespace {

/// Viscous friction, and laws that remember: directions are part of a memory in 3D.
const std::vector<laws::ContactLaws> kinds{
    {laws::SpringDashpot::from_restitution(1e5, 0.8),
     laws::RegularisedCoulomb{30, 0.3, laws::MassScaling::none, {}}},
    {laws::WaltonBraun::from_restitution(1e5, 0.8),
     laws::CundallStrack{laws::PairCoefficient{3e4}, laws::CutOffSpring{0.3, true}}}};

/// Four balls of several sizes that collide with each other, spinning; the last one is fixed.
template <int D>
Grains<D> handful() {
  Grains<D> grains;
  const auto put = [&](double x, double y, double vx, double vy, double radius, bool moves, double spin) {
    Vec<D> place, velocity;
    place[0] = x, place[1] = y, velocity[0] = vx, velocity[1] = vy;
    add_ball<D>(grains, place, velocity, radius, 8 * radius * radius * radius, moves);
    grains.spin[turns<D> - 1].back() = spin;
  };
  put(0, 0, 2, 0.3, 0.5, true, 4);
  put(1.3, 0.2, -1, 0, 0.45, true, -2);
  put(0.6, 1.1, 0.1, -2, 0.55, true, 0.5);
  put(0.7, -1.2, 0, 0, 0.5, false, 0);
  return grains;
}

template <int D>
Grains<D> run(const Grains<D>& grains, const Vec<D>& gravity, const laws::ContactLaws& contact) {
  auto s = setup<D>(contact, 1.4e-4, 1);
  s.gravity = gravity;
  soft::SoftEngine<D> engine(grains, s);
  engine.collect_impacts(true);
  engine.advance_to(8000);
  CHECK(engine.take_impacts().size() >= 3);
  return engine.state();
}

using Matrix = std::array<Vec<3>, 3>;
Vec<3> turned(const Matrix& a, const Vec<3>& v) { return {{dot(a[0], v), dot(a[1], v), dot(a[2], v)}}; }

/// Turn about an axis by an angle (Rodrigues).
Matrix rotation(Vec<3> axis, double angle) {
  axis = (1 / norm(axis)) * axis;
  Matrix rows;
  for (int k = 0; k < 3; ++k) {
    Vec<3> unit;
    unit[k] = 1;  // column k of the matrix is where the unit vector goes
    const auto image = std::cos(angle) * unit + std::sin(angle) * cross(axis, unit) +
                       ((1 - std::cos(angle)) * dot(axis, unit)) * axis;
    for (int row = 0; row < 3; ++row) rows[static_cast<std::size_t>(row)][k] = image[row];
  }
  return rows;
}

Grains<3> turned(const Matrix& a, Grains<3> g) {
  for (std::size_t i = 0; i < g.size(); ++i) {
    const auto r = turned(a, g.place(i)), v = turned(a, g.speed(i));
    const auto w = turned(a, Vec<3>{{g.spin[0][i], g.spin[1][i], g.spin[2][i]}});
    for (int k = 0; k < 3; ++k) g.position[k][i] = r[k], g.velocity[k][i] = v[k], g.spin[k][i] = w[k];
  }
  return g;
}

}  // namespace

TEST_CASE("2D and 3D agree on what happens in a plane") {
  const auto& contact = kinds[GENERATE(0u, 1u)];
  const auto flat = run<2>(handful<2>(), {{0.2, -1}}, contact);
  const auto solid = run<3>(handful<3>(), {{0.2, -1, 0}}, contact);
  for (std::size_t i = 0; i < flat.size(); ++i) {
    INFO("grain " << i);
    for (int k = 0; k < 2; ++k) {
      CHECK(solid.position[k][i] == Approx(flat.position[k][i]).margin(1e-10));
      CHECK(solid.velocity[k][i] == Approx(flat.velocity[k][i]).margin(1e-9));
    }
    CHECK(solid.spin[2][i] == Approx(flat.spin[0][i]).margin(1e-9));
    CHECK(solid.position[2][i] == 0);
    CHECK(solid.spin[0][i] == 0);
    CHECK(solid.spin[1][i] == 0);
  }
}

TEST_CASE("3D does not depend on how space is turned") {
  const auto& contact = kinds[GENERATE(0u, 1u)];
  auto start = handful<3>();
  // out of the plane too: a collision in three dimensions, with spins about every axis
  start.position[2][1] = 0.2;
  start.velocity[2][0] = 0.4;
  start.spin[0][0] = 3, start.spin[1][2] = -2;
  const Vec<3> gravity{{0.2, -1, 0.1}};
  const auto straight = run<3>(start, gravity, contact);
  for (double angle : {0.5, 2.2}) {
    const auto a = rotation({{1, -2, 0.7}}, angle);
    const auto expected = turned(a, straight), got = run<3>(turned(a, start), turned(a, gravity), contact);
    for (std::size_t i = 0; i < got.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        INFO("grain " << i << ", direction " << k);
        CHECK(got.position[k][i] == Approx(expected.position[k][i]).margin(1e-9));
        CHECK(got.velocity[k][i] == Approx(expected.velocity[k][i]).margin(1e-8));
        CHECK(got.spin[k][i] == Approx(expected.spin[k][i]).margin(1e-8));
      }
  }
}

// Mirroring changes signs only, so nothing may round differently.
TEST_CASE("a mirrored 2D scene runs to the mirrored bytes") {
  const auto& contact = kinds[GENERATE(0u, 1u)];
  auto mirrored = handful<2>();
  for (auto* field : {&mirrored.position[0], &mirrored.velocity[0], &mirrored.spin[0]})
    for (double& x : *field) x = -x;
  const auto straight = run<2>(handful<2>(), {{0.2, -1}}, contact),
             got = run<2>(mirrored, {{-0.2, -1}}, contact);
  for (std::size_t i = 0; i < got.size(); ++i) {
    CHECK(got.position[0][i] == -straight.position[0][i]);
    CHECK(got.position[1][i] == straight.position[1][i]);
    CHECK(got.velocity[0][i] == -straight.velocity[0][i]);
    CHECK(got.velocity[1][i] == straight.velocity[1][i]);
    CHECK(got.spin[0][i] == -straight.spin[0][i]);
  }
}

}  // namespace symmetry_tests
