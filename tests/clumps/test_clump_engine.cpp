#include <catch2/catch.hpp>
#include <sstream>

#include "few_clumps.hpp"

using namespace chute;
using namespace chute::test;

namespace {

constexpr double k_n = 1e5, step = 1.4e-4;

template <int D>
Vec<D> momentum(const soft::ClumpEngine<D>& engine) {
  Vec<D> sum{};
  const auto& g = engine.state();
  for (std::size_t i = 0; i < g.moving; ++i) sum = sum + g.mass[i] * g.speed(i);
  return sum;
}

/// Two crooked grains that hit each other off their centres.
Bodies<3> colliding() {
  Bodies<3> bodies;
  const int form = bodies.form(crooked()), other = bodies.form(rod());
  bodies.put(form, {{0, 0, 0}}, {{2, 0.2, 0}}, {{0.5, -1, 2}}, (1 / std::sqrt(30.0)) * Vec<4>{{1, 2, -3, 4}});
  bodies.put(other, {{1.8, 0.5, 0.2}}, {{-1, 0, 0.1}}, {{0, 1, -1}}, {{0.8, 0, 0.6, 0}});
  return bodies;
}
Bodies<2> colliding_flat() {
  Bodies<2> bodies;
  const int form = bodies.form(crooked()), other = bodies.form(rod());
  bodies.put(form, {{0, 0}}, {{2, 0.2}}, {{2}}, {{1}});
  bodies.put(other, {{1.8, 0.5}}, {{-1, 0}}, {{-1}}, {{0.4}});
  return bodies;
}

template <int D>
Bodies<D> pair_of() {
  if constexpr (D == 2)
    return colliding_flat();
  else
    return colliding();
}

/// What friction with lever arms R_i and R_j does to the angular momentum: the surfaces, which touch ξ deep, are taken to meet
/// at the undeformed radii (1.14), so that Σ dL/dt = Σ ξ n × F_s.
Vec<3> twist(const Contact& c) {
  Vec<3> n, f;
  for (int k = 0; k < 3; ++k)
    n[k] = c.normal[static_cast<std::size_t>(k)], f[k] = c.force[static_cast<std::size_t>(k)];
  return -c.overlap * cross(n, f);
}

template <int D>
double along(const Vec<3>& v, int k) {
  return v[D == 2 ? 2 : k];
}

template <int D>
void check_collision(const laws::ContactLaws& laws, soft::Scheme scheme, double exact) {
  const auto bodies = pair_of<D>();
  soft::ClumpEngine<D> engine(bodies.grains, bodies.clumps, setup<D>(laws, step, scheme));
  const auto p = momentum(engine);
  const auto L = engine.angular_momentum();
  Vec<3> twisted{};
  std::int64_t touched = 0;
  for (std::int64_t n = 1; n <= 6000; ++n) {
    engine.advance_to(n);
    for (const auto& c : engine.contacts()) twisted = twisted + step * twist(c), ++touched;
  }
  CHECK(touched > 20);
  CHECK(engine.contacts().empty());
  for (int k = 0; k < D; ++k) CHECK(momentum(engine)[k] == Approx(p[k]).margin(1e-12));
  for (int k = 0; k < turns<D>; ++k) {
    CHECK(engine.angular_momentum()[k] == Approx(L[k] + along<D>(twisted, k)).margin(exact));
    CHECK(std::abs(along<D>(twisted, k)) < 0.01);
  }
  CHECK(norm(engine.state().speed(0) - bodies.grains.speed(0)) > 0.5);
}

}  // namespace

TEST_CASE("a collision of two bodies keeps momentum and angular momentum") {
  SECTION("smooth, verlet: exactly") {
    check_collision<2>(smooth(k_n), soft::Scheme::verlet, 1e-11);
    check_collision<3>(smooth(k_n), soft::Scheme::verlet, 1e-11);
  }
  SECTION("smooth, gear5: as well as places are integrated") {
    check_collision<2>(smooth(k_n), soft::Scheme::gear5, 1e-6);
    check_collision<3>(smooth(k_n), soft::Scheme::gear5, 1e-6);
  }
  SECTION("rough, verlet: but for the arms of friction, exactly") {
    check_collision<2>(rough(k_n), soft::Scheme::verlet, 1e-11);
    check_collision<3>(rough(k_n), soft::Scheme::verlet, 1e-11);
    check_collision<3>(remembering(k_n), soft::Scheme::verlet, 1e-11);
  }
}

