#include "experiments/free_top.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engines/soft/rigid_motion.hpp"
#include "experiments/computed_figures.hpp"
#include "experiments/curves.hpp"
#include "run/session.hpp"
#include "scene/forms.hpp"
#include "scene/scene.hpp"
#include "theory/free_top.hpp"

namespace chute::experiments {
namespace {

/// Three spheres of different sizes off a line have three different moments.
constexpr std::string_view top_scene = R"(
dimensions = 3
incline = { angle = "0 deg", gravity = 0 }
domain = { periodic = [] }
bed = { kind = "none" }
[grains]
count = 1
diameter = { mean = 1.0 }
start = { lattice = "none", x = 0, y = 0, height = 0, spin = [1.5, 0.5, 3.0] }
[[grains.shape]]
orientation = "written"
member = [{ at = [0, 0, 0], radius = 0.5 }, { at = [0.7, 0.1, 0], radius = 0.4 }, { at = [0.1, 0.6, 0.1], radius = 0.3 }]
[contact]
normal = { law = "spring-dashpot", stiffness = 1e5, restitution = 0.6 }
tangential = { law = "frictionless" }
[run]
duration = 1000
)";

}  // namespace

TurningTop turn_freely(double periods, std::size_t states) {
  auto scene = scene::parse_scene(top_scene, "free top");
  scene.drop_outputs();
  run::Session session(scene, 1);
  const auto form = scene::forms_of<3>(scene).front();
  Engine& engine = session.engine();
  const auto quaternion = [&](const GrainsView& g) {
    return Vec<4>{{g.orientation[0][0], g.orientation[1][0], g.orientation[2][0], g.orientation[3][0]}};
  };
  const auto in_space = [&](const GrainsView& g) {
    return Vec<3>{{g.spin[0][0], g.spin[1][0], g.spin[2][0]}};
  };
  TurningTop top;
  const auto start = engine.grains();
  const double md2 = start.mass[0] / 4;  // forms are told for a radius of 1
  top.moments = md2 * form.gyration;
  const theory::FreeTop exact(form.gyration, soft::in_body(quaternion(start), in_space(start)));
  top.period = exact.period(), top.time_step = engine.time_step();
  const double last = periods * top.period / engine.time_step();
  for (std::size_t k = 0; k <= states; ++k) {
    engine.advance_to(std::llround(last * static_cast<double>(k) / static_cast<double>(states)));
    const auto now = engine.grains();
    const auto spin = soft::in_body(quaternion(now), in_space(now));
    Vec<3> own;
    for (int n = 0; n < 3; ++n) own[n] = top.moments[n] * spin[n];
    top.states.push_back(
        {now.time, spin, exact.at(now.time), 0.5 * dot(own, spin), soft::in_space(quaternion(now), own)});
  }
  return top;
}

FigureTable compute_fig_b_11(const FigureContext& context) {
  constexpr double shown = 3;  // periods
  const double periods = context.quick ? 10 : 100;
  const auto top = turn_freely(shown, 240), later = turn_freely(periods, 200);
  FigureTable table;
  table.comments = {
      "x: time, sqrt(d/g)",
      "y: a, b, c: spin along the principal axes, sqrt(g/d); d: |spin - Jacobi's|/|spin|",
      fmt::format("three spheres as one grain, nothing pushes it; moments {:.6f}, {:.6f}, {:.6f} m d^2",
                  top.moments[0], top.moments[1], top.moments[2]),
      fmt::format("period {:.6f}; gear5, the default step of k_n = 1e5, {:.4g}", top.period, top.time_step)};
  constexpr std::size_t every = 7;  // of the states is a point; all are the line
  const std::array panels{"a", "b", "c"};
  for (int n = 0; n < 3; ++n) {
    const auto* panel = panels[static_cast<std::size_t>(n)];
    for (const auto& s : top.states) table.rows.push_back({panel, "jacobi", s.time, s.exact[n]});
    for (std::size_t k = 0; k < top.states.size(); k += every)
      table.rows.push_back({panel, "chute", top.states[k].time, top.states[k].spin[n]});
  }
  for (const auto& s : later.states)
    if (const double off = norm(s.spin - s.exact) / norm(s.exact); s.time > 0)
      table.rows.push_back({"d", "chute", s.time, off});
  double energy = 0, momentum = 0;
  const auto& first = later.states.front();
  for (const auto& s : later.states) {
    energy = std::max(energy, std::abs(s.energy / first.energy - 1));
    momentum = std::max(momentum, norm(s.momentum - first.momentum) / norm(first.momentum));
  }
  table.comments.push_back(
      fmt::format("over {:.0f} periods energy is off by {:.1e}, angular momentum by {:.1e} of itself",
                  periods, energy, momentum));
  note_quick(table, context, "10 periods instead of 100 in d");
  return table;
}

}  // namespace chute::experiments
