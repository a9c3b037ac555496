#include <catch2/catch.hpp>
#include <cmath>

#include "make_engine.hpp"

using namespace chute;

namespace ball_line_tests {

namespace {

/// Mean velocity of a ball that hits without restoring and sticks to what it rolls on: thesis 4.2.5
/// corrected. It rolls over a bead from −γ_max to γ_max, (4.33) with m_eff = 7/5 m, gains 2 m g (R+r) sin
/// γ_max sin θ, and keeps e_t = (5 cos 2γ_max + 2)/7 of its velocity in each impact (angular momentum about
/// the new contact).
double closed_form(double size_ratio, double sine, double r, double g) {
  const double R = size_ratio * r, theta = std::asin(sine), gamma_max = std::asin(1 / (1 + size_ratio));
  const double e_t = (5 * std::cos(2 * gamma_max) + 2) / 7, w2 = 5.0 / 7 * g / (R + r);
  const double end =
      4 * w2 * sine * std::sin(gamma_max) / (1 - e_t * e_t);  // γ'² just before an impact (4.45)
  const auto rate = [&](double gamma) {                       // γ' from the energy, (4.46)
    return std::sqrt(end - 2 * w2 * (std::cos(theta + gamma) - std::cos(theta + gamma_max)));
  };
  const int n = 1000;  // Simpson's rule for (4.48)
  double time = 0;
  for (int i = 0; i <= n; ++i)
    time += (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) / rate(gamma_max * (2.0 * i / n - 1));
  time *= 2 * gamma_max / n / 3;
  return 2 * r / time;  // the way along the line; (4.47) has the arc
}

}  // namespace

// What is left of the 2 %: e_n = 0.1 is not 0, friction is 0.13 and regularised (all sticking would need
// more), and the ball sinks a little into the bed; each of them makes it slower.
TEST_CASE("a ball on a line of balls runs at the corrected closed form") {
  for (const double size_ratio : {2.25, 3.0})
    for (const double sine : {0.06, 0.08, 0.1}) {
      const auto scene = scene::read_scene(
          CHUTE_SOURCE_DIR "/scenes/ball-2d.toml",
          {"grains.size_ratio=" + std::to_string(size_ratio), "incline.sin=" + std::to_string(sine),
           "contact.normal.restitution=0.1", "contact.normal.stiffness=2e7"});
      auto made = test::make_engine(scene);
      auto& engine = *made.engine;
      const auto run_to = [&](double time) {
        engine.advance_to(std::llround(time / engine.time_step()));
        return engine.grains().unwrapped(0, 0);
      };
      const double begin = 1.5, end = 4;  // s; the launch is forgotten after some twenty impacts
      const double from = run_to(begin), v_x = (run_to(end) - from) / (end - begin);
      const double expected = closed_form(size_ratio, sine, 0.005, 9.81);
      INFO("Phi " << size_ratio << ", sin theta " << sine << ": v_x " << v_x << ", closed form " << expected);
      CHECK(v_x == Approx(expected).epsilon(0.02));
    }
}

}  // namespace ball_line_tests
