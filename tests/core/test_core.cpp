#include <catch2/catch.hpp>
#include <cstring>
#include <numbers>
#include <span>

#include "core/compress.hpp"
#include "core/domain.hpp"
#include "core/engine.hpp"
#include "core/grains.hpp"
#include "core/kernel.hpp"
#include "core/random.hpp"
#include "core/team.hpp"

using namespace chute;

TEST_CASE("vectors") {
  const Vec<3> x{{1, 0, 0}}, y{{0, 1, 0}}, z{{0, 0, 1}}, a{{1, -2, 3}}, b{{0.5, 4, -1}};
  CHECK(cross(x, y) == z);
  CHECK(cross(y, z) == x);
  CHECK(dot(cross(a, b), a) == Approx(0).margin(1e-14));
  CHECK(norm(Vec<2>{{3, 4}}) == 5);
  CHECK(a + b - b == a);
}

TEST_CASE("the shortest way is the shortest of all images, and turns around") {
  Domain<2> domain{{{-1, 0}}, {{3, std::numeric_limits<double>::infinity()}}};
  CHECK(domain.periodic(0));
  CHECK_FALSE(domain.periodic(1));
  Random random(1, Purpose::bed);
  for (int i = 0; i < 1000; ++i) {
    const Vec<2> from{{random.uniform(-1, 2), random.uniform(-9, 9)}},
        to{{random.uniform(-1, 2), random.uniform(-9, 9)}};
    const auto way = domain.way(from, to);
    double best = 1e9;
    for (int image = -1; image <= 1; ++image) best = std::min(best, std::abs(to[0] - from[0] + 3 * image));
    CHECK(std::abs(way[0]) == Approx(best).margin(1e-14));
    CHECK(std::abs(std::remainder(way[0] - (to[0] - from[0]), 3)) < 1e-14);
    CHECK(way[1] == to[1] - from[1]);
    CHECK(domain.way(to, from) == -1.0 * way);
  }
}

// The standard fixes seed_seq and the Mersenne twister to the bit, and a 64-bit word to [0, 1) leaves no
// choice.
// Known answers of Random123's own collection (kat_vectors): philox4x32 with ten rounds.
TEST_CASE("random numbers are Philox's, at the counter (draw, item, step, purpose)") {
  Random zero(0, static_cast<Purpose>(0));
  CHECK(zero() == 0xe169c58d6627e8d5u);
  CHECK(zero() == 0x9b00dbd8bc57ac4cu);
  // key a4093822 299f31d0, counter 243f6a88 85a308d3 13198a2e 03707344: draw 243f6a88 is too far to count to; the others
  // are placed where they belong
  const r123::Philox4x32::ctr_type counter{{0, 0x85a308d3, 0x13198a2e, 0x70734400u | 0x44}};
  const auto block = r123::Philox4x32()(counter, {{0xa4093822, 0x299f31d0}});
  Random placed(0x299f31d0a4093822u, static_cast<Purpose>(0x44), 0x85a308d3, 0x70734413198a2eu);
  CHECK(placed() == (block.v[0] | std::uint64_t{block.v[1]} << 32));
  CHECK(placed() == (block.v[2] | std::uint64_t{block.v[3]} << 32));
  CHECK(zero.uniform() == static_cast<double>([] {
                            Random same(0, static_cast<Purpose>(0));
                            same(), same();
                            return same() >> 11;
                          }()) *
                              std::pow(2.0, -53));
}

TEST_CASE("random numbers depend on seed, purpose, item and step, and on nothing that was drawn before") {
  const auto first = [](std::uint64_t seed, Purpose purpose, std::uint64_t item = 0, std::uint64_t step = 0) {
    return Random(seed, purpose, item, step).uniform();
  };
  CHECK(first(1, Purpose::bed) == first(1, Purpose::bed));
  CHECK(first(1, Purpose::bed) != first(2, Purpose::bed));
  CHECK(first(1, Purpose::bed) != first(1, Purpose::sizes));
  CHECK(first(1, Purpose::bed) != first(1ull << 32 | 1, Purpose::bed));
  CHECK(first(1, Purpose::bed) != first(1, Purpose::bed, 1));
  CHECK(first(1, Purpose::bed) != first(1, Purpose::bed, 0, 1));
  double sum = 0, squares = 0;
  const int n = 100'000;
  for (int i = 0; i < n; ++i) {  // across items as along draws
    const double z = Random(3, Purpose::start, static_cast<std::uint64_t>(i)).normal();
    sum += z, squares += z * z;
  }
  CHECK(sum / n == Approx(0).margin(5 / std::sqrt(n)));
  CHECK(squares / n == Approx(1).epsilon(5 * std::sqrt(2.0 / n)));
}

