#include <catch2/catch.hpp>

#include "core/random.hpp"
#include "engines/event/near_grains.hpp"

using namespace chute;
using namespace chute::event;

namespace {

template <int D>
Vec<D> random_vector(Random& random, double most) {
  Vec<D> v;
  for (int k = 0; k < D; ++k) v[k] = random.uniform(-most, most);
  return v;
}

/// Grains on random flights (through each other: nobody collides here), some of which begin again with another
/// velocity; the last ones do not move. At many times, every pair that touches is in both lists, in the image in which
/// it touches; the slow twin looks at all pairs in all images.
template <int D>
void follow(const Domain<D>& domain, const Vec<D>& gravity, double radius, double speed, std::size_t moving) {
  Random random(7, Purpose::start);
  std::vector<Flight<D>> flights(moving + 20);
  for (std::size_t i = 0; i < flights.size(); ++i) {
    Flight<D>& f = flights[i];
    for (int k = 0; k < D; ++k) f.place[k] = random.uniform(0, 6);
    f.radius = radius * random.uniform(0.8, 1);
    if (i < moving) f.velocity = random_vector<D>(random, speed), f.gravity = gravity;
  }
  NearGrains<D> near;
  near.build(flights, domain, moving, false, 0);
  CAPTURE(near.leash());
  std::vector<double> until(moving);
  const auto plan = [&](std::size_t i, double now) {
    until[i] = near.leaves(i, flights[i], now);
    REQUIRE(until[i] >= now);
  };
  for (std::size_t i = 0; i < moving; ++i) plan(i, 0);
  std::size_t touching = 0, missed = 0, changes = 0;
  const auto look = [&](double now) {
    for (std::size_t i = 0; i < moving; ++i)
      for (std::size_t j = 0; j < flights.size(); ++j) {
        const Vec<D> d = flights[j].place_at(now) - flights[i].place_at(now);
        std::array<int, D> nearest{};
        Vec<D> way = d;
        for (int k = 0; k < D; ++k)
          if (domain.periodic(k)) {
            nearest[static_cast<std::size_t>(k)] = -static_cast<int>(std::lround(d[k] / domain.length[k]));
            way[k] += nearest[static_cast<std::size_t>(k)] * domain.length[k];
          }
        if (i == j || norm(way) > flights[i].radius + flights[j].radius) continue;
        ++touching;
        bool found = false;
        for (const auto& n : near.of(i))
          found = found || (static_cast<std::size_t>(n.other) == j && near.shift(i, n) == nearest);
        missed += !found;
      }
  };
  double now = 0;
  for (int n = 1; n <= 60; ++n) {
    for (const double stop = 0.05 * n;;) {
      const auto i = static_cast<std::size_t>(std::min_element(until.begin(), until.end()) - until.begin());
      if (until[i] > stop) break;
      now = until[i];
      changes += near.follow(i, flights[i], now);
      plan(i, now);
      REQUIRE(until[i] > now);  // it does not change its list without end
    }
    now = 0.05 * n;
    look(now);
    for (int hit = 0; hit < 3; ++hit) {
      const auto i = static_cast<std::size_t>(random.uniform() * static_cast<double>(moving));
      near.unwind(i, flights[i].move_to(now, domain));
      flights[i].velocity = random_vector<D>(random, speed);
      plan(i, now);
    }
  }
  CHECK(touching > 1000);
  CHECK(changes > 50);
  CHECK(missed == 0);
}

}  // namespace

TEST_CASE("who can touch is in the list, wherever flights go") {
  for (const bool pulled : {false, true})
    for (const double speed : {0.3, 10.0}) {
      CAPTURE(pulled, speed);
      Domain<2> plane;
      follow<2>(plane, {{0, pulled ? -1.0 : 0}}, 0.8, speed, 40);
      plane.length = {{6, 6}};
      follow<2>(plane, {{pulled ? 0.3 : 0, pulled ? -1.0 : 0}}, 0.8, speed, 40);
      plane.length[1] = 2 * 1.601;  // hardly more than two contacts
      follow<2>(plane, {{0, 0}}, 0.8, speed, 40);
      Domain<3> space;
      follow<3>(space, {{0, 0, pulled ? -1.0 : 0}}, 1.2, speed, 60);
      space.length = {{6, 6, 6}};
      follow<3>(space, {{pulled ? 0.3 : 0, 0, pulled ? -1.0 : 0}}, 1.2, speed, 60);
    }
}

TEST_CASE("a grain at rest keeps its list, and one that flies alone changes it seldom") {
  std::vector<Flight<2>> flights(2);
  flights[0].radius = flights[1].radius = 0.5;
  flights[1].place = {{20, 20}};
  flights[1].velocity = {{1, 0}};
  NearGrains<2> near;
  near.build(flights, {}, 2, false, 0);
  CHECK(near.leaves(0, flights[0], 3) == std::numeric_limits<double>::infinity());
  CHECK(near.leaves(1, flights[1], 0) > 1);
  CHECK(near.of(0).empty());
}
