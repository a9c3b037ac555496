#include <catch2/catch.hpp>
#include <sstream>

#include "small_chute.hpp"
#include "state.hpp"

namespace twins_tests {
using namespace chute;
using namespace chute::test;

namespace {

/// The whole state after many contacts, among them gliding, rolling and resting ones.
template <int D>
std::string bytes_after(const Grains<D>& grains, const soft::SoftSetup<D>& s, std::int64_t steps) {
  soft::SoftEngine<D> engine(grains, s);
  engine.collect_impacts(true);
  engine.advance_to(steps);
  CHECK(engine.take_impacts().size() > 30);
  return state(engine);
}

template <int D>
void check_same_bytes(const Grains<D>& grains, const soft::SoftSetup<D>& usual, std::int64_t steps) {
  const auto expected = bytes_after(grains, usual, steps);
  auto other = usual;
  other.search = search::Method::all_pairs;
  CHECK(bytes_after(grains, other, steps) == expected);
  for (const auto& [near, far] : {std::pair{0.0, 0.0}, {0.01, 0.02}, {0.1, 0.15}, {0.3, 1.5}, {2.0, 4.0}}) {
    INFO("skins " << near << ", " << far);
    other = usual;
    other.skins = {near, far};
    CHECK(bytes_after(grains, other, steps) == expected);
  }
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    if (isa > best_isa()) continue;  // this processor cannot run it
    INFO("isa " << static_cast<int>(isa));
    other = usual;
    other.isa = isa;
    CHECK(bytes_after(grains, other, steps) == expected);
  }
}

}  // namespace

