#include "experiments/pushed_cylinder.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace chute::experiments {
namespace {

constexpr double inertia = 0.5;

/// Height of the centre above its place on the unloaded plane, velocities, and how far the surfaces have
/// slipped against each other since the step began.
struct State {
  double height = 0, v = 0, v_up = 0, spin = 0, plane_slip = 0, block_slip = 0;
};
State operator+(State a, const State& b) {
  a.height += b.height, a.v += b.v, a.v_up += b.v_up, a.spin += b.spin;
  a.plane_slip += b.plane_slip, a.block_slip += b.block_slip;
  return a;
}
State operator*(double s, State a) {
  a.height *= s, a.v *= s, a.v_up *= s, a.spin *= s, a.plane_slip *= s, a.block_slip *= s;
  return a;
}

/// One contact's tangential law with its memory.
class Friction {
 public:
  explicit Friction(const laws::Shear& law) : law_(law) {
    std::visit(
        [&]<class Law>(const Law&) {
          if constexpr (laws::ShearWithMemory<Law>) memory_ = typename Law::template Memory<1>{};
        },
        law);
  }
  /// Force at the slip velocity v after the surfaces slipped by `way` since the step began.
  double force(double v, double way, double normal_force) const {
    auto memory = memory_;
    return act(memory, v, way, normal_force);
  }
  /// Ends the step.
  void settle(double v, double way, double normal_force) { act(memory_, v, way, normal_force); }

 private:
  using Memory = std::variant<laws::SlipMemory<1, 1, 0>, laws::SlipMemory<1, 1, 1>, laws::SlipMemory<1, 2, 3>>;
  laws::Shear law_;
  Memory memory_;

  double act(Memory& memory, double v, double way, double normal_force) const {
    return std::visit(
        [&]<class Law>(const Law& law) {
          if constexpr (laws::ShearWithMemory<Law>) {
            const laws::Slip<1> slip{{{way}}, normal_force, 0, laws::Pair(1)};
            return law(slip, std::get<typename Law::template Memory<1>>(memory))[0];
          } else {
            return law(Vec<1>{{v}}, normal_force, laws::Pair(1))[0];
          }
        },
        law_);
  }
};

struct Forces {
  double normal, plane, block;
};

}  // namespace

std::vector<CylinderState> push(const PushedCylinder& set_up, const std::vector<Push>& pushes, int every) {
  Friction plane(set_up.plane), block(set_up.block);
  State y;
  y.height = -1 / set_up.normal.stiffness(1);  // the weight rests
  double time = 0;
  std::vector<CylinderState> states;

  // The lowest point moves with v − ω, the side at the block with v_up + ω.
  const auto forces = [&](const State& s, double pushing) {
    const double normal = set_up.normal(-s.height, -s.v_up, 1).total;
    return Forces{normal, plane.force(s.v - s.spin, s.plane_slip, normal),
                  block.force(s.v_up + s.spin, s.block_slip, pushing)};
  };
  const auto slope = [&](const State& s, double pushing) {
    const auto f = forces(s, pushing);
    return State{s.v_up,       pushing + f.plane, f.normal - 1 + f.block, (f.block - f.plane) / inertia,
                 s.v - s.spin, s.v_up + s.spin};
  };
  for (const auto& [pushing, duration] : pushes) {
    const auto steps = std::llround(duration / set_up.time_step);
    const double h = set_up.time_step, start = time;
    for (long long k = 0; k <= steps; ++k) {
      time = start + static_cast<double>(k) * h;
      const State a = slope(y, pushing);
      if (k % every == 0) {
        const auto f = forces(y, pushing);
        states.push_back({time, -f.plane, -f.block, a.v, a.spin, y.v, y.spin});
      }
      if (k == steps) break;
      const State b = slope(y + 0.5 * h * a, pushing), c = slope(y + 0.5 * h * b, pushing);
      const State d = slope(y + h * c, pushing);
      y = y + h / 6 * (a + 2 * b + 2 * c + d);
      const double normal = set_up.normal(-y.height, -y.v_up, 1).total;
      plane.settle(y.v - y.spin, y.plane_slip, normal);
      block.settle(y.v_up + y.spin, y.block_slip, pushing);
      y.plane_slip = y.block_slip = 0;
    }
  }
  return states;
}

SteadyCylinder steady_cylinder(double push, double mu_b, double mu_p) {
  const double low = mu_p * (1 + inertia) / (mu_b * (1 - mu_p) + inertia * (1 - mu_b * mu_p));  // (3.23)
  const double high = mu_p / (mu_b * (1 - mu_p));                                               // (3.24)
  if (push < low) {
    const double a = (1 - mu_b) / (1 + inertia) * push;                   // (3.28)
    return {(inertia + mu_b) / (1 + inertia) * push, mu_b * push, a, a};  // (3.26), (3.27)
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  if (push <= high) return {nan, nan, nan, nan};
  const double friction = mu_p / (1 - mu_p);        // (3.29)
  return {friction, friction, push - friction, 0};  // (3.30), (3.31)
}

}  // namespace chute::experiments
