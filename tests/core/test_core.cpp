#include <catch2/catch.hpp>
#include <cstring>
#include <random>
#include <span>

#include "core/compress.hpp"
#include "core/domain.hpp"
#include "core/engine.hpp"
#include "core/grains.hpp"
#include "core/kernel.hpp"
#include "core/random.hpp"

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
TEST_CASE("uniform numbers are those of the standard's generator") {
  const std::uint64_t seed = 0x123456789abcdef0;
  Random random(seed, Purpose::sizes);
  std::seed_seq sequence{std::uint32_t{0x9abcdef0}, std::uint32_t{0x12345678}, std::uint32_t{2}};
  std::mt19937_64 truth(sequence);
  for (int i = 0; i < 100; ++i) CHECK(random.uniform() == static_cast<double>(truth()) * std::pow(2.0, -64));
}

TEST_CASE("streams repeat, and differ by seed and by purpose") {
  const auto first = [](std::uint64_t seed, Purpose purpose) { return Random(seed, purpose).uniform(); };
  CHECK(first(1, Purpose::bed) == first(1, Purpose::bed));
  CHECK(first(1, Purpose::bed) != first(2, Purpose::bed));
  CHECK(first(1, Purpose::bed) != first(1, Purpose::sizes));
  CHECK(first(1, Purpose::bed) != first(1ull << 32 | 1, Purpose::bed));
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
