// Sorted grains and steps taken several at once (soft/time_tiles.hpp): everything must be as without, to the
// last bit, and outside of the engine grains must have their ids.
#include <catch2/catch.hpp>
#include <sstream>

#include "small_chute.hpp"
#include "state.hpp"

namespace many_grains_tests {
using namespace chute;
using namespace chute::test;

namespace {

/// A long chute: 400 beads, 300 by 3 grains. Sorted from the start; tiles of about 150 grains.
SmallChute long_chute() {
  SmallChute chute;
  chute.bed = 400, chute.columns = 300, chute.rows = 3;
  return chute;
}
soft::SoftSetup<2> sorted(const SmallChute& chute, bool tiles, soft::Scheme scheme = soft::Scheme::gear5) {
  auto s = chute.setup(50, scheme);
  s.skins = {0.1, 0.4};
  s.many = {100, 512, 150, tiles};
  return s;
}

/// A long box in three dimensions.
Grains<3> long_box() {
  Random random(4, Purpose::start);
  Grains<3> g;
  for (int i = 0; i < 960; ++i)
    add_ball<3>(g, {{0.6 + 1.25 * (i % 160), 0.6 + 1.25 * (i / 160 % 3), 1.3 + 1.2 * (i / 480)}},
                {{1 + random.normal(), random.normal(), random.normal()}}, random.uniform(0.4, 0.55), 1);
  for (int i = 0; i < 800; ++i)
    add_ball<3>(g, {{0.5 + i % 200, 0.5 + static_cast<double>(i / 200), 0}}, {{0, 0, 0}}, 0.5, 1, false);
  return g;
}

template <int D>
void check_same(const Grains<D>& grains, const soft::SoftSetup<D>& with, std::int64_t steps) {
  auto without = with;
  without.many.tiles = false;
  without.search = search::Method::all_pairs;
  soft::SoftEngine<D> slow(grains, without);
  slow.advance_to(steps);
  CHECK(slow.tiled_steps() == 0);
  const auto expected = state(slow);
  for (const int threads : {1, 2, 3}) {
    auto s = with;
    s.threads = threads;
    soft::SoftEngine<D> fast(grains, s);
    fast.advance_to(steps);
    INFO("threads " << threads << ", steps in tiles " << fast.tiled_steps());
    CHECK(fast.tiled_steps() > steps / 2);
    CHECK(state(fast) == expected);
    CHECK(fast.energy().residual() == slow.energy().residual());
  }
}

/// The same pairs in the same order, and the same shear but for the order of sums.
void check_same_contacts(const std::vector<Contact>& a, const std::vector<Contact>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    REQUIRE(a[k].a == b[k].a);
    REQUIRE(a[k].b == b[k].b);
    CHECK(a[k].shear_force == Approx(b[k].shear_force).margin(1e-3));
  }
}

}  // namespace

TEST_CASE("several steps at once give the bytes of steps one by one") {
  const auto chute = long_chute();
  const auto grains = chute.grains();
  const auto scheme = GENERATE(soft::Scheme::gear5, soft::Scheme::verlet);
  check_same<2>(grains, sorted(chute, true, scheme), 4000);
}

TEST_CASE("several steps at once in three dimensions, and without a period") {
  auto s = small_box_setup(50);
  s.domain.length[0] = 200;
  s.domain.length[1] = 4;
  s.skins = {0.1, 0.4};
  s.many = {100, 512, 150, true};
  check_same<3>(long_box(), s, 2000);
  const auto chute = long_chute();
  auto open = sorted(chute, true);
  open.domain = {};
  check_same<2>(chute.grains(), open, 2000);
}

TEST_CASE("tiles of any width, at any cut of the way, give the same bytes") {
  const auto chute = long_chute();
  const auto grains = chute.grains();
  soft::SoftEngine<2> slow(grains, sorted(chute, false));
  slow.advance_to(3000);
  for (const std::size_t wide : {40, 100, 333, 449}) {
    auto s = sorted(chute, true);
    s.many.grains_per_tile = wide;
    soft::SoftEngine<2> fast(grains, s);
    for (std::int64_t step = 0, stride = 1; step < 3000; stride = (stride * 7 + 3) % 211)
      fast.advance_to(step = std::min<std::int64_t>(3000, step + stride));
    CHECK(fast.tiled_steps() > 1000);
    CHECK(state(fast) == state(slow));
  }
}

