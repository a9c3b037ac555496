#include <catch2/catch.hpp>

#include "core/impact.hpp"

using namespace chute;

namespace {

/// One ball (grain 0), another (grain 1), and beads 2, 3, …; t_n = 0.01, so rolling ends after 0.04.
struct Story {
  TouchLog log{2, 0.01};
  Impact hit(double time, std::int64_t grain, std::int64_t bead, double gamma = 0) {
    Impact impact{};
    impact.time = time, impact.grain = grain, impact.bead = bead, impact.gamma = gamma;
    log.begin(impact);
    return impact;
  }
};

}  // namespace

TEST_CASE("the flight before an impact begins when the grain loses touch, whatever it touched") {
  Story s;
  const auto first = s.hit(1.0, 0, 2, -0.3);
  CHECK(std::isnan(first.flight));
  CHECK(std::isnan(first.gamma_before));
  CHECK_FALSE(first.rolling);
  s.log.end(1.01, 0, 2);
  const auto second = s.hit(1.5, 0, 3, 0.1);
  CHECK(second.flight == Approx(0.49));
  CHECK(second.gamma_before == -0.3);
  const auto third = s.hit(1.6, 0, 4, -0.2);  // still on bead 3
  CHECK(third.flight == 0);
  CHECK(third.gamma_before == 0.1);
  s.log.end(1.7, 0, 3);
  s.log.end(1.8, 0, 4);
  CHECK(s.hit(2.0, 0, 2).flight == Approx(0.2));
}

TEST_CASE("rolling: the same two grains, less than four contact times after they parted") {
  Story s;
  s.hit(1, 0, 2);
  s.log.end(1.1, 0, 2);
  CHECK(s.hit(1.139, 0, 2).rolling);
  s.log.end(1.2, 0, 2);
  CHECK_FALSE(s.hit(1.201, 0, 3).rolling);  // another bead
  s.log.end(1.21, 0, 3);
  CHECK(s.hit(1.22, 0, 2).rolling);  // a ball between two beads: it left this one at 1.2
  s.log.end(1.3, 0, 2);
  CHECK_FALSE(s.hit(1.341, 0, 2).rolling);
}

TEST_CASE("two moving grains: both are in touch, the angle before is that of the grain that hit") {
  Story s;
  s.hit(1, 1, 0, 0.5);
  CHECK(s.hit(1.1, 0, 2).flight == 0);
  s.log.end(1.2, 0, 1);
  s.log.end(1.25, 0, 2);
  const auto next = s.hit(1.3, 1, 2);
  CHECK(next.flight == Approx(0.1));
  CHECK(next.gamma_before == 0.5);
  CHECK(std::isnan(s.hit(1.3, 0, 3).gamma_before) == false);
}

TEST_CASE("hard grains that roll are in touch until their train of collisions has ended") {
  Story s;
  s.hit(1, 0, 2);
  s.log.end(1, 0, 2);
  s.log.hold(1.005, 0, 2);
  s.log.hold(1.010, 0, 2);
  CHECK(s.hit(1.049, 0, 3).flight == 0);
  s.log.end(1.049, 0, 3);
  s.log.hold(1.050, 0, 2);
  CHECK(s.hit(1.2, 0, 3).flight == Approx(0.15));
}

TEST_CASE("without a contact time nothing rolls; what touched before anybody looked is no flight") {
  TouchLog log(1, 0);
  log.touch(0, 1);
  Impact impact{};
  impact.time = 2, impact.bead = 2;
  log.begin(impact);
  CHECK(impact.flight == 0);
  log.end(2.1, 0, 1);
  log.end(2.1, 0, 2);
  impact.time = 2.1;
  impact.rolling = false;
  log.begin(impact);
  CHECK_FALSE(impact.rolling);
}
