#include <catch2/catch.hpp>

#include "engines/hard/first_contact.hpp"
#include "few_grains.hpp"

using namespace chute;
using namespace chute::test;
using namespace chute::event;
using namespace chute::hard;

namespace {

struct Hit {
  double time;
  std::size_t i, j;
};

/// The slow exact twin of EventEngine: after every collision it solves for every pair, in every image within
/// `far` periods, and takes the earliest. No cells, no queue, no memory. No flight may be longer than `far`
/// periods.
template <int D>
class Twin {
 public:
  Twin(const Grains<D>& grains, const EventSetup<D>& setup, int far)
      : grains_(grains), setup_(setup), far_(far) {
    for (std::size_t i = 0; i < grains.size(); ++i) {
      Flight<D> f;
      f.place = grains.place(i);
      f.radius = grains.radius[i];
      if (i < grains.moving) f.velocity = grains.speed(i), f.gravity = setup.gravity;
      for (int k = 0; k < turns<D>; ++k) f.spin[k] = grains.spin[static_cast<std::size_t>(k)][i];
      flights_.push_back(f);
    }
  }

  Hit next() {
    Hit first{std::numeric_limits<double>::infinity(), 0, 0};
    for (std::size_t i = 0; i < grains_.moving; ++i)
      for (std::size_t j = i + 1; j < grains_.size(); ++j)
        each_image(0, {}, [&](const Vec<D>& image) {
          const Flight<D>&a = flights_[i], &b = flights_[j];
          const double from = std::max(a.time, b.time);
          const Approach<D> approach{a.place_at(from) - b.place_at(from) + image,
                                     a.velocity_at(from) - b.velocity_at(from), a.gravity - b.gravity,
                                     a.radius + b.radius};
          const double t = from + first_contact(approach);
          if (t < first.time) first = {t, i, j};
        });
    hit(first);
    return first;
  }

 private:
  Grains<D> grains_;
  EventSetup<D> setup_;
  int far_;
  std::vector<Flight<D>> flights_;

  template <class Visit>
  void each_image(int k, Vec<D> image, const Visit& visit) {
    if (k == D) return visit(image);
    const int far = setup_.domain.periodic(k) ? far_ : 0;
    for (int n = -far; n <= far; ++n) {
      image[k] = n == 0 ? 0 : n * setup_.domain.length[k];
      each_image(k + 1, image, visit);
    }
  }
  void hit(const Hit& at) {
    for (const auto k : {at.i, at.j})
      if (k < grains_.moving) flights_[k].move_to(at.time, setup_.domain);
    Flight<D>&a = flights_[at.i], &b = flights_[at.j];
    const Vec<D> way = setup_.domain.way(a.place, b.place);
    const Vec<D> n = (1 / norm(way)) * way;
    laws::Collider<D> p{a.velocity, a.spin, a.radius, grains_.inverse_mass[at.i],
                        grains_.inverse_inertia[at.i]};
    laws::Collider<D> q{b.velocity, b.spin, b.radius, grains_.inverse_mass[at.j],
                        grains_.inverse_inertia[at.j]};
    setup_.contact.tangential(n, setup_.contact.restitution, p, q);
    a.velocity = p.velocity, a.spin = p.spin, b.velocity = q.velocity, b.spin = q.spin;
  }
};

/// The engine's hits, one by one, are those of the twin, to the bit.
template <int D>
void compare(const Grains<D>& grains, EventSetup<D> setup, std::size_t most, int far = 3) {
  setup.contact_time = 0;
  EventEngine<D> engine(grains, setup);
  engine.collect_impacts(true);
  Twin<D> twin(grains, setup, far);
  std::vector<Impact> impacts;
  for (std::int64_t step = 1; impacts.size() < most && step < 10000; ++step) {
    engine.advance_to(step);
    for (const auto& impact : engine.take_impacts()) impacts.push_back(impact);
  }
  REQUIRE(impacts.size() >= most);
  std::size_t different = 0;
  for (std::size_t k = 0; k < most; ++k) {
    const Hit hit = twin.next();
    const auto low = static_cast<std::size_t>(std::min(impacts[k].grain, impacts[k].bead));
    const auto high = static_cast<std::size_t>(std::max(impacts[k].grain, impacts[k].bead));
    if (hit.time != impacts[k].time || hit.i != low || hit.j != high) ++different;
  }
  CHECK(different == 0);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a gas: the same collisions as the twin that tries all pairs, to the bit", "",
                       ((int D), D), 2, 3) {
  for (const double spacing : {1.15, 1.7}) {
    Gas<D> gas(D == 2 ? 5 : 3, spacing);
    gas.setup.contact = {laws::ConstantRestitution{0.95}, {.friction = 0.3, .beta = 0.2}};
    compare(gas.grains, gas.setup, D == 2 ? 700 : 300);
  }
}

TEST_CASE("grains above a bed on an incline: the same collisions as the twin, to the bit") {
  Heap heap(5, 3, 0.3);
  heap.setup.contact = {laws::ConstantRestitution{0.98}, {.friction = 0.3, .beta = 0.2}};
  compare(heap.grains, heap.setup, 1500);
}

TEST_CASE("one ball on long flights over a short period: the same collisions as the twin") {
  Heap heap(4, 1, 0.2);
  Grains<2> one;
  add_ball<2>(one, {{0.7, 2.0}}, {{1, 0}}, 0.9, 1, true);
  for (int i = 0; i < 4; ++i) add_ball<2>(one, {{(i + 0.5) * 1.2, 0}}, {}, 0.5, 1, false);
  heap.setup.contact = {laws::ConstantRestitution{0.8}, {.friction = 0.13, .beta = 0.34}};
  compare(one, heap.setup, 60, 400);
}
