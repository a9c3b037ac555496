#pragma once
#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>
#include <cmath>
#include <numbers>

#include "engines/soft/soft_engine.hpp"

/// Many random impacts of two spheres at once: pairs far apart from each other in one engine.
namespace chute::test {

/// What a pair has: kinetic energy in its centre-of-mass system, momentum, angular momentum about the first
/// contact.
struct PairTotals {
  double energy = 0;
};

template <int D>
class ManyImpacts {
 public:
  explicit ManyImpacts(std::uint64_t seed) : engine_(seed) {}

  /// Largest ratio of a pair's energy after its impact to that before, over `count` impacts with random
  /// sizes, masses, spins and obliqueness, from head-on to tan ϑ = 1000; in every fourth the second grain is
  /// fixed. The stiffness of `law` should suit masses and speeds of about 1. `steps`: per shortest contact
  /// time.
  double worst_gain(const laws::ContactLaws& law, std::size_t count, double steps) {
    constexpr std::size_t batch = 2000;
    double worst = 0;
    for (std::size_t done = 0; done < count; done += batch) worst = std::max(worst, run(law, batch, steps));
    return worst;
  }

 private:
  boost::random::mt19937_64 engine_;
  boost::random::normal_distribution<double> normal_;
  double uniform(double a, double b) { return a + (b - a) * boost::random::uniform_01<double>{}(engine_); }

  Vec<D> direction() {
    Vec<D> a;
    for (int k = 0; k < D; ++k) a[k] = normal_(engine_);
    return (1 / norm(a)) * a;
  }

  double run(const laws::ContactLaws& law, std::size_t pairs, double steps) {
    struct Pair {
      double m_i, m_j, R_i, R_j;
      bool fixed;
      Vec<D> n, v;  // v_i − v_j; j rests
      Vec<turns<D>> w_i, w_j;
      double reduced() const { return fixed ? m_i : m_i * m_j / (m_i + m_j); }
    };
    std::vector<Pair> all(pairs);
    double shortest = INFINITY;
    for (std::size_t k = 0; k < pairs; ++k) {
      auto& p = all[k];
      p.fixed = k % 4 == 0;
      p.m_i = std::exp(uniform(-1, 1)), p.m_j = std::exp(uniform(-1, 1));
      p.R_i = std::exp(uniform(-0.5, 0.5)), p.R_j = std::exp(uniform(-0.5, 0.5));
      p.n = direction();
      Vec<D> side = direction();
      side = side - dot(side, p.n) * p.n;
      side = (1 / norm(side)) * side;
      const double psi = uniform(0, 1) < 0.5 ? uniform(0, 5) : std::exp(uniform(0, std::log(1000.0)));
      const double theta = std::atan(psi), speed = uniform(0.5, 2);
      p.v = speed * (std::cos(theta) * p.n + std::sin(theta) * side);
      const double turning = uniform(0, 1) < 0.5 ? 0 : 2 * speed;
      for (int c = 0; c < turns<D>; ++c)
        p.w_i[c] = turning * normal_(engine_), p.w_j[c] = p.fixed ? 0 : turning * normal_(engine_);
      const double t_n =
          laws::normal_impact(law, speed, {p.reduced(), p.R_i * p.R_j / (p.R_i + p.R_j)}).contact_time;
      shortest = std::min(shortest, t_n);
    }
    soft::SoftSetup<D> setup;
    setup.laws = law;
    setup.time_step = shortest / steps;
    setup.skins = {0.05, 1};
    setup.deepest_overlap = INFINITY;
    Grains<D> grains;
    const auto place = [&](std::size_t k) {
      Vec<D> r;
      r[0] = 30.0 * static_cast<double>(k % 50), r[1] = 30.0 * static_cast<double>(k / 50);
      return r;
    };
    const auto put = [&](const Vec<D>& r, double R, double m, const Vec<D>& v, const Vec<turns<D>>& w,
                         bool moves) {
      grains.add(r, R, m, 0.4 * m * R * R, moves);
      for (int c = 0; c < D; ++c) grains.velocity[c].back() = v[c];
      for (int c = 0; c < turns<D>; ++c) grains.spin[c].back() = w[c];
    };
    std::vector<std::size_t> second(pairs);
    for (std::size_t k = 0; k < pairs; ++k) {
      const auto& p = all[k];
      const double lead = setup.time_step * uniform(0.1, 1);
      put(place(k) - (p.R_i + p.R_j) * p.n - lead * p.v, p.R_i, p.m_i, p.v, p.w_i, true);
    }
    for (const bool fixed : {false, true})
      for (std::size_t k = 0; k < pairs; ++k)
        if (all[k].fixed == fixed) {
          second[k] = grains.size();
          put(place(k), all[k].R_j, all[k].m_j, {}, all[k].w_j, !fixed);
        }
    soft::SoftEngine<D> engine(std::move(grains), setup);
    do engine.advance_to(engine.step() + 50);
    while (!engine.contacts().empty());

    double worst = 0;
    const auto& g = engine.state();
    const auto energy = [&](const Pair& p, const Vec<D>& dv, const Vec<turns<D>>& a, const Vec<turns<D>>& b) {
      return 0.5 * p.reduced() * dot(dv, dv) + 0.2 * p.m_i * p.R_i * p.R_i * dot(a, a) +
             (p.fixed ? 0 : 0.2 * p.m_j * p.R_j * p.R_j * dot(b, b));
    };
    for (std::size_t k = 0; k < pairs; ++k) {
      const auto& p = all[k];
      Vec<turns<D>> a, b;
      for (int c = 0; c < turns<D>; ++c) a[c] = g.spin[c][k], b[c] = g.spin[c][second[k]];
      const double ratio = energy(p, g.speed(k) - g.speed(second[k]), a, b) / energy(p, p.v, p.w_i, p.w_j);
      worst = std::max(worst, ratio);
    }
    return worst;
  }
};

}  // namespace chute::test
