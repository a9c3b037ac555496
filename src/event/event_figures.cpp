#include "event/event_figures.hpp"

#include <fmt/format.h>

#include <cmath>

#include "event/ball_on_line.hpp"

namespace chute::event {
namespace {

std::string how(const BallOnLine& ball) {
  return fmt::format(
      "event-driven, Walton's collisions: e_n = 0.7, mu = 0.13, beta = 0.34; r = {} mm, eps "
      "= 0, solid sphere, start with v_x = {} m/s, v_z = {} m/s, no spin; contact time {} s",
      ball.radius * 1e3, ball.velocity, ball.velocity_up, ball.contact_time);
}

std::int64_t ticks(const BallOnLine& ball, double time) { return std::llround(time / ball.tick); }

}  // namespace

FigureTable compute_fig_4_21(const FigureContext& context) {
  const double duration = context.quick ? 5 : 20;
  FigureTable table;
  table.comments = {"x: time, s", "y: velocity just before each collision, m/s; v_z counts towards the line",
                    "Phi = 3; a: sin theta = 0.15, b: sin theta = 0.3", how(BallOnLine{}),
                    "collisions within a lasting contact (less than 4 contact times apart) are not shown"};
  for (const auto& [panel, sine] : {std::pair{"a", 0.15}, std::pair{"b", 0.3}}) {
    BallOnLine ball;
    ball.theta = std::asin(sine);
    auto engine = make_engine(ball);
    engine.collect_impacts(true);
    engine.advance_to(ticks(ball, duration));
    const auto impacts = engine.take_impacts();
    for (const auto& i : impacts)  // (4.4), (4.5) solved for v_x and v_z
      table.rows.push_back({panel, "v_x", i.time, i.v_n * std::sin(i.gamma) + i.v_t * std::cos(i.gamma)});
    for (const auto& i : impacts)
      table.rows.push_back({panel, "v_z", i.time, -(i.v_n * std::cos(i.gamma) - i.v_t * std::sin(i.gamma))});
  }
  return table;
}

const std::map<std::string, std::function<FigureTable(const FigureContext&)>>& event_figures() {
  static const std::map<std::string, std::function<FigureTable(const FigureContext&)>> all{
      {"fig-4-21", compute_fig_4_21}};
  return all;
}

}  // namespace chute::event
