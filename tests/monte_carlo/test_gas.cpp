// The gas of hard discs and spheres: pressure from the value of g(r) at contact, against virial series and theory.
#include <catch2/catch.hpp>

#include "core/estimate.hpp"
#include "gas.hpp"
#include "measure/contact_value.hpp"

using namespace chute;
using namespace chute::test;

namespace {

/// Z = βP/n of hard discs from their ten known virial coefficients (Clisby & McCoy 2006), the rest as a geometric series.
double virial_discs(double phi) {
  constexpr std::array B{1.0, 0.782004, 0.532232, 0.333556, 0.198843, 0.114873, 0.064993, 0.036219, 0.019954};
  constexpr double tail = 0.55;
  const double x = 2 * phi;
  double z = 1, power = x;
  for (const double b : B) z += b * power, power *= x;
  return z + B.back() * tail * power / (1 - tail * x);
}
double carnahan_starling(double phi) { return (1 + phi + phi * phi - phi * phi * phi) / std::pow(1 - phi, 3); }

/// Z from samples of a run.
template <int D>
Estimate pressure(int side, double phi, bool serial, int samples, std::uint64_t seed = 1) {
  Gas<D> gas(side, phi);
  gas.setup.serial = serial, gas.setup.seed = seed;
  MonteCarloEngine<D> engine(gas.grains, gas.setup);
  measure::PairDistances pairs(1.5, 100);
  engine.advance_to(600);
  for (int s = 0; s < samples; ++s) {
    engine.advance_to(600 + 4 * s);
    pairs.add(engine.grains());
  }
  const auto contact = pairs.contact_value();
  const double factor = D == 2 ? 2 * phi : 4 * phi;
  return {1 + factor * contact.mean, factor * contact.error.value_or(0)};
}

}  // namespace

TEST_CASE("the pressure of hard discs is that of their virial series, drawn serially or by blocks") {
  for (const double phi : {0.2, 0.5})
    for (const bool serial : {true, false}) {
      const auto z = pressure<2>(24, phi, serial, 1200);
      CAPTURE(phi, serial, z.mean, *z.error, virial_discs(phi));
      CHECK(z.mean == Approx(virial_discs(phi)).epsilon(0.01));
    }
}

TEST_CASE("the pressure of hard spheres is Carnahan's and Starling's") {
  for (const double phi : {0.2, 0.4}) {
    const auto z = pressure<3>(9, phi, false, 500);
    CAPTURE(phi, z.mean, *z.error, carnahan_starling(phi));
    CHECK(z.mean == Approx(carnahan_starling(phi)).epsilon(0.012));
  }
}
