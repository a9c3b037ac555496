#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>
#include <catch2/catch.hpp>

#include "laws/walton.hpp"

using namespace chute;
using namespace chute::laws;

namespace {

/// Random collisions of solid spheres and other round things.
class Dice {
 public:
  double uniform(double a, double b) { return a + (b - a) * boost::random::uniform_01<double>{}(engine_); }
  template <int K>
  Vec<K> normal() {
    Vec<K> a;
    for (int k = 0; k < K; ++k) a[k] = normal_(engine_);
    return a;
  }
  template <int D>
  Collider<D> grain(double mass, double radius, double inertia) {
    return {normal<D>(), normal<turns<D>>(), radius, 1 / mass, 1 / inertia};
  }

 private:
  boost::random::mt19937_64 engine_{11};
  boost::random::normal_distribution<double> normal_;
};

template <int D>
Vec<turns<D>> moment(const Vec<D>& r, const Vec<D>& p) {
  if constexpr (D == 2)
    return {{r[0] * p[1] - r[1] * p[0]}};
  else
    return cross(r, p);
}

struct Worst {
  double momentum = 0, angular = 0, gain = -1, account = 0;
};

template <int D>
Worst collide_randomly(int count) {
  Dice dice;
  Worst worst;
  for (int k = 0; k < count; ++k) {
    const double mass[] = {std::exp(dice.uniform(-4, 4)), std::exp(dice.uniform(-4, 4))};
    const double radius[] = {std::exp(dice.uniform(-2, 2)), std::exp(dice.uniform(-2, 2))};
    const double inertia[] = {dice.uniform(0.3, 0.7) * mass[0] * radius[0] * radius[0],
                              dice.uniform(0.3, 0.7) * mass[1] * radius[1] * radius[1]};
    auto i = dice.grain<D>(mass[0], radius[0], inertia[0]), j = dice.grain<D>(mass[1], radius[1], inertia[1]);
    Vec<D> n = dice.normal<D>();
    n = (1 / norm(n)) * n;
    const Walton walton{dice.uniform(0, 1.5), dice.uniform(-1, 1)};
    const double e_n = dice.uniform(0, 1);
    const auto sums = [&](Vec<D>& p, Vec<turns<D>>& l) {
      double energy = 0;
      int at = 0;
      for (const auto* g : {&i, &j}) {
        const Vec<D> place = (at == 0 ? -radius[0] : radius[1]) * n;  // the contact is the origin
        p = p + mass[at] * g->velocity;
        l = l + moment<D>(place, mass[at] * g->velocity) + inertia[at] * g->spin;
        energy += 0.5 * mass[at] * dot(g->velocity, g->velocity) + 0.5 * inertia[at] * dot(g->spin, g->spin);
        ++at;
      }
      return energy;
    };
    Vec<D> p{}, p_after{};
    Vec<turns<D>> l{}, l_after{};
    const double energy = sums(p, l);
    const auto done = walton(n, e_n, i, j);
    const double after = sums(p_after, l_after);
    const double scale = std::sqrt(2 * energy * (mass[0] + mass[1]));
    worst.momentum = std::max(worst.momentum, norm(p_after - p) / scale);
    worst.angular = std::max(worst.angular, norm(l_after - l) / (scale * (radius[0] + radius[1])));
    worst.gain = std::max(worst.gain, (after - energy) / energy);
    worst.account =
        std::max(worst.account, std::abs(energy - after - done.normal_loss - done.shear_loss) / energy);
    REQUIRE(done.normal_loss >= 0);
    REQUIRE(done.shear_loss >= -1e-12 * energy);
  }
  return worst;
}

}  // namespace

TEST_CASE("10^6 random collisions conserve momentum and angular momentum and never gain energy") {
  for (const bool three : {false, true}) {
    const auto worst = three ? collide_randomly<3>(500000) : collide_randomly<2>(500000);
    WARN((three ? "3D" : "2D") << ", worst of 500000, relative: momentum " << worst.momentum
                               << ", angular momentum " << worst.angular << ", energy gained " << worst.gain
                               << ", account " << worst.account);
    CHECK(worst.momentum < 1e-13);
    CHECK(worst.angular < 1e-13);
    CHECK(worst.gain < 1e-13);
    CHECK(worst.account < 1e-12);
  }
}