// A number in free flight that decays is 0 while an engine steps, in every thread, and itself again outside.
TEST_CASE("subnormal numbers are flushed while stepping, in all threads of a team, and not afterwards") {
  volatile double tiny = 1e-300;
  const auto decayed = [&] { return tiny * 1e-10; };
  CHECK(decayed() > 0);
  Team team(3);
  std::array<double, 3> inside{}, outside{};
  {
    const FlushSubnormals flush;
    team.run([&](std::size_t k) { inside[k] = decayed(); });
    CHECK(decayed() == 0);
  }
  team.run([&](std::size_t k) { outside[k] = decayed(); });
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(inside[k] == 0);
    CHECK(outside[k] > 0);
  }
  CHECK(decayed() > 0);
}

TEST_CASE("a spin about a fixed axis is an orientation that turns, and turns do not commute") {
  const Vec<3> spin{{0.3, -0.4, 1.2}};  // 1.3 per time
  const auto q = turned<3>(as_at_start<3>(), spin, 2);
  CHECK(norm(q) == Approx(1));
  CHECK(q[0] == Approx(std::cos(1.3)));
  for (int k = 0; k < 3; ++k) CHECK(q[k + 1] == Approx(std::sin(1.3) * spin[k] / 1.3));
  const auto twice = turned<3>(turned<3>(as_at_start<3>(), spin, 0.7), spin, 1.3);
  for (int k = 0; k < 4; ++k) CHECK(twice[k] == Approx(q[k]));
  const double quarter = std::numbers::pi / 2;
  const Vec<3> about_x{{quarter, 0, 0}}, about_z{{0, 0, quarter}};
  const auto xz = turned<3>(turned<3>(as_at_start<3>(), about_x, 1), about_z, 1);
  const auto zx = turned<3>(turned<3>(as_at_start<3>(), about_z, 1), about_x, 1);
  CHECK(norm(xz - zx) > 0.5);
  CHECK(turned<2>({{0.5}}, {{-2}}, 3)[0] == -5.5);
}

TEST_CASE("every field of the grains goes where the list of fields sends it") {
  Grains<3> g;
  for (int i = 0; i < 4; ++i) g.add({{1.0 * i, 2.0 * i, 3.0 * i}}, 1 + i, 2 + i, 3 + i, i < 3);
  g.material = {5, 6, 7, 8};
  g.wraps[1] = {10, 11, 12};
  std::size_t columns = 0;
  Grains<3>::for_columns(g, [&](const GrainField& field, auto& column) {
    ++columns;
    CHECK(column.size() == (field.moving_only ? 3u : 4u));
  });
  CHECK(columns == 3 + 3 + 3 + 4 + 5 + 1 + 3);
  const std::vector<std::int32_t> from{2, 0, 1};
  g.reorder(from);
  CHECK(g.position[2][0] == 6);
  CHECK(g.radius[1] == 1);
  CHECK(g.material == std::vector<int>{7, 5, 6, 8});
  CHECK(g.wraps[1] == std::vector<int>{12, 10, 11});
  CHECK(g.position[0][3] == 3);
}

TEST_CASE("normal numbers have mean 0, variance 1, and no third or excess fourth moment") {
  Random random(7, Purpose::start);
  const int n = 200'000;
  double m[5] = {};
  for (int i = 0; i < n; ++i) {
    const double z = random.normal();
    for (int k = 1; k <= 4; ++k) m[k] += std::pow(z, k) / n;
  }
  // standard errors of the moments of a normal distribution are √(1, 2, 15, 96)/√n; five of them
  const double five = 5 / std::sqrt(n);
  CHECK(std::abs(m[1]) < five);
  CHECK(std::abs(m[2] - 1) < five * std::sqrt(2));
  CHECK(std::abs(m[3]) < five * std::sqrt(15));
  CHECK(std::abs(m[4] - 3) < five * std::sqrt(96));
}

