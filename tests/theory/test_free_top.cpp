#include <catch2/catch.hpp>
#include <vector>

#include "common/error.hpp"
#include "theory/free_top.hpp"

using namespace chute;

TEST_CASE("a free top obeys Euler's equations, whatever the order of its moments") {
  std::vector<Vec<3>> orders;
  for (const auto& m : {Vec<3>{{0.2, 0.35, 0.5}}, Vec<3>{{0.35, 0.2, 0.5}}, Vec<3>{{0.5, 0.35, 0.2}},
                        Vec<3>{{0.2, 0.5, 0.35}}, Vec<3>{{0.5, 0.2, 0.35}}, Vec<3>{{0.35, 0.5, 0.2}}})
    orders.push_back(m);
  const double h = 1e-5;
  for (const auto& I : orders)
    for (const auto& start :
         {Vec<3>{{1.5, 0.3, 2}}, Vec<3>{{-1.5, 0.3, 0.4}}, Vec<3>{{0.2, -2, 0.7}}, Vec<3>{{0.5, 0.4, -3}}}) {
      const theory::FreeTop top(I, start);
      for (int k = 0; k < 3; ++k) {
        CHECK(top.at(0)[k] == Approx(start[k]).margin(1e-12));
        CHECK(top.at(top.period())[k] == Approx(start[k]).margin(1e-12));
      }
      // Half of it is no period: cn and sn have changed their signs, dn, which has half their period, has not.
      int same = 0, opposite = 0;
      for (int k = 0; k < 3; ++k) {
        same += top.at(top.period() / 2)[k] == Approx(start[k]).margin(1e-12);
        opposite += top.at(top.period() / 2)[k] == Approx(-start[k]).margin(1e-12);
      }
      CHECK(same == 1);
      CHECK(opposite == 2);
      for (const double t : {0.0, 0.4, 1.7}) {
        const auto w = top.at(t), rate = (1 / (2 * h)) * (top.at(t + h) - top.at(t - h));
        CHECK(I[0] * rate[0] == Approx((I[1] - I[2]) * w[1] * w[2]).margin(1e-8));
        CHECK(I[1] * rate[1] == Approx((I[2] - I[0]) * w[2] * w[0]).margin(1e-8));
        CHECK(I[2] * rate[2] == Approx((I[0] - I[1]) * w[0] * w[1]).margin(1e-8));
      }
    }
}

TEST_CASE("steady spins and symmetric tops have no such period") {
  CHECK_THROWS_AS(theory::FreeTop({{1, 2, 3}}, {{0, 0, 1}}), WorkError);
  CHECK_THROWS_AS(theory::FreeTop({{1, 1, 3}}, {{1, 0, 1}}), WorkError);
}