// Grains that fall from rest, a thousand times heavier than usual, move much farther than their speed told
// when the list was guessed to last: what was done must be undone.
TEST_CASE("a list that breaks while several steps are taken is no harm") {
  const auto chute = long_chute();
  auto grains = chute.grains();
  for (std::size_t i = 0; i < grains.moving; ++i) grains.velocity[0][i] = grains.velocity[1][i] = 0;
  auto s = sorted(chute, true);
  s.gravity = {{0, -1000}};
  s.skins = {0.0004, 0.01};
  s.many.grains_per_tile = 400;  // wide, for many steps at once
  auto without = s;
  without.many.tiles = false;
  soft::SoftEngine<2> slow(grains, without), fast(grains, s);
  slow.advance_to(200);
  fast.advance_to(200);
  CHECK(fast.undone() > 0);
  CHECK(fast.undone() < 5);  // it does not try again at every step
  CHECK(state(fast) == state(slow));
}

TEST_CASE("a sorted engine shows its grains by id") {
  const auto chute = long_chute();
  const auto grains = chute.grains();
  auto unsorted = sorted(chute, true);
  unsorted.many.sort_from = 1'000'000;
  soft::SoftEngine<2> plain(grains, unsorted), engine(grains, sorted(chute, true));
  // before rounding has grown, in which the two orders of sums differ
  for (const std::int64_t step : {1, 40, 600}) {
    plain.advance_to(step);
    engine.advance_to(step);
    const auto a = plain.grains(), b = engine.grains();
    bool moved = false;
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t k = 0; k < 2; ++k) {
        REQUIRE(b.position[k][i] == Approx(a.position[k][i]).margin(1e-9));
        REQUIRE(b.velocity[k][i] == Approx(a.velocity[k][i]).margin(1e-7));
        REQUIRE(b.force[k][i] == Approx(a.force[k][i]).margin(1e-3));
      }
      REQUIRE(b.radius[i] == a.radius[i]);
      moved = moved || engine.id_at(i) != i;
    }
    CHECK(moved);
    check_same_contacts(plain.contacts(), engine.contacts());
    CHECK(engine.energy().gravity_work == Approx(plain.energy().gravity_work));
    CHECK(engine.energy().normal_loss == Approx(plain.energy().normal_loss));
  }
}

TEST_CASE("a sorted engine goes on from a checkpoint, and to impacts, as if nothing had been") {
  const auto chute = long_chute();
  const auto grains = chute.grains();
  const auto s = sorted(chute, true);
  soft::SoftEngine<2> whole(grains, s);
  for (const std::int64_t at : {0, 512, 700}) {
    whole.advance_to(at);
    std::stringstream saved(state(whole));
    soft::SoftEngine<2> resumed(grains, s);
    resumed.advance_to(100);  // it may have an order of its own
    resumed.restore(saved);
    CHECK(state(resumed) == state(whole));
    CHECK(resumed.grains().position[0][17] == whole.grains().position[0][17]);
    CHECK(resumed.contacts().size() == whole.contacts().size());
    resumed.advance_to(at + 600);
    soft::SoftEngine<2> other(grains, s);
    other.advance_to(at + 600);
    CHECK(state(resumed) == state(other));
  }
  soft::SoftEngine<2> left(grains, s);
  left.advance_to(700);
  left.collect_impacts(true);
  whole.advance_to(700);
  whole.collect_impacts(true);
  left.advance_to(1500);
  whole.advance_to(1500);
  const auto impacts = left.take_impacts();
  REQUIRE(impacts.size() > 10);
  for (const auto& i : impacts) {  // ids: they meet where these grains are
    CHECK(i.grain < 900);
    CHECK(i.time > 0);
  }
  CHECK(state(left) == state(whole));
}