TEST_CASE("(2.28) to (2.31), corrected, for solid spheres") {
  const double e_n = 0.89, mu = 0.21, beta = 0.39;
  const double psi_0 = 3.5 * mu * (1 + e_n) / (1 + beta);
  for (const double psi : {0.0, 0.3, 0.99 * psi_0, 1.01 * psi_0, 1.39, 4.0}) {
    // unequal solid spheres, part of the slip from the spins; n = x, so s = −y
    Collider<2> i{{{1, 0.5 * psi}}, {{0.3 * psi / 2}}, 2, 1 / 3.0, 2.5 / (3.0 * 4)};
    Collider<2> j{{}, {{0.2 * psi / 0.5}}, 0.5, 1 / 0.7, 2.5 / (0.7 * 0.25)};
    const auto done = Walton{mu, beta}(Vec<2>{{1, 0}}, e_n, i, j);
    CHECK(j.velocity[0] - i.velocity[0] == Approx(e_n));
    const double psi_f = -surface_slip(Vec<2>{{1, 0}}, i, j)[1];
    CHECK(done.sliding == (psi > psi_0));
    CHECK(psi_f == Approx(psi > psi_0 ? psi - 3.5 * mu * (1 + e_n) : -beta * psi).margin(1e-12));
  }
  CHECK(psi_0 == Approx(0.9994).epsilon(1e-4));
}

TEST_CASE("3D collisions in a plane are the 2D ones; a fixed grain does not move") {
  Dice dice;
  for (int k = 0; k < 1000; ++k) {
    auto i = dice.grain<2>(1, 0.5, 0.1), j = dice.grain<2>(2, 0.3, 0.07);
    if (k % 2) j.inverse_mass = j.inverse_inertia = 0;
    Collider<3> a{{{i.velocity[0], i.velocity[1], 0}},
                  {{0, 0, i.spin[0]}},
                  i.radius,
                  i.inverse_mass,
                  i.inverse_inertia};
    Collider<3> b{{{j.velocity[0], j.velocity[1], 0}},
                  {{0, 0, j.spin[0]}},
                  j.radius,
                  j.inverse_mass,
                  j.inverse_inertia};
    Vec<2> n = dice.normal<2>();
    n = (1 / norm(n)) * n;
    const auto resting = j;
    const Walton walton{0.3, 0.4};
    walton(n, 0.8, i, j);
    walton(Vec<3>{{n[0], n[1], 0}}, 0.8, a, b);
    CHECK(a.velocity[0] == Approx(i.velocity[0]).margin(1e-14));
    CHECK(a.velocity[1] == Approx(i.velocity[1]).margin(1e-14));
    CHECK(a.spin[2] == Approx(i.spin[0]).margin(1e-13));
    CHECK(b.spin[2] == Approx(j.spin[0]).margin(1e-13));
    if (k % 2) CHECK((j.velocity == resting.velocity && j.spin == resting.spin));
  }
}

TEST_CASE("Restitution laws and the contact-time cut-off of 2.1.3") {
  const PowerLawRestitution power{0.1, 2, 0.2};
  CHECK(power(2) == Approx(0.9));
  CHECK(power(-64) == Approx(0.8));  // 32 times faster: twice the loss
  CHECK(power(1e9) == 0);
  CHECK(power(0) == 1);
  CHECK(HardeningRestitution{3}(9) == Approx(0.5));
  const ContactTimeCutoff cutoff{1e-3};
  CHECK(cutoff(0.7, 2e-3, 5) == 0.7);
  CHECK(cutoff(0.7, 5, 0.5e-3) == 1);
  CHECK(ContactTimeCutoff{}(0.7, 0, 0) == 0.7);
  Collider<2> i{{{1, 0}}, {}, 1, 1, 2.5}, j{{}, {}, 1, 0, 0};
  Walton{}(Vec<2>{{1, 0}}, Restitution(power), i, j);
  CHECK(i.velocity[0] == Approx(-power(1)));
  // grains that part already are left alone
  const auto before = i;
  Walton{0.5, 0.5}(Vec<2>{{1, 0}}, 0.5, i, j);
  CHECK(i.velocity == before.velocity);
}
