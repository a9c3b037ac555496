#include "experiments/rigid_cylinder.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/error.hpp"
#include "engines/contact/solver/exact.hpp"
#include "engines/contact/solver/nsgs.hpp"

namespace chute::experiments {
namespace {

constexpr double disc_inertia = 0.5, gravity = 1;
constexpr contact::Goal closely{.tolerance = 1e-13, .iterations = 10'000};

enum At : std::uint32_t { plane, block };

/// Velocities along the plane and up, and the spin that rolls the cylinder forward.
struct Motion {
  double along = 0, up = 0, spin = 0;
};

/// What impulses (normal, shear) at plane and block do in a step: u_n and u_s of the plane are `up` and `along − spin`,
/// u_s of the block is `up + spin`. The block's normal row is that of a body without mass: u_n has the sign of
/// r_n − F_p h, whatever the cylinder does.
contact::Problem<2> step_problem(const RigidCylinder& set_up, const Motion& m, double pushing) {
  const double h = set_up.time_step;
  contact::Problem<2> problem;
  problem.row_starts = {0, 2, 4};
  problem.columns = {plane, block, plane, block};
  problem.blocks = {{{1, 0, 0, 1 + 1 / disc_inertia}},
                    {{0, 1, 1, -1 / disc_inertia}},
                    {{0, 0, 1, -1 / disc_inertia}},
                    {{1, 0, 0, 1 + 1 / disc_inertia}}};
  const double fallen = m.up - gravity * h;
  problem.q = {{{fallen, m.along - m.spin}}, {{-pushing * h, fallen + m.spin}}};
  problem.friction = {set_up.plane_friction, set_up.block_friction};
  return problem;
}

std::vector<Vec<2>> solved(const contact::Problem<2>& problem, bool exactly, double time) {
  contact::Convergence done;
  std::vector<Vec<2>> r;
  if (exactly) {
    auto solution = contact::exact(problem, closely);
    done = solution.convergence, r = std::move(solution.r);
  } else {
    contact::AssembledSystem<2> system(problem);
    done = contact::nsgs(system, closely, Team::alone());
    r = system.result();
  }
  if (!done.reached)
    throw WorkError(fmt::format("the pushed cylinder's contacts do not converge at t = {:.6g}", time));
  return r;
}

}  // namespace

std::vector<CylinderState> push(const RigidCylinder& set_up, const std::vector<Push>& pushes) {
  const double h = set_up.time_step;
  std::vector<CylinderState> states;
  Motion m;
  double start = 0;
  for (const auto& [pushing, duration] : pushes) {
    const auto steps = std::llround(duration / h);
    for (long long k = 1; k <= steps; ++k) {
      const double time = start + static_cast<double>(k) * h;
      const auto r = solved(step_problem(set_up, m, pushing), set_up.exact, time);
      const double gained = r[block][0] + r[plane][1], turned = (r[block][1] - r[plane][1]) / disc_inertia;
      m.along += gained, m.spin += turned;
      m.up += r[plane][0] + r[block][1] - gravity * h;
      states.push_back({time, -r[plane][1] / h, -r[block][1] / h, gained / h, turned / h, m.along, m.spin});
    }
    start += static_cast<double>(steps) * h;
  }
  return states;
}

}  // namespace chute::experiments
