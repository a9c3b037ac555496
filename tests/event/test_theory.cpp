#include <catch2/catch.hpp>

#include "event/ball_on_line.hpp"
#include "theory/rolling.hpp"

using namespace chute;
using namespace chute::event;

namespace {

/// v̄_x over `duration` after a transient, from the way, not from samples of the velocity.
double mean_velocity(const BallOnLine& ball, double transient, double duration) {
  auto engine = make_engine(ball);
  const auto ticks = [&](double t) { return std::llround(t / ball.tick); };
  engine.advance_to(ticks(transient));
  const double from = engine.grains().unwrapped(0, 0);
  engine.advance_to(ticks(transient + duration));
  return (engine.grains().unwrapped(0, 0) - from) / duration;
}

}  // namespace

TEST_CASE("with e_n = 0 and endless friction the mean velocity is that of the corrected theory") {
  for (const double phi : {1.75,2.25, 3.0, 4.0})
   for (const double above : {0.005, 0.01, 0.03, 0.05}) 
    for (const double t_c : {1e-4, 3e-5, 1e-5}) {
      const theory::Line line{phi};
      const double theta = theory::boundary_ab(line, theory::Version::corrected) + above;
      BallOnLine ball{.size_ratio = phi, .theta = theta};
      ball.contact = {.restitution = 0, .friction = 1e9, .tangential = 0};
      ball.contact_time = t_c;
      const double v = mean_velocity(ball, 3, 3);
      const auto p=theory::steady_passage(line, theta, theory::Version::corrected);
      printf("Phi %g sin %.4f t_c %g: ED %.6f corrected %.6f printed %.6f contact %.3f\n",phi,std::sin(theta),t_c,v, p->mean_velocity, theory::steady_passage(line,theta,theory::Version::printed)?theory::steady_passage(line,theta,theory::Version::printed)->mean_velocity:0, p->least_contact);
    }
}