TEST_CASE("a smooth elastic collision keeps the energy, better with shorter steps") {
  const auto off = [](double dt, soft::Scheme scheme) {
    const auto bodies = colliding();
    soft::ClumpEngine<3> engine(bodies.grains, bodies.clumps, setup<3>(smooth(k_n), dt, scheme));
    const double before = engine.energy().stored();
    engine.advance_to(std::llround(0.84 / dt));
    CHECK(engine.contacts().empty());
    return std::abs(engine.energy().stored() / before - 1);
  };
  for (const auto scheme : {soft::Scheme::gear5, soft::Scheme::verlet}) {
    INFO("scheme " << static_cast<int>(scheme));
    CHECK(off(step, scheme) < 1e-3);
    CHECK(off(step / 4, scheme) < 1e-4);
  }
}

TEST_CASE("the account of energy closes: what was lost is counted") {
  for (const auto& laws : {rough(k_n), remembering(k_n)}) {
    const auto bodies = colliding();
    soft::ClumpEngine<3> engine(bodies.grains, bodies.clumps, setup<3>(laws, step / 4, soft::Scheme::gear5));
    engine.advance_to(24000);
    const auto e = engine.energy();
    CHECK(e.normal_loss > 0.1);
    CHECK(e.shear_loss > 0.01);
    CHECK(e.residual() == Approx(0).margin(2e-4 * e.start));
  }
}

TEST_CASE("a single sphere that hits a rod's end off its centre: momentum transfer as of rigid bodies") {
  // A smooth elastic hit on the end of a rod, along y: J = 2 v / (1/m_s + 1/m + x²/I).
  Bodies<2> bodies;
  const int ball = bodies.form({{{{0, 0, 0}}, 0.5}}), form = bodies.form(rod());
  const auto& clump = bodies.clumps.forms[1];
  const double x = 0.5 * clump.members[2].at[0], R = 0.5 * clump.members[2].radius,
               I = 0.25 * clump.gyration[0];
  bodies.put(form, {{0, 0}});
  bodies.put(ball, {{x, R + 0.5 + 0.01}}, {{0, -1}});
  soft::ClumpEngine<2> engine(bodies.grains, bodies.clumps, setup<2>(smooth(1e8), 1e-6, soft::Scheme::gear5));
  engine.advance_to(12000);
  REQUIRE(engine.contacts().empty());
  const double J = 2 / (2 + x * x / I);
  const auto& g = engine.state();
  CHECK(g.velocity[1][0] == Approx(-J).epsilon(1e-3));
  CHECK(g.velocity[1][1] == Approx(J - 1).epsilon(1e-3));
  CHECK(g.spin[0][0] == Approx(-J * x / I).epsilon(1e-3));
}

