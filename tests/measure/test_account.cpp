#include <catch2/catch.hpp>

#include "measure/account.hpp"

namespace account_tests {
using namespace chute;

namespace {

/// An account of which a part of gravity's work is not explained.
EnergyAccount off_by(double part) {
  EnergyAccount e;
  e.gravity_work = 200, e.normal_loss = 150, e.translation = 30, e.start = 10;
  e.shear_loss = 200 - 150 - (30 - 10) - part * 200;
  return e;
}

}  // namespace

TEST_CASE("the verdict on an energy account is that of its residual over what was turned over") {
  for (const auto& [part, word] : {std::pair{0.0, "good"},
                                   {0.0009, "good"},
                                   {-0.0009, "good"},
                                   {0.005, "fair"},
                                   {-0.02, "poor"},
                                   {0.13, "poor"}}) {
    const auto verdict = measure::judge_account(off_by(part));
    REQUIRE(verdict);
    CHECK(verdict->part == Approx(part).margin(1e-12));
    CHECK(verdict->residual == Approx(200 * part).margin(1e-9));
    CHECK(verdict->word == word);
    CHECK(verdict->poor() == (std::string(word) == "poor"));
  }
}

TEST_CASE("a gas without gravity is judged by what it lost, or had; what has no energy is not judged") {
  EnergyAccount gas;
  gas.start = 100, gas.translation = 40, gas.normal_loss = 59;
  const auto verdict = measure::judge_account(gas);
  REQUIRE(verdict);
  CHECK(verdict->part == Approx(1.0 / 100));
  CHECK_FALSE(measure::judge_account(EnergyAccount{}));
}

}  // namespace account_tests
