#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/random.hpp"
#include "engines/hard/first_contact.hpp"

using namespace chute;
using chute::hard::Approach;
using chute::hard::first_contact;
using chute::hard::never;

namespace {

/// Distance less reach, in long double and straight from the definition.
template <int D>
long double overlap_free(const Approach<D>& a, long double t) {
  long double square = 0;
  for (int k = 0; k < D; ++k) {
    const long double x = a.d[k] + t * (a.v[k] + t * static_cast<long double>(a.a[k]) / 2);
    square += x * x;
  }
  return std::sqrt(square) - a.reach;
}

struct Found {
  double time;
  long double closest;  ///< least gap before it, for a miss the least of all: how close a call it was
};

/// First crossing by looking at `samples` times up to `horizon`: every dip between two samples is searched
/// for its bottom, every sign change is bisected.
template <int D>
Found brute_force(const Approach<D>& a, double horizon, int samples) {
  const auto at = [&](int i) { return static_cast<long double>(horizon) * i / samples; };
  long double closest = overlap_free(a, 0.0L);
  for (int i = 1; i <= samples; ++i) {
    long double low = at(i - 1), high = at(i);
    if (i + 1 <= samples && overlap_free(a, at(i)) > 0) {  // a dip below zero that no sample sees?
      long double l = at(i - 1), h = at(i + 1);
      if (overlap_free(a, at(i)) <= overlap_free(a, l) && overlap_free(a, at(i)) <= overlap_free(a, h)) {
        for (int n = 0; n < 100; ++n) {
          const long double x = l + (h - l) * 0.382L, y = l + (h - l) * 0.618L;
          (overlap_free(a, x) < overlap_free(a, y) ? h : l) = overlap_free(a, x) < overlap_free(a, y) ? y : x;
        }
        closest = std::min(closest, overlap_free(a, (l + h) / 2));
        if (overlap_free(a, (l + h) / 2) <= 0) high = (l + h) / 2;
      }
    }
    if (overlap_free(a, high) > 0) {
      closest = std::min(closest, overlap_free(a, high));
      continue;
    }
    for (int n = 0; n < 100; ++n) {
      const long double middle = (low + high) / 2;
      (overlap_free(a, middle) > 0 ? low : high) = middle;
    }
    // how deep it goes, if the hit is itself a close call
    long double deepest = 0;
    for (int n = 1; n <= 50; ++n) deepest = std::min(deepest, overlap_free(a, low + (at(1) * 2) * n / 50));
    return {static_cast<double>(low), std::min(closest, -deepest)};
  }
  return {never, closest};
}

template <int D>
Vec<D> direction(Random& random) {
  Vec<D> n;
  for (int k = 0; k < D; ++k) n[k] = random.normal();
  return (1 / norm(n)) * n;
}

/// A parabola through a chosen place at a chosen time and velocity there, so that a hit or a graze is near.
template <int D>
Approach<D> through(const Vec<D>& place, const Vec<D>& velocity, const Vec<D>& gravity, double time,
                    double reach) {
  Approach<D> a;
  a.a = gravity;
  a.v = velocity - time * gravity;
  a.d = place - time * velocity + 0.5 * time * time * gravity;
  a.reach = reach;
  return a;
}

struct Tally {
  int hits = 0, misses = 0, close = 0, wrong = 0;
  double worst = 0;
};

/// Compares with brute force; calls closer than `doubt` may go either way.
template <int D>
void compare(const Approach<D>& a, double horizon, int samples, double doubt, Tally& tally) {
  if (overlap_free(a, 0.0L) <= 0) return;
  const double t = first_contact(a);
  const auto truth = brute_force(a, horizon, samples);
  if (truth.closest < doubt) {
    ++tally.close;
    return;
  }
  const bool hit = truth.time < never;
  ++(hit ? tally.hits : tally.misses);
  if (hit != (t <= horizon)) {
    ++tally.wrong;
  } else if (hit) {
    tally.worst = std::max(tally.worst, std::abs(t - truth.time));
  }
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a parabola and a fixed bead: the first contact is the one that sampling finds", "",
                       ((int D), D), 2, 3) {
  Random random(1, Purpose::start);
  Tally tally;
  for (int n = 0; n < 50000; ++n) {
    Vec<D> gravity{};
    gravity[0] = random.uniform(0, 0.5);
    gravity[D - 1] = -random.uniform(0.2, 1);
    Vec<D> velocity = random.uniform(0, 3) * direction<D>(random);
    const Vec<D> place = random.uniform(0.2, 2) * direction<D>(random);
    const auto a = through(place, velocity, gravity, random.uniform(0, 3), 1);
    compare(a, 12, 400, 1e-7, tally);
  }
  CAPTURE(tally.hits, tally.misses, tally.close);
  CHECK(tally.wrong == 0);
  CHECK(tally.worst < 1e-9);
  CHECK(tally.hits > 10000);
  CHECK(tally.misses > 3000);
}

TEMPLATE_TEST_CASE_SIG("grazing: hit and miss are told apart down to a gap of 1e-12", "", ((int D), D), 2,
                       3) {
  // At the nearest point the velocity is along the bead; the parabola curves less than the bead, so this is
  // the least distance for a while around. Whether it is a hit is known by construction.
  Random random(2, Purpose::start);
  int wrong = 0, hits = 0, misses = 0;
  for (int n = 0; n < 20000; ++n) {
    Vec<D> gravity{};
    gravity[D - 1] = -1;
    Vec<D> normal = direction<D>(random);
    if (normal[D - 1] < 0.1) continue;  // above: gravity pulls towards the bead
    Vec<D> along = direction<D>(random);
    along = along - dot(along, normal) * normal;
    along = (random.uniform(1.2, 3) / norm(along)) *
            along;  // v² > g R: it does not fall onto the bead afterwards
    const double depth = std::pow(10, random.uniform(-12, -3)) * (random.uniform() < 0.5 ? 1 : -1);
    const auto a = through((1 - depth) * normal, along, gravity, random.uniform(0.05, 0.4), 1);
    if (overlap_free(a, 0.0L) < 1e-3L) continue;
    const auto truth_before = brute_force(a, 0.05, 20);
    if (truth_before.time < never) continue;
    const double t = first_contact(a);
    const bool hit = t < 0.8;
    ++(depth > 0 ? hits : misses);
    if (hit != (depth > 0)) {
      const auto truth = brute_force(a, 0.8, 2000);  // another part of the parabola may hit
      if ((truth.time < never) != hit) ++wrong;
    }
  }
  CHECK(wrong == 0);
  CHECK(hits > 3000);
  CHECK(misses > 3000);
}

TEST_CASE("a ball that bounces on top of a bead comes back after 2v/g, to the rounding of its place") {
  for (const double speed : {1.0, 1e-2, 1e-4, 1e-6}) {
    const Approach<2> a{{{0, 1}}, {{0, speed}}, {{0, -1}}, 1};
    CHECK(first_contact(a) == Approx(2 * speed).margin(4e-16 / speed));
  }
}

TEST_CASE("spheres that rounding left overlapping meet at once if they approach, and not while they part") {
  for (const double gap : {-1e-16, 0.0, 1e-16}) {
    const double reach = 1 - gap;
    CHECK(first_contact(Approach<2>{{{0, 1}}, {{0.3, -0.5}}, {{0, -1}}, reach}) <= 4e-16);
    CHECK(first_contact(Approach<2>{{{0, 1}}, {{0.3, -0.5}}, {{0, 0}}, reach}) <= 4e-16);
    CHECK(first_contact(Approach<2>{{{0, 1}}, {{0.3, 0.5}}, {{0, 0}}, reach}) == never);
    // thrown off sideways faster than the bead curves: it parts for good
    CHECK(first_contact(Approach<2>{{{0, 1}}, {{3, 1e-17}}, {{0, -1}}, reach}) == never);
    // at rest on the bead: the fall begins now
    CHECK(first_contact(Approach<2>{{{0, 1}}, {{0, 0}}, {{0, -1}}, reach}) <= 4e-8);
  }
}

TEST_CASE("two grains in free flight: the closed form of two spheres on straight lines") {
  Random random(3, Purpose::start);
  for (int n = 0; n < 20000; ++n) {
    // At contact the line between centres makes the angle `alpha` with the velocity: from there, back in
    // time.
    const Vec<3> e = direction<3>(random);
    Vec<3> s = direction<3>(random);
    s = s - dot(s, e) * e;
    s = (1 / norm(s)) * s;
    const double alpha = random.uniform(0, 1.5), speed = random.uniform(0.1, 10),
                 time = random.uniform(1e-3, 1e3);
    const Vec<3> at_contact = -std::cos(alpha) * e + std::sin(alpha) * s;
    const Approach<3> a{at_contact - (speed * time) * e, speed * e, {}, 1};
    CHECK(first_contact(a) == Approx(time).epsilon(1e-9));
    const Approach<3> miss{(1.001 / std::sin(alpha)) * at_contact - (speed * time) * e, speed * e, {}, 1};
    CHECK(first_contact(miss) == never);
  }
}

TEST_CASE("a bead far down the flight is met to rounding of the place, not of the square of the distance") {
  const double time = 1e3;
  const Vec<2> velocity{{300, -499.5}}, gravity{{0.1, -1}};
  const Vec<2> normal{{-0.6, 0.8}};
  const auto a = through(normal, velocity, gravity, time, 1);
  CHECK(first_contact(a) == Approx(time).epsilon(1e-12));
}