namespace {

/// Some bodies over a row of beads, in a period, with a wall at the side; of one sphere each where `round`.
template <int D>
Bodies<D> heap(bool round) {
  Bodies<D> bodies;
  const int ball = bodies.form({{{{0.1, 0, 0}}, 0.3}}), form = round ? ball : bodies.form(crooked()),
            other = round ? ball : bodies.form(rod());
  for (int k = 0; k < 18; ++k) {
    Vec<D> place, velocity;
    place[0] = 0.7 + 2 * (k % 3) + 0.1 * (k / 3);
    place[D - 1] = 1.5 + 1.7 * (k / 3);
    velocity[0] = 1 - 0.3 * (k % 4), velocity[D - 1] = -3;
    Vec<turns<D>> spin;
    spin[0] = 0.7 * (k % 5) - 1;
    bodies.put(k % 2 ? form : other, place, velocity, spin, as_at_start<D>(), 0.4 + 0.01 * k);
    bodies.grains.material.back() = k % 2;
  }
  for (int k = 0; k < 6; ++k) {
    Vec<D> place;
    place[0] = k + 0.5;
    bodies.put_bead(place);
  }
  return bodies;
}

template <int D>
soft::SoftSetup<D> heap_setup(const laws::ContactLaws& laws, soft::Scheme scheme, double aside,
                              int threads = 1) {
  auto s = setup<D>(laws, step, scheme);
  s.domain.length[0] = 6;
  s.gravity[0] = 0.4, s.gravity[D - 1] = -0.9;
  if constexpr (D == 3) {
    Wall<3> wall;  // keeps them over the row
    wall.normal = {{0, 1, 0}}, wall.point = {{0, -aside, 0}};
    s.walls.push_back(wall);
    wall.normal = {{0, -1, 0}}, wall.point = {{0, aside, 0}};
    s.walls.push_back(wall);
  }
  s.threads = threads;
  return s;
}

template <int D>
std::string bytes_of(const Grains<D>& grains) {
  std::string bytes;
  for (const auto* field : {&grains.position, &grains.velocity})
    for (const auto& a : *field)
      bytes.append(reinterpret_cast<const char*>(a.data()), a.size() * sizeof(double));
  for (const auto& a : grains.spin)
    bytes.append(reinterpret_cast<const char*>(a.data()), a.size() * sizeof(double));
  for (const auto& a : grains.orientation)
    bytes.append(reinterpret_cast<const char*>(a.data()), a.size() * sizeof(double));
  return bytes;
}

template <int D>
void check_round(const laws::ContactLaws& laws, soft::Scheme scheme,
                 const std::optional<laws::ContactLaws>& of_walls = {}) {
  const auto bodies = heap<D>(true);
  auto s = heap_setup<D>(laws, scheme, 0.6);
  if (of_walls) s.wall_laws.assign(s.walls.size(), soft::LawTable(*of_walls));
  soft::SoftEngine<D> round(bodies.grains, s);
  soft::ClumpEngine<D> clumps(bodies.grains, bodies.clumps, s);
  for (const std::int64_t n : {1, 2000, 16000}) {
    round.advance_to(n);
    clumps.advance_to(n);
    CHECK(bytes_of(round.state()) == bytes_of(clumps.state()));
    CHECK(round.energy().residual() == clumps.energy().residual());
    const auto a = round.contacts(), b = clumps.contacts();
    REQUIRE(a.size() == b.size());
    for (std::size_t c = 0; c < a.size(); ++c) {
      CHECK(a[c].a == b[c].a);
      CHECK(a[c].b == b[c].b);
      CHECK(a[c].force == b[c].force);
      CHECK(a[c].point == b[c].point);
      CHECK(a[c].branch == b[c].branch);
    }
  }
  CHECK(round.energy().shear_loss > 0);
}

}  // namespace

TEST_CASE("bodies of one sphere give the bytes of round grains") {
  for (const auto scheme : {soft::Scheme::gear5, soft::Scheme::verlet})
    for (const auto& laws : {rough(k_n), remembering(k_n)}) {
      check_round<2>(laws, scheme);
      check_round<3>(laws, scheme);
    }
}

TEST_CASE("… with walls of laws of their own, which take some steps to let a slip die away") {
  auto laws = rough(k_n), of_walls = laws;
  laws.shear = laws::RegularisedCoulomb{1e4, 0.5, laws::MassScaling::none, 12};
  of_walls.shear = laws::RegularisedCoulomb{1e4, 0.2, laws::MassScaling::none, 12};
  check_round<3>(laws, soft::Scheme::gear5, of_walls);
}

namespace {

template <int D>
void check_resumed(const laws::ContactLaws& laws, soft::Scheme scheme) {
  const auto bodies = heap<D>(false);
  const auto s = heap_setup<D>(laws, scheme, 1.0);
  soft::ClumpEngine<D> whole(bodies.grains, bodies.clumps, s), resumed(bodies.grains, bodies.clumps, s);
  std::int64_t saved = 8000;
  for (whole.advance_to(saved); whole.contacts().empty();) whole.advance_to(saved += 100);
  const std::int64_t last = saved + 4000;
  REQUIRE(whole.energy().shear_loss > 0.1);
  std::stringstream kept;
  whole.save(kept);
  resumed.advance_to(300);
  resumed.restore(kept);
  whole.advance_to(last);
  resumed.advance_to(last);
  CHECK(bytes_of(whole.state()) == bytes_of(resumed.state()));
  CHECK(whole.energy().residual() == resumed.energy().residual());

  auto all_pairs = s;
  all_pairs.search = search::Method::all_pairs;
  all_pairs.isa = Isa::baseline;
  soft::ClumpEngine<D> slow(bodies.grains, bodies.clumps, all_pairs);
  slow.advance_to(saved);
  slow.advance_to(last);
  CHECK(bytes_of(whole.state()) == bytes_of(slow.state()));
}

}  // namespace

