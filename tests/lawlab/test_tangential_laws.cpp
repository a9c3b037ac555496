#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "laws/list.hpp"

using namespace chute;
using namespace chute::laws;

namespace {

/// A contact that is slipped along a given path at a given normal force; sums up what the motion puts in.
template <class Law, int T = 1>
class Bench {
 public:
  explicit Bench(const Law& law) : law_(law) {}
  double work = 0;

  /// Slips by `way` in `steps` equal parts; the force afterwards.
  Vec<T> slip(const Vec<T>& way, double normal_force, int steps = 1, double overlap = 1) {
    for (int k = 0; k < steps; ++k) {
      const laws::Slip<T> now{(1.0 / steps) * way, normal_force, overlap, Pair(1, 1)};
      const auto force = law_(now, memory_);
      work -= 0.5 * dot(force_ + force, now.way);
      force_ = force;
      last_ = now;
    }
    return force_;
  }
  double stored() const { return law_.energy(last_, memory_); }

 private:
  Law law_;
  typename Law::template Memory<T> memory_;
  Vec<T> force_{};
  laws::Slip<T> last_{{}, 0, 0, Pair(1, 1)};
};

constexpr PairCoefficient stiffness(double k) { return {k, 0, 0, 0}; }

}  // namespace

TEST_CASE("(3.10): Coulomb's law takes the direction of the slip and nothing else") {
  const Coulomb law{0.5};
  CHECK(law(Vec<1>{{1e-9}}, 4, 1)[0] == -2);
  CHECK(law(Vec<1>{{-7}}, -4, 1)[0] == 2);
  CHECK(law(Vec<1>{{0}}, 4, 1)[0] == 0);
  const auto f = law(Vec<3>{{3, 0, 4}}, 10, 1);
  CHECK(f[0] == Approx(-3));
  CHECK(f[2] == Approx(-4));
  CHECK(norm(law(Vec<3>{}, 10, 1)) == 0);
}

TEST_CASE("(3.11): viscous friction, with the mass conventions") {
  CHECK(Viscous{3, MassScaling::none}(Vec<1>{{2}}, 100, 0.5)[0] == -6);
  CHECK(Viscous{3, MassScaling::damping}(Vec<1>{{2}}, 100, 0.5)[0] == -3);
  CHECK(Viscous{3, MassScaling::none}(Vec<3>{{0, 1, -2}}, 0, 1)[2] == 6);
}

TEST_CASE("(3.13) and (3.25): a spring, with and without the cap") {
  Bench<CundallStrack> free(CundallStrack{stiffness(10), {0.5, false}}),
      capped(CundallStrack{stiffness(10), {0.5, true}});
  // sticking: a spring
  CHECK(free.slip({{0.05}}, 2)[0] == Approx(-0.5));
  CHECK(capped.slip({{0.05}}, 2)[0] == Approx(-0.5));
  // far into sliding: both hold μ F_n
  CHECK(free.slip({{0.95}}, 2, 100)[0] == Approx(-1));
  CHECK(capped.slip({{0.95}}, 2, 100)[0] == Approx(-1));
  // back by 0.15: the capped spring, 0.1 long, has turned round; the other still pulls
  CHECK(free.slip({{-0.15}}, 2, 100)[0] == Approx(-1));
  CHECK(capped.slip({{-0.15}}, 2, 100)[0] == Approx(0.5));
  // the capped one has dissipated what it slid; the other gives everything back at constant F_n
  CHECK(capped.work - capped.stored() == Approx(0.9 * 1).epsilon(1e-3));
  CHECK(free.work - free.stored() == Approx(0).margin(1e-3));
  free.slip({{-0.85}}, 2, 100);
  CHECK(free.work == Approx(0).margin(1e-3));
  // where F_n has risen meanwhile, it gives back more than it took
  Bench<CundallStrack> gain(CundallStrack{stiffness(10), {0.5, false}});
  gain.slip({{1}}, 2, 1000);
  gain.slip({{-1}}, 4, 1000);
  CHECK(gain.work < -0.8);
}

TEST_CASE("(3.22): the spring stiffens with √ξ") {
  Bench<MindlinSpring> printed(MindlinSpring{stiffness(10), {100, true}, false});
  CHECK(printed.slip({{0.1}}, 2, 1, 0.25)[0] == Approx(-0.5));
  CHECK(printed.slip({{0.0}}, 2, 1, 1.0)[0] == Approx(-1));
  CHECK(printed.stored() == Approx(0.05));  // more than the work: this is where energy comes from nothing
  CHECK(printed.work == Approx(0.025));
  Bench<MindlinSpring> honest(MindlinSpring{stiffness(10), {100, true}, true});
  CHECK(honest.slip({{0.1}}, 2, 1, 0.25)[0] == Approx(-0.5));
  CHECK(honest.slip({{0.0}}, 2, 1, 1.0)[0] == Approx(-0.5));  // loaded: the force stays
  CHECK(honest.stored() == Approx(0.0125));
  CHECK(honest.slip({{0.0}}, 2, 1, 0.25)[0] == Approx(-0.25));  // unloaded: it falls with √ξ
  CHECK(honest.stored() == Approx(0.00625));
  const MindlinSpring per_radius{{0, 0, 0, 10}, {1, true}};
  CHECK(per_radius.stiffness_at(0.25, Pair(1, 4)) == Approx(10));
}