namespace {

/// Sums, products, roots, quotients and selections: what the loops over contacts are made of.
struct Mixed {
  const double *a, *b;
  double* out;
  std::size_t count;
  void operator()() const {
    const auto *x = a, *y = b;
    auto* z = out;
    const auto n = count;
    CHUTE_VECTOR_LOOP
    for (std::size_t i = 0; i < n; ++i) {
      const double d2 = x[i] * x[i] + y[i] * y[i], d = std::sqrt(d2);
      z[i] = (x[i] < y[i] ? 1 / d : -d) * x[i] + y[i] * d2 - std::copysign(d, x[i]);
    }
  }
};

}  // namespace

TEST_CASE("a loop gives the same bytes with every instruction set") {
  Random random(3, Purpose::start);
  const std::size_t n = 1003;  // not a multiple of any vector width: the tail is computed by scalars
  std::vector<double> a(n), b(n), expected(n), got(n);
  for (auto* v : {&a, &b})
    for (double& x : *v) x = random.normal() * std::exp(20 * random.normal());
  run_kernel(Isa::baseline, Mixed{a.data(), b.data(), expected.data(), n});
  for (const Isa isa : {Isa::avx2, Isa::avx512}) {
    if (isa > best_isa()) continue;
    run_kernel(isa, Mixed{a.data(), b.data(), got.data(), n});
    CHECK(std::memcmp(got.data(), expected.data(), n * sizeof(double)) == 0);
  }
}

TEST_CASE("the energy account adds up") {
  EnergyAccount e;
  e.translation = 3, e.rotation = 0.5, e.elastic = 0.25, e.start = 1, e.gravity_work = 5, e.normal_loss = 1.5,
  e.shear_loss = 0.5;
  CHECK(e.stored() == 3.75);
  CHECK(e.residual() == 5 - 2.75 - 1.5 - 0.5);
}

TEST_CASE("grains know their inverse masses, and places count on through periods") {
  Grains<2> g;
  g.add({{1, 2}}, 0.5, 4, 0.5, true);
  g.add({{3, 0}}, 0.5, 4, 0.5, false);
  CHECK(g.moving == 1);
  CHECK(g.inverse_mass[0] == 0.25);
  CHECK(g.inverse_inertia[0] == 2);
  CHECK(g.inverse_mass[1] == 0);
  CHECK(reinterpret_cast<std::uintptr_t>(g.radius.data()) % 64 == 0);
  GrainsView view;
  view.position[0] = g.position[0];
  const std::vector<int> wraps{-3};
  view.wraps[0] = wraps;
  view.period[0] = 10;
  CHECK(view.unwrapped(0, 0) == -29);
}

TEST_CASE("compress lists the flags that are set, with every instruction set") {
  Random random(8, Purpose::start);
  for (const std::size_t count : {0, 1, 7, 8, 9, 64, 1001})
    for (const double density : {0.0, 0.08, 0.5, 1.0}) {
      std::vector<std::int64_t> flag(count);
      std::vector<std::int32_t> expected;
      for (std::size_t p = 0; p < count; ++p) {
        flag[p] = random.uniform() < density ? 1 + static_cast<std::int64_t>(p % 2) : 0;
        if (flag[p] != 0) expected.push_back(100 + static_cast<std::int32_t>(p));
      }
      for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
        if (isa > best_isa()) continue;
        std::vector<std::int32_t> found(count);
        found.resize(compress(isa, flag.data(), count, 100, found.data()));
        CHECK(found == expected);
      }
    }
}

TEST_CASE("grains in another order are the same grains") {
  Grains<2> grains;
  for (int i = 0; i < 5; ++i) {
    grains.add({{1.0 * i, 2.0 * i}}, 0.1 * (i + 1), 1 + i, 1 + i, i < 4);
    grains.velocity[1].back() = 10.0 * i;
    if (i < 4) grains.wraps[0].back() = i;
  }
  const std::vector<std::int32_t> from{2, 0, 3, 1};
  grains.reorder(from);
  for (std::size_t k = 0; k < 5; ++k) {
    const int was = k < 4 ? from[k] : 4;  // fixed grains stay
    CHECK(grains.position[1][k] == 2.0 * was);
    CHECK(grains.velocity[1][k] == 10.0 * was);
    CHECK(grains.radius[k] == 0.1 * (was + 1));
    CHECK(grains.mass[k] == 1 + was);
    CHECK(grains.inverse_mass[k] == (k < 4 ? 1.0 / (1 + was) : 0));
    if (k < 4) CHECK(grains.wraps[0][k] == was);
  }
}
