// Grains that come in and leave: accounts, ids, the same bytes however a run is cut and shared, and what stays untouched.
#include <catch2/catch.hpp>
#include <map>
#include <numeric>
#include <set>

#include "small_chute.hpp"
#include "state.hpp"

namespace open_ends_tests {
using namespace chute;
using namespace chute::test;
using soft::SoftEngine;

namespace {

constexpr double every = 0.05;

/// Discs or spheres of three sizes, one after the other.
Newcomer newcomer(std::uint64_t count) {
  const double radius = 0.45 + 0.05 * static_cast<double>(count % 3);
  return {radius, 8 * radius * radius * radius, 0};
}

template <int D>
Inflow<D> inflow(const Vec<D>& low, const Vec<D>& high, double rate, const Vec<D>& velocity, double spread) {
  Inflow<D> in;
  in.low = low, in.high = high, in.velocity = velocity, in.spread = spread;
  in.rate = rate, in.every = every, in.seed = 7, in.next = newcomer;
  return in;
}

/// A bed of 20 beads, or of 20 by 4 in space, with a wall behind the box that grains come from, and an end below.
template <int D>
struct OpenChute {
  bool walls = true;
  double angle = 0.6, rate = D == 2 ? 4 : 12;
  laws::ContactLaws laws = SmallChute::contact(60);
  int threads = 1;
  soft::Scheme scheme = soft::Scheme::gear5;
  search::Method search = search::Method::cells;