TEST_CASE("(3.22): no history of slip, load and overlap gets energy out of the shrinking spring") {
  // Loops of ξ(t), F_n(t) ∝ ξ^{3/2} and the slip, each with its own phase, twice round so that the second
  // starts with a stretched spring. What comes out is −(work − change of what is stored).
  const auto gain = [](bool shrink, double friction) {
    double most = 0;
    for (int phase = 0; phase < 24; ++phase) {
      Bench<MindlinSpring> law(MindlinSpring{stiffness(10), {friction, true}, shrink});
      constexpr int steps = 20000;
      for (int k = 0; k < 2 * steps; ++k) {
        const double t = 2 * std::numbers::pi * k / steps, xi = 1 - 0.9 * std::cos(t + phase * 0.26);
        const double way = 0.3 * (std::sin(t + 1e-4) - std::sin(t));
        law.slip({{way * 2 * std::numbers::pi / steps / 1e-4}}, 2 * std::pow(xi, 1.5), 1, xi);
      }
      most = std::max(most, law.stored() - law.work);
    }
    return most;
  };
  CHECK(gain(false, 1e6) > 0.1);  // as printed it is a machine
  CHECK(gain(true, 1e6) < 1e-5);
  CHECK(gain(true, 0.5) < 1e-5);
}

TEST_CASE("(3.19): a saw-tooth that is odd in ζ") {
  Bench<SawTooth> law(SawTooth{0.5, 0.1});
  CHECK(law.slip({{0.05}}, 2)[0] == Approx(-0.5));
  CHECK(law.slip({{0.04999}}, 2)[0] == Approx(-0.9999));
  CHECK(law.slip({{0.00002}}, 2)[0] == Approx(-0.0001).margin(1e-9));
  Bench<SawTooth> back(SawTooth{0.5, 0.1});
  CHECK(back.slip({{-0.25}}, 2)[0] == Approx(0.5));
  Bench<SawTooth> far(SawTooth{0.5, 0.1});
  far.slip({{1.05}}, 2, 100000);
  CHECK(far.work == Approx(10 * 0.5 * 0.1 + 0.5 * 0.25 * 0.1).epsilon(1e-3));  // ½ μ F_n ζ_0 a tooth
  CHECK(far.work == Approx(far.stored()).epsilon(1e-3));
}

TEST_CASE("(3.17), (3.18): the exact step against the printed Euler steps, through two reversals") {
  const double k = 10, L = 1;
  // the printed scheme in its own words, with tiny steps
  double F = 0, F_star = 0, direction = 1;
  std::vector<double> printed;
  const auto euler = [&](double way, int steps) {
    const double d = way / steps;
    if (d * direction < 0) F_star = F, direction = -direction;
    for (int n = 0; n < steps; ++n) {
      const double bracket =
          direction > 0 ? 1 - (F - F_star) / (L - F_star) : 1 - (F_star - F) / (L + F_star);
      F += k * std::cbrt(std::clamp(bracket, 0.0, 1.0)) * d;
      F = std::clamp(F, -L, L);
    }
    printed.push_back(F);
  };
  Bench<WaltonBraunMindlin> law(WaltonBraunMindlin{stiffness(k), 0.5});
  std::size_t n = 0;
  for (const double way : {0.08, -0.05, 0.03, -0.30, 0.02}) {
    euler(way, 200000);
    const auto coarse = law.slip({{way}}, 2, 3);  // few steps: F_n is constant, so they are exact
    INFO("after " << way << ": " << -coarse[0] << ", printed scheme " << printed[n]);
    CHECK(-coarse[0] == Approx(printed[n]).margin(2e-5));
    ++n;
  }
}

TEST_CASE("(3.18): what unloading gives back is what was stored") {
  for (const double depth : {0.02, 0.08, 0.12}) {
    Bench<WaltonBraunMindlin> law(WaltonBraunMindlin{stiffness(10), 0.5});
    law.slip({{depth}}, 2, 2000);
    const double stored = law.stored(), work = law.work;
    CHECK(stored < work);
    CHECK(stored > 0.5 * std::pow(law.slip({{0}}, 2)[0], 2) / 10);  // softer on the way back than k_s0
    double given = 0;
    for (int k = 0; k < 100000; ++k) {
      const double before = law.work;
      const double f = law.slip({{-1e-5}}, 2)[0];
      if (f > 0) break;
      given -= law.work - before;
    }
    CHECK(given == Approx(stored).epsilon(1e-3));
  }
  // a closed loop dissipates
  Bench<WaltonBraunMindlin> loop(WaltonBraunMindlin{stiffness(10), 0.5});
  for (int k = 0; k < 4; ++k) loop.slip({{k % 2 ? -0.1 : 0.1}}, 2, 1000);
  CHECK(loop.work - loop.stored() > 0.01);
}

TEST_CASE("In 3D a slip along one line is the 2D law; across it the limit holds") {
  const Vec<3> e{{0.6, 0.8, 0}};
  const auto compare = [&](const auto& law) {
    using Law = std::decay_t<decltype(law)>;
    Bench<Law, 1> line(law);
    Bench<Law, 3> space(law);
    for (const double way : {0.03, 0.09, -0.06, -0.2, 0.11}) {
      const double f = line.slip({{way}}, 2, 7)[0];
      const auto g = space.slip(way * e, 2, 7);
      CHECK(dot(g, e) == Approx(f).margin(1e-12));
      CHECK(norm(g) == Approx(std::abs(f)).margin(1e-12));
    }
    space.slip({{0.3, -0.5, 0}}, 2, 50);
    CHECK(norm(space.slip({{0.3, -0.5, 0}}, 2, 50)) <= Approx(1));
  };
  compare(CundallStrack{stiffness(10), {0.5, true}});
  compare(CundallStrack{stiffness(10), {0.5, false}});
  compare(MindlinSpring{stiffness(10), {0.5, true}});
  compare(WaltonBraunMindlin{stiffness(10), 0.5});
  compare(SawTooth{0.5, 0.013});
}
