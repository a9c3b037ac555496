#include <catch2/catch.hpp>

#include "core/random.hpp"
#include "two_grains.hpp"

namespace gas_tests {
using namespace chute;
using namespace chute::test;

namespace {

constexpr double stiffness = 1e5;
const double t_n = Oscillator{stiffness, 0, 0.5}.contact_time();  // of two discs of unit mass

/// Grains of unit mass and diameter in a box that is periodic in both directions.
template <int D>
Grains<D> gas(std::int64_t n = 64, double spacing = 1.4) {
  Random random(5, Purpose::start);
  Grains<D> grains;
  const auto side = static_cast<std::int64_t>(std::llround(std::pow(n, 1.0 / D)));
  for (std::int64_t i = 0; i < n; ++i) {
    Vec<D> place, velocity;
    auto rest = i;
    for (int k = 0; k < D; ++k, rest /= side) {
      place[k] = (static_cast<double>(rest % side) + 0.5) * spacing;
      velocity[k] = random.normal();
    }
    add_ball<D>(grains, place, velocity, 0.5, 1);
  }
  return grains;
}

template <int D>
soft::SoftSetup<D> box(const laws::ContactLaws& contact, double dt, soft::Scheme scheme, std::int64_t n = 64,
                       double spacing = 1.4) {
  auto made = setup<D>(contact, dt, 1, scheme);
  for (int k = 0; k < D; ++k) made.domain.length[k] = std::round(std::pow(n, 1.0 / D)) * spacing;
  return made;
}

struct Drift {
  double total, per_sample;  ///< relative to the energy of the start; the latter root mean square
  std::size_t contacts;
};

/// Energy of the elastic gas, looked at every 20 contact times until so many contacts have begun.
Drift drift(soft::Scheme scheme, double steps_per_contact, std::size_t contacts) {
  soft::SoftEngine<2> engine(gas<2>(), box<2>(smooth(stiffness, 0), t_n / steps_per_contact, scheme));
  engine.collect_impacts(true);
  const double start = engine.energy().stored();
  double before = start, squares = 0;
  std::size_t seen = 0, samples = 0;
  for (; seen < contacts; ++samples) {
    engine.advance_to(engine.step() + std::llround(20 * steps_per_contact));
    seen += engine.take_impacts().size();
    const double now = engine.energy().stored();
    squares += (now - before) * (now - before);
    before = now;
  }
  return {before / start - 1, std::sqrt(squares / static_cast<double>(samples)) / start, seen};
}

template <int D>
Vec<D> momentum(const Grains<D>& g) {
  Vec<D> sum;
  for (std::size_t i = 0; i < g.moving; ++i) sum = sum + g.mass[i] * g.speed(i);
  return sum;
}

template <int D>
void check_momentum(const laws::ContactLaws& contact, soft::Scheme scheme, std::int64_t n, double spacing) {
  auto grains = gas<D>(n, spacing);
  for (std::size_t i = 0; i < grains.size(); ++i)
    for (auto& spin : grains.spin) spin[i] = 3.0 - 0.1 * static_cast<double>(i);
  double scale = 0;
  for (std::size_t i = 0; i < grains.moving; ++i) scale += norm(grains.speed(i));
  const auto start = momentum(grains);
  soft::SoftEngine<D> engine(grains, box<D>(contact, t_n / 50, scheme, n, spacing));
  engine.collect_impacts(true);
  const std::int64_t steps = 4000;
  engine.advance_to(steps);
  CHECK(engine.take_impacts().size() > 20);
  // A force is added to one grain and taken from the other, so the sum is off by the rounding of each
  // addition: at most 2^-53 of a velocity per grain and step, and a scheme's pass has some ten additions.
  const double rounding = 10 * std::pow(2.0, -53) * static_cast<double>(steps) * scale;
  CHECK(norm(momentum(engine.state()) - start) < rounding);
  CHECK(rounding < 1e-9 * scale);
}

}  // namespace

TEST_CASE("a frictionless elastic gas keeps its energy over 10^4 contacts") {
  for (const auto scheme : {soft::Scheme::gear5, soft::Scheme::verlet}) {
    const auto d = drift(scheme, 50, 10'000);
    INFO("drift " << d.total);
    CHECK(d.contacts >= 10'000);
    CHECK(std::abs(d.total) < 1e-3);
  }
}

// A contact that begins within a step costs an energy error of second order, either sign. The mean square
// over samples shows the size of one such error; the sum of 10^4 random ones would show mostly luck.
TEST_CASE("the energy error of the elastic gas falls with the step") {
  for (const auto scheme : {soft::Scheme::gear5, soft::Scheme::verlet}) {
    const double rough = drift(scheme, 25, 3000).per_sample, usual = drift(scheme, 50, 3000).per_sample,
                 fine = drift(scheme, 100, 3000).per_sample;
    INFO("t_n/25: " << rough << ", t_n/50: " << usual << ", t_n/100: " << fine);
    CHECK(rough > 2 * usual);
    CHECK(usual > 2 * fine);
  }
}

TEST_CASE("momentum is kept to rounding, with damping and friction too") {
  const auto scheme = GENERATE(soft::Scheme::gear5, soft::Scheme::verlet);
  const laws::ContactLaws rough{laws::SpringDashpot::from_restitution(stiffness, 0.7),
                                laws::RegularisedCoulomb{50, 0.4, laws::MassScaling::none, {}}};
  check_momentum<2>(smooth(stiffness, 0), scheme, 64, 1.25);
  check_momentum<2>(rough, scheme, 64, 1.25);
  check_momentum<3>(rough, scheme, 125, 1.2);
}

}  // namespace gas_tests