namespace {

/// Sorting renames the grains of contacts that last, and turns some of them round: what they remember must go along. Before
/// rounding has grown, in which the two orders of sums differ, all is as without.
template <int D>
void check_memories(const Grains<D>& grains, soft::SoftSetup<D> s) {
  s.laws = remembering;
  s.many.sort_every = 64;               // in the middle of contacts
  s.gravity = 300 * Vec<D>(s.gravity);  // which are many soon, and deep
  s.deepest_overlap = 0.9;
  auto never = s;
  never.many.sort_from = 1'000'000;
  soft::SoftEngine<D> plain(grains, never), engine(grains, s);
  for (const std::int64_t step : {400, 700}) {
    plain.advance_to(step);
    engine.advance_to(step);
    const auto a = plain.grains(), b = engine.grains();
    std::size_t moved = 0;
    double slipped = 0;
    for (std::size_t i = 0; i < a.moving; ++i) {
      moved += engine.id_at(i) != i;
      for (std::size_t k = 0; k < D; ++k) REQUIRE(b.position[k][i] == Approx(a.position[k][i]).margin(1e-9));
      for (std::size_t k = 0; k < D; ++k) REQUIRE(b.velocity[k][i] == Approx(a.velocity[k][i]).margin(1e-6));
      for (std::size_t k = 0; k < turns<D>; ++k) REQUIRE(b.spin[k][i] == Approx(a.spin[k][i]).margin(1e-6));
    }
    const auto contacts = plain.contacts();
    check_same_contacts(contacts, engine.contacts());
    for (const auto& contact : contacts) slipped = std::max(slipped, std::abs(contact.shear_force));
    CHECK(moved > a.moving / 2);
    CHECK(contacts.size() > 30);
    CHECK(slipped > 10);
    CHECK(engine.energy().shear_loss == Approx(plain.energy().shear_loss));
    CHECK(engine.energy().elastic == Approx(plain.energy().elastic));
  }

  // threads, pieces, a checkpoint in between, and looking on the way leave no trace
  const auto expected = state(engine);
  struct Way {
    int threads;
    std::size_t pairs_in_piece;
  };
  for (const auto& [threads, piece] : {Way{1, 2048}, Way{2, 2048}, Way{1, 7}, Way{1, 64}}) {
    s.threads = threads, s.many.pairs_in_piece = piece;
    INFO("threads " << threads << ", pairs in a piece " << piece);
    soft::SoftEngine<D> first(grains, s), resumed(grains, s);
    first.advance_to(347);
    resumed.advance_to(100);
    std::stringstream saved(state(first));
    resumed.restore(saved);
    CHECK(state(resumed) == state(first));
    resumed.advance_to(350), resumed.contacts(), resumed.energy();
    resumed.advance_to(700);
    CHECK(state(resumed) == expected);
  }
}

}  // namespace

TEST_CASE("what contacts remember is sorted with their grains") {
  const auto chute = long_chute();
  auto flow = sorted(chute, true);
  check_memories<2>(chute.grains(), flow);
  auto s = small_box_setup(50);
  s.domain.length[0] = 200;
  s.domain.length[1] = 4;
  s.many = {100, 512, 150, true};
  check_memories<3>(long_box(), s);
}

TEST_CASE("impacts are collected from a flow whose contacts remember, as if it had never been sorted") {
  auto s = small_box_setup(50);
  s.domain.length[0] = 200;
  s.domain.length[1] = 4;
  s.many = {100, 512, 150, true};
  s.laws = remembering;
  auto never = s;
  never.many.sort_from = 1'000'000;
  soft::SoftEngine<3> plain(long_box(), never), engine(long_box(), s);
  plain.advance_to(300), engine.advance_to(300);
  plain.collect_impacts(true), engine.collect_impacts(true);
  plain.advance_to(700), engine.advance_to(700);
  const auto a = plain.take_impacts(), b = engine.take_impacts();
  REQUIRE(a.size() == b.size());
  CHECK(a.size() > 20);
  for (std::size_t k = 0; k < a.size(); ++k) {
    CHECK(a[k].grain == b[k].grain);
    CHECK(a[k].bead == b[k].bead);
    CHECK(a[k].v_n == Approx(b[k].v_n).margin(1e-6));
  }
}

}  // namespace many_grains_tests
