#include <catch2/catch.hpp>

#include "small_chute.hpp"

namespace energy_tests {
using namespace chute;
using namespace chute::test;

namespace {

struct Balance {
  double gravity_work, residual;
};

/// What gravity put in and what neither is stored nor counted as loss. All but the losses is computed here,
/// from places and velocities.
Balance balance(double steps_per_contact, double duration, soft::Scheme scheme) {
  const SmallChute chute;
  const auto s = chute.setup(steps_per_contact, scheme);
  const auto start = chute.grains();
  soft::SoftEngine<2> engine(start, s);
  const auto moving_energy = [](const Grains<2>& g) {
    double sum = 0;
    for (std::size_t i = 0; i < g.moving; ++i)
      sum += 0.5 * g.mass[i] * dot(g.speed(i), g.speed(i)) + 0.5 * g.inertia[i] * g.spin[0][i] * g.spin[0][i];
    return sum;
  };
  engine.advance_to(std::llround(duration / s.time_step));
  const auto e = engine.energy();
  const auto view = engine.grains();
  double work = 0, elastic = 0;
  for (std::size_t i = 0; i < start.moving; ++i)
    for (int k = 0; k < 2; ++k)
      work += start.mass[i] * s.gravity[k] *
              (view.unwrapped(i, static_cast<std::size_t>(k)) - start.position[k][i]);
  for (const auto& c : engine.contacts()) elastic += 0.5 * SmallChute::stiffness * c.overlap * c.overlap;
  const double gained = moving_energy(engine.state()) - moving_energy(start) + elastic;
  CHECK(e.gravity_work == Approx(work).epsilon(1e-10));
  CHECK(e.stored() - e.start == Approx(gained).epsilon(1e-8).margin(1e-8));
  CHECK(e.normal_loss > 0);
  CHECK(e.shear_loss > 0);
  CHECK(e.residual() == Approx(work - gained - e.normal_loss - e.shear_loss).margin(1e-8 * work));
  return {work, work - gained - e.normal_loss - e.shear_loss};
}

}  // namespace

// Losses are power times step, summed at the predicted velocities. Where grains slip at the rate that one
// step resolves (γ_s 7/2 δt / m_eff = 0.1 here at t_n/50) gear5 closes the account to a thousandth of
// gravity's work.
TEST_CASE("what gravity puts in is stored or lost, and the residual falls with the step") {
  for (const double duration : {5.0, 20.0}) {
    const auto usual = balance(50, duration, soft::Scheme::gear5),
               fine = balance(100, duration, soft::Scheme::gear5),
               finest = balance(200, duration, soft::Scheme::gear5);
    INFO("residual over work: " << usual.residual / usual.gravity_work << ", "
                                << fine.residual / fine.gravity_work << ", "
                                << finest.residual / finest.gravity_work);
    CHECK(usual.gravity_work > 50);
    CHECK(std::abs(usual.residual) < 1e-3 * usual.gravity_work);
    CHECK(std::abs(fine.residual) < 0.5 * std::abs(usual.residual));
    CHECK(std::abs(finest.residual) < 0.5 * std::abs(fine.residual));
  }
}

TEST_CASE("the account still closes after a million steps") {
  const double million = 1e6 * SmallChute::contact_time() / 50;
  const auto usual = balance(50, million, soft::Scheme::gear5),
             fine = balance(100, million, soft::Scheme::gear5);
  INFO("residual over work: " << usual.residual / usual.gravity_work << ", "
                              << fine.residual / fine.gravity_work);
  CHECK(usual.gravity_work > 300);
  CHECK(std::abs(usual.residual) < 1e-3 * usual.gravity_work);
  CHECK(std::abs(fine.residual) < 0.5 * std::abs(usual.residual));
}

// Verlet's forces see the velocity of the half step before, at which sliding grains are faster: losses are
// counted high in first order.
TEST_CASE("Verlet closes the account in first order") {
  const auto usual = balance(50, 20, soft::Scheme::verlet), finest = balance(200, 20, soft::Scheme::verlet);
  INFO("residual over work: " << usual.residual / usual.gravity_work << ", "
                              << finest.residual / finest.gravity_work);
  CHECK(std::abs(usual.residual) < 0.05 * usual.gravity_work);
  CHECK(std::abs(finest.residual / finest.gravity_work) <
        0.5 * std::abs(usual.residual / usual.gravity_work));
}

TEST_CASE("a head-on collision loses 1/2 m_eff v² (1 − e_n²), nothing by shear") {
  const double e_n = 0.7, v = 1.5;
  Grains<2> grains;
  add_ball<2>(grains, {{0, 0}}, {{v, 0}}, 0.5, 1);
  add_ball<2>(grains, {{1.01, 0}}, {{0, 0}}, 0.5, 2);
  const laws::ContactLaws contact{laws::SpringDashpot::from_restitution(1e5, e_n),
                                  laws::RegularisedCoulomb{100, 0.5, laws::MassScaling::none, {}}};
  soft::SoftEngine<2> engine(grains, setup<2>(contact, 5e-6, 1));
  REQUIRE(through_one_contact(engine) > 0);
  const auto e = engine.energy();
  const double m_eff = 2.0 / 3;
  CHECK(e.start == Approx(0.5 * v * v));
  CHECK(e.normal_loss == Approx(0.5 * m_eff * v * v * (1 - e_n * e_n)).epsilon(1e-3));
  CHECK(e.shear_loss == 0);
  CHECK(e.elastic == 0);
}

}  // namespace energy_tests