TEST_CASE("the same bytes resumed, and by the search through all pairs") {
  for (const auto scheme : {soft::Scheme::gear5, soft::Scheme::verlet})
    for (const auto& laws : {rough(k_n), remembering(k_n)}) {
      check_resumed<2>(laws, scheme);
      check_resumed<3>(laws, scheme);
    }
}

TEST_CASE("the same bytes by two threads") {
  const auto bodies = heap<3>(false);
  soft::ClumpEngine<3> alone(bodies.grains, bodies.clumps,
                             heap_setup<3>(remembering(k_n), soft::Scheme::gear5, 1.0)),
      by_two(bodies.grains, bodies.clumps, heap_setup<3>(remembering(k_n), soft::Scheme::gear5, 1.0, 2));
  for (const std::int64_t n : {6000, 10000}) alone.advance_to(n), by_two.advance_to(n);
  REQUIRE(alone.energy().shear_loss > 0.1);
  CHECK(bytes_of(alone.state()) == bytes_of(by_two.state()));
}

TEST_CASE("a body across the end of a period is the same as one in its middle") {
  const auto ends = [](double shift) {
    auto bodies = colliding_flat();
    for (std::size_t i = 0; i < bodies.grains.size(); ++i) {
      double& x = bodies.grains.position[0][i];
      x = std::fmod(x + shift, 16.0);
    }
    auto s = setup<2>(remembering(k_n), step, soft::Scheme::gear5);
    s.domain.length[0] = 16;
    soft::ClumpEngine<2> engine(bodies.grains, bodies.clumps, s);
    engine.advance_to(6000);
    return std::array{engine.state().speed(0), engine.state().speed(1)};
  };
  const auto middle = ends(7);
  for (const double shift : {15.0, 15.9, 14.6}) {
    const auto across = ends(shift);
    for (std::size_t i = 0; i < 2; ++i)
      for (int k = 0; k < 2; ++k) CHECK(across[i][k] == Approx(middle[i][k]).epsilon(1e-7).margin(1e-7));
  }
}

TEST_CASE("3D bodies that lie in a plane move as those of 2D") {
  Bodies<2> flat = colliding_flat();
  Bodies<3> solid;
  std::vector<clumps::Sphere> level = crooked();
  Bodies<2> flatter;
  for (auto& s : level) s.centre[2] = 0;
  const int f2 = flatter.form(level), r2 = flatter.form(rod()), f3 = solid.form(level),
            r3 = solid.form(rod());
  for (std::size_t i = 0; i < 2; ++i) {
    const auto r = flat.grains.place(i), v = flat.grains.speed(i);
    const double angle = flat.grains.orientation[0][i], spin = flat.grains.spin[0][i];
    flatter.put(i ? r2 : f2, r, v, {{spin}}, {{angle}});
    const Vec<4> turn{{std::cos(angle / 2), 0, 0, std::sin(angle / 2)}};
    solid.put(i ? r3 : f3, {{r[0], r[1], 0}}, {{v[0], v[1], 0}}, {{0, 0, spin}},
              quaternion_product(turn, solid.clumps.forms[i].written));
  }
  for (const auto& laws : {rough(k_n), remembering(k_n)}) {
    soft::ClumpEngine<2> a(flatter.grains, flatter.clumps, setup<2>(laws, step, soft::Scheme::gear5));
    soft::ClumpEngine<3> b(solid.grains, solid.clumps, setup<3>(laws, step, soft::Scheme::gear5));
    a.advance_to(6000), b.advance_to(6000);
    for (std::size_t i = 0; i < 2; ++i) {
      for (int k = 0; k < 2; ++k) {
        CHECK(b.state().position[k][i] == Approx(a.state().position[k][i]).epsilon(1e-6));
        CHECK(b.state().velocity[k][i] == Approx(a.state().velocity[k][i]).epsilon(1e-5).margin(1e-6));
      }
      CHECK(b.state().spin[2][i] == Approx(a.state().spin[0][i]).epsilon(1e-5).margin(1e-6));
    }
    CHECK(std::abs(a.state().spin[0][0] - 2) > 0.3);
  }
}