  SoftEngine<D> made() const {
    auto s = setup<D>(laws, SmallChute::contact_time() / 25, 1, scheme);
    s.threads = threads, s.search = search;
    s.gravity = gravity_on_incline<D>(1, angle);
    s.many = {20, 256, 16, true};  // so that some dozens are sorted and take several steps at once
    Vec<D> low{}, high{}, velocity{};
    low[0] = 0.1, high[0] = 4, velocity[0] = 1.5;
    low[D - 1] = 1, high[D - 1] = 8;
    if constexpr (D == 3) s.domain.length[1] = high[1] = 4;
    s.inflow = inflow<D>(low, high, rate, velocity, 0.2);
    s.outflow = Outflow{21, -4, 2 * every};
    if (walls) {
      Wall<D> back;
      back.normal[0] = 1;
      s.walls = {back};
    }
    Grains<D> grains;
    for (int i = 0; i < 20; ++i)
      for (int j = 0; j < (D == 2 ? 1 : 4); ++j) {
        Vec<D> place{};
        place[0] = 0.5 + i;
        if constexpr (D == 3) place[1] = 0.5 + j;
        place[D - 1] = 1.6;
        add_ball<D>(grains, place, velocity, 0.45, 1);
      }
    const std::size_t moving = grains.size();
    for (std::size_t k = 0; k < moving; ++k) {
      Vec<D> place = grains.place(k);
      place[D - 1] = 0;
      add_ball<D>(grains, place, {}, 0.5, 1, false);
    }
    return SoftEngine<D>(grains, s);
  }
};

double told(const Engine& engine, const std::string& name) {
  for (const auto& [key, value] : engine.tells())
    if (key == name) return value;
  FAIL("nothing tells of " << name);
  return 0;
}

/// Steps between two instants at which grains may come.
template <int D>
std::int64_t steps_of(const SoftEngine<D>& engine) {
  return std::llround(every / engine.time_step());
}

double mass_of(const GrainsView& grains) {
  return std::accumulate(grains.mass.begin(),
                         grains.mass.begin() + static_cast<std::ptrdiff_t>(grains.moving), 0.0);
}

/// Grains that fall through empty space from a box to an end. Told: by how much mass, momentum and energy are off.
template <int D>
struct Misses {
  double mass = 0, momentum = 0, energy = 0, entered = 0, collided = 0;
};
template <int D>
Misses<D> through_empty_space(double rate, double spread, soft::Scheme scheme) {
  auto s = setup<D>(SmallChute::contact(60), SmallChute::contact_time() / 25, 1, scheme);
  s.gravity = gravity_on_incline<D>(1, 0.6);
  Vec<D> high, velocity{};
  for (int k = 0; k < D; ++k) high[k] = 4;
  velocity[0] = 2;
  s.inflow = inflow<D>({}, high, rate, velocity, spread);
  s.outflow = Outflow{12, -30, every};
  Grains<D> grains;
  Vec<D> place{};
  place[0] = 6;
  add_ball<D>(grains, place, velocity, 0.5, 1);
  SoftEngine<D> engine(grains, s);
  Vec<D> should = velocity;  // momentum, from the start
  for (int k = 1; k <= 400; ++k) {
    const double mass = mass_of(engine.grains());
    engine.advance_to(k * steps_of(engine));
    should = should + (mass * static_cast<double>(steps_of(engine)) * engine.time_step()) * s.gravity;
  }
  const auto now = engine.grains();
  Misses<D> misses;
  misses.entered = told(engine, "entered");
  misses.mass = mass_of(now) - (1 + told(engine, "mass_in") - told(engine, "mass_out"));
  for (int k = 0; k < D; ++k) {
    const std::string axis(1, "xyz"[k]);
    double momentum = 0;
    for (std::size_t i = 0; i < now.moving; ++i)
      momentum += now.mass[i] * now.velocity[static_cast<std::size_t>(k)][i];
    misses.momentum =
        std::max(misses.momentum, std::abs(momentum - should[k] - told(engine, "momentum_in_" + axis) +
                                           told(engine, "momentum_out_" + axis)));
  }
  CHECK(static_cast<double>(now.moving) == 1 + misses.entered - told(engine, "left"));
  const auto energy = engine.energy();
  misses.energy = energy.residual() / energy.outflow;
  misses.collided = energy.normal_loss;
  return misses;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("grains that fall from a box to an end without meeting leave no miss in any account",
                       "[open-ends]", ((int D), D), 2, 3) {
  for (const auto scheme : {soft::Scheme::gear5, soft::Scheme::verlet}) {
    const auto misses = through_empty_space<D>(0.2, 0, scheme);
    CHECK(misses.entered == 4);
    CHECK(misses.collided == 0);
    CHECK(misses.mass == Approx(0).margin(1e-12));
    CHECK(misses.momentum < 1e-9);
    CHECK(std::abs(misses.energy) < 1e-9);
  }
}

TEMPLATE_TEST_CASE_SIG("grains that collide on their way, and leave while they touch, are accounted for",
                       "[open-ends]", ((int D), D), 2, 3) {
  const auto misses = through_empty_space<D>(D == 2 ? 6 : 20, 0.5, soft::Scheme::gear5);
  CHECK(misses.entered == (D == 2 ? 120 : 400));
  CHECK(misses.collided > 1);
  CHECK(misses.mass == Approx(0).margin(1e-9));
  CHECK(misses.momentum < 1e-3 * 2 * misses.entered);
  CHECK(std::abs(misses.energy) < 1e-3);
}

TEMPLATE_TEST_CASE_SIG("down a chute as many grains leave as come in, none is lost and no id comes twice",
                       "[open-ends]", ((int D), D), 2, 3) {
  auto engine = OpenChute<D>{}.made();
  std::map<std::int64_t, double> mass;  // of every grain that ever was
  double entered = 0, left = 0;
  const int rounds = D == 2 ? 1200 : 800, first = rounds / 2;
  for (int k = 1; k <= rounds; ++k) {
    engine.advance_to(k * steps_of(engine));
    const auto grains = engine.grains();
    CHECK(std::is_sorted(grains.id.begin(), grains.id.begin() + static_cast<std::ptrdiff_t>(grains.moving)));
    CHECK(std::set(grains.id.begin(), grains.id.end()).size() == grains.size());
    for (std::size_t i = 0; i < grains.size(); ++i)
      CHECK(mass.try_emplace(grains.id_of(i), grains.mass[i]).first->second == grains.mass[i]);
    if (k == first) entered = told(engine, "entered"), left = told(engine, "left");
  }
  const double at_start = D == 2 ? 20 : 80;
  CHECK(static_cast<double>(engine.grains().moving) ==
        at_start + told(engine, "entered") - told(engine, "left"));
  CHECK(static_cast<double>(mass.size()) == 2 * at_start + told(engine, "entered"));
  CHECK(told(engine, "waiting") == 0);
  const double in = told(engine, "entered") - entered, out = told(engine, "left") - left;
  CHECK(in == Approx(D == 2 ? 120 : 240).margin(1));  // one may wait for the next instant
  CHECK(out == Approx(in).epsilon(0.12));
  const auto energy = engine.energy();
  CHECK(std::abs(energy.residual()) < 1e-3 * energy.gravity_work);
  CHECK(energy.outflow > energy.inflow);
}

TEMPLATE_TEST_CASE_SIG(
    "a chute with open ends gives the same bytes however it is shared, cut, stored and searched",
    "[open-ends]", ((int D), D), 2, 3) {
  for (const bool remembers : {false, true}) {
    OpenChute<D> chute;
    chute.walls = remembers;
    chute.angle = 0.35, chute.rate = D == 2 ? 6 : 20;
    if (remembers) chute.laws = remembering;
    auto whole = chute.made();
    const std::int64_t end = 200 * steps_of(whole) + 17;
    whole.advance_to(end);
    REQUIRE(told(whole, "left") > 10);
    auto shared = chute;
    shared.threads = 2;
    auto two = shared.made();
    two.advance_to(end);
    CHECK(state(two) == state(whole));

    auto searching = chute;
    searching.search = search::Method::all_pairs;
    auto slow = searching.made();
    auto first = chute.made();
    for (std::int64_t step = 0; step < end / 2; step += 777)
      first.advance_to(step), first.grains(), first.contacts();
    first.advance_to(end / 2);
    std::stringstream kept;
    first.save(kept);
    auto second = chute.made();
    second.advance_to(55 * steps_of(second));  // another state, of another number, which must leave no trace
    second.restore(kept);
    CHECK(state(second) == state(first));
    second.advance_to(end);
    CHECK(state(second) == state(whole));
    slow.advance_to(end);
    CHECK(state(slow) == state(whole));
  }
}

TEST_CASE("two grains that hold each other by what their contact remembers do not notice that others leave",
          "[open-ends]") {
  const auto made = [](bool others) {
    auto s = setup<3>(remembering, SmallChute::contact_time() / 25, 1);
    s.gravity = {{0.2, 0, -1}};
    if (others) s.outflow = Outflow{10, -50, every};
    Wall<3> floor;
    floor.normal[2] = 1;
    s.walls = {floor};
    Grains<3> grains;
    // One is ahead of the two in the order, one behind; both are beyond the end sooner or later.
    if (others) add_ball<3>(grains, {{9.5, 5, 3}}, {{3, 0, 0}}, 0.5, 1);
    add_ball<3>(grains, {{0, 0, 0.5}}, {}, 0.5, 1);
    add_ball<3>(grains, {{0.99, 0.1, 0.5}}, {{-0.2, 0.3, 0}}, 0.5, 1);
    if (others) add_ball<3>(grains, {{9.5, -5, 3}}, {{1, 0, 0}}, 0.5, 1);
    add_ball<3>(grains, {{0.5, 0.83, 0.4}}, {}, 0.4, 1, false);
    return SoftEngine<3>(grains, s);
  };
  auto alone = made(false), watched = made(true);
  const auto end = 20 * steps_of(watched);
  alone.advance_to(end), watched.advance_to(end);
  const auto two = alone.grains(), now = watched.grains();
  REQUIRE(now.moving == 2);
  CHECK(told(watched, "left") == 2);
  CHECK(alone.energy().elastic > 0);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(now.position[k][i] == two.position[k][i]);
      CHECK(now.velocity[k][i] == two.velocity[k][i]);
      CHECK(now.spin[k][i] == two.spin[k][i]);
    }
  CHECK(std::vector(now.id.begin(), now.id.end()) == std::vector<std::int64_t>{1, 2, 4});
  CHECK(watched.energy().shear_loss == alone.energy().shear_loss);
  CHECK(watched.energy().residual() == Approx(alone.energy().residual()).margin(1e-9));
}

TEST_CASE("after somebody came or left, contacts are those of the grains that are there", "[open-ends]") {
  auto engine = OpenChute<2>{}.made();
  for (int k = 1; k <= 40; ++k) {
    engine.advance_to(2 * k * steps_of(engine));
    auto s = setup<2>(SmallChute::contact(60), engine.time_step(), 1);
    Wall<2> back;
    back.normal[0] = 1;
    s.walls = {back};
    const SoftEngine<2> fresh(engine.state(), s);
    const auto found = engine.contacts(), should = fresh.contacts();
    REQUIRE(found.size() == should.size());
    for (std::size_t c = 0; c < found.size(); ++c) {
      CHECK(found[c].a == should[c].a);
      CHECK(found[c].b == should[c].b);
      // these of the corrected places, those of the predicted ones, unless somebody just came or left
      for (std::size_t k = 0; k < 2; ++k) CHECK(found[c].force[k] == Approx(should[c].force[k]).margin(1));
    }
  }
}

TEST_CASE("a box that is full lets nobody in, and those who wait come when there is room", "[open-ends]") {
  auto s = setup<2>(SmallChute::contact(60), 1e-3, 1);
  s.inflow = inflow<2>({{0, 0}}, {{3, 3}}, 100, {}, 0);
  s.gravity = {{0, -1}};
  Grains<2> grains;
  add_ball<2>(grains, {{50, 50}}, {}, 0.5, 1);
  SoftEngine<2> engine(grains, s);
  engine.advance_to(50);
  const double inside = told(engine, "entered");
  CHECK(inside >= 3);
  CHECK(inside <= 9);  // discs of radius 0.45 and more in 3 x 3
  CHECK(told(engine, "waiting") == 5 - std::min(5.0, inside));
  engine.advance_to(10000);
  CHECK(told(engine, "entered") + told(engine, "waiting") == 1000);
  CHECK(told(engine, "waiting") > 0);
  CHECK(told(engine, "entered") > 2 * inside);
}

TEST_CASE("a chute that has run empty goes on", "[open-ends]") {
  auto s = setup<2>(SmallChute::contact(60), 1e-3, 1);
  s.outflow = Outflow{2, -50, every};
  s.inflow = inflow<2>({{-2, 0}}, {{0, 2}}, 0.1, {{4, 0}}, 0);
  Grains<2> grains;
  add_ball<2>(grains, {{1.5, 0}}, {{4, 0}}, 0.5, 1);
  SoftEngine<2> engine(grains, s);
  engine.advance_to(5000);
  CHECK(engine.grains().moving == 0);
  CHECK(engine.energy().stored() == 0);
  CHECK(engine.energy().outflow == Approx(8));
  std::stringstream kept;
  engine.save(kept);
  SoftEngine<2> other(grains, s);
  other.restore(kept);
  for (auto* e : {&engine, &other}) {
    e->advance_to(10001);
    CHECK(e->grains().moving == 1);
    CHECK(e->grains().id[0] == 1);
  }
  CHECK(state(engine) == state(other));
}

}  // namespace open_ends_tests