TEST_CASE("search, skins and instruction set do not change a bit, 2D") {
  const SmallChute chute;
  const auto scheme = GENERATE(soft::Scheme::gear5, soft::Scheme::verlet);
  auto s = chute.setup(50, scheme);
  check_same_bytes<2>(chute.grains(), s, 10'000);
  s.laws = remembering;
  check_same_bytes<2>(chute.grains(), s, 10'000);
}

TEST_CASE("search, skins and instruction set do not change a bit, 3D") {
  auto s = small_box_setup(50);
  check_same_bytes<3>(small_box(), s, 5'000);
  s.laws = remembering;
  check_same_bytes<3>(small_box(), s, 5'000);
}

namespace {
/// From a state after many contacts on: threads that share so little work mostly wait for each other.
template <int D>
void check_threads(const Grains<D>& grains, const soft::SoftSetup<D>& usual, std::int64_t warm_up,
                   std::int64_t steps) {
  soft::SoftEngine<D> engine(grains, usual);
  engine.collect_impacts(true);
  engine.advance_to(warm_up);
  const auto begin = state(engine);
  engine.advance_to(warm_up + steps);
  const auto expected = state(engine);
  CHECK(expected != begin);
  for (const int threads : {2, 3, 5}) {
    INFO("threads " << threads);
    auto other = usual;
    other.threads = threads;
    soft::SoftEngine<D> twin(grains, other);
    std::istringstream in(begin);
    twin.restore(in);
    twin.advance_to(warm_up + steps);
    CHECK(state(twin) == expected);
    CHECK(twin.energy().normal_loss == engine.energy().normal_loss);
  }
}
}  // namespace

TEST_CASE("threads do not change a bit") {
  SmallChute chute;
  chute.bed = 16, chute.columns = 12, chute.rows = 8;
  auto s = chute.setup(50);
  check_threads<2>(chute.grains(), s, 8000, 600);
  auto box = small_box_setup(50);
  check_threads<3>(small_box(), box, 4000, 600);
  s.laws = box.laws = remembering;
  s.skins = {0.002, 0.004};  // many new lists
  check_threads<2>(chute.grains(), s, 8000, 600);
  check_threads<3>(small_box(), box, 4000, 600);
}

TEST_CASE("the twins of a run differ from another run") {  // so that the comparisons above can fail
  const SmallChute chute;
  auto grains = chute.grains();
  const auto expected = bytes_after<2>(grains, chute.setup(50), 10'000);
  grains.velocity[0][7] = std::nextafter(grains.velocity[0][7], 10);
  CHECK(bytes_after<2>(grains, chute.setup(50), 10'000) != expected);
}

TEST_CASE("how the way to a step is cut does not change a bit") {
  const SmallChute chute;
  const auto scheme = GENERATE(soft::Scheme::gear5, soft::Scheme::verlet);
  auto s = chute.setup(50, scheme);
  if (GENERATE(false, true)) s.laws = remembering;
  const auto expected = bytes_after<2>(chute.grains(), s, 9'000);
  soft::SoftEngine<2> engine(chute.grains(), s);
  engine.collect_impacts(true);
  for (std::int64_t step = 0, stride = 1; step < 9'000; stride = stride % 37 + 1)
    engine.advance_to(step = std::min<std::int64_t>(9'000, step + stride));
  CHECK(state(engine) == expected);
}

TEST_CASE("a restored engine goes on to the same bytes") {
  const SmallChute chute;
  const auto scheme = GENERATE(soft::Scheme::gear5, soft::Scheme::verlet);
  auto s = chute.setup(50, scheme);
  if (GENERATE(false, true)) s.laws = remembering;
  soft::SoftEngine<2> whole(chute.grains(), s);
  whole.collect_impacts(true);
  for (const std::int64_t at : {0, 777, 1'500, 5'000}) {
    whole.advance_to(at);
    std::stringstream saved(state(whole));
    soft::SoftEngine<2> resumed(chute.grains(), s);
    resumed.restore(saved);
    resumed.collect_impacts(true);
    CHECK(resumed.step() == at);
    CHECK(state(resumed) == state(whole));
    whole.take_impacts();
    whole.advance_to(at + 700);
    resumed.advance_to(at + 700);
    CHECK(state(resumed) == state(whole));
    const auto a = whole.take_impacts(), b = resumed.take_impacts();
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      CHECK(a[i].time == b[i].time);
      CHECK(a[i].grain == b[i].grain);
      CHECK(a[i].v_n == b[i].v_n);
    }
    CHECK(resumed.energy().residual() == whole.energy().residual());
  }
}

TEST_CASE("a coarse look finds the contacts that a full look finds, also where it is in doubt") {
  Random random(6, Purpose::start);
  Domain<2> domain;
  domain.length[0] = 4000;
  Grains<2> grains;
  for (int k = 0; k < 1000; ++k) {  // pairs that touch or do not touch by very little, in any direction
    const Vec<2> place{{4.0 * k, random.uniform(-3, 3)}};
    const double angle = random.uniform(0, 2 * pi), gap = std::pow(10, random.uniform(-15, -2));
    const double way = 1 + (k % 2 ? gap : -gap);
    grains.add(place, 0.5, 1, 0.1, true);
    auto other = place + way * Vec<2>{{std::cos(angle), std::sin(angle)}};
    if (other[0] < 0) other[0] += 4000;
    grains.add(other, 0.5, 1, 0.1, true);
  }
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    if (isa > best_isa()) continue;
    search::NeighbourList<2> list(domain, {0.1, 0.3}, search::Method::cells, isa);
    soft::ContactStages<2> stages(domain, SmallChute::contact(), isa);
    soft::Contacts<2> coarse, full;
    const auto near = list.near(grains);
    REQUIRE(near.coarse != nullptr);
    stages.evaluate(near, grains, coarse);
    stages.evaluate({near.pairs}, grains, full);
    REQUIRE(coarse.count == full.count);
    CHECK(full.count > 400);
    CHECK(full.count < 600);
    for (std::size_t c = 0; c < full.count; ++c) {
      CHECK(coarse.i[c] == full.i[c]);
      CHECK(coarse.j[c] == full.j[c]);
    }
  }
}

}  // namespace twins_tests
