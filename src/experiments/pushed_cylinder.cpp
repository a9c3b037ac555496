#include "experiments/pushed_cylinder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace chute::experiments {
namespace {

constexpr double inertia = 0.5;
const laws::Pair cylinder_pair(1, 1);  // with a plane

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

/// A law and, if it has one, its memory of one contact.
template <class Law>
struct Held {
  Law law;
};
template <laws::ShearWithMemory Law>
struct Held<Law> {
  Law law;
  typename Law::template Memory<1> memory{};
};
template <class Laws>
struct AnyHeld;
template <class... Law>
struct AnyHeld<std::variant<Law...>> {
  using Type = std::variant<Held<Law>...>;
};

/// One contact at an instant: slip velocity, slip since the step began, normal force and overlap.
struct Touch {
  double v, way, normal_force, overlap;
};

/// One contact's tangential law with its memory.
class Friction {
 public:
  explicit Friction(const laws::Shear& law)
      : held_(std::visit([]<class Law>(const Law& l) { return AnyHeld<laws::Shear>::Type(Held<Law>{l}); },
                         law)) {}
  double force(const Touch& touch) const {
    auto held = held_;
    return act(held, touch);
  }
  /// Ends the step.
  void settle(const Touch& touch) { act(held_, touch); }

 private:
  AnyHeld<laws::Shear>::Type held_;

  static double act(AnyHeld<laws::Shear>::Type& held, const Touch& t) {
    return std::visit(
        [&](auto& h) {
          if constexpr (requires { h.memory; })
            return h.law(laws::Slip<1>{{{t.way}}, t.normal_force, t.overlap, cylinder_pair}, h.memory)[0];
          else
            return h.law(Vec<1>{{t.v}}, t.normal_force, cylinder_pair)[0];
        },
        held);
  }
};

/// The plane's normal force, and the overlap at which it is at rest.
class Plane {
 public:
  explicit Plane(const laws::Normal& law) : law_(law) {}
  double force(double xi, double dxi) const {
    return std::visit(
        [&]<class Law>(const Law& law) -> double {
          if constexpr (laws::NormalWithMemory<Law>)
            throw std::invalid_argument("the pushed cylinder knows no normal law with a memory");
          else
            return xi > 0 ? law(xi, dxi, cylinder_pair).total : 0;
        },
        law_);
  }
  double overlap(double load) const {
    double low = 0, high = 1e-9;
    while (force(high, 0) < load) high *= 2;
    for (int k = 0; k < 100; ++k) {
      const double middle = (low + high) / 2;
      (force(middle, 0) < load ? low : high) = middle;
    }
    return high;
  }

 private:
  const laws::Normal& law_;
};

struct Forces {
  double normal, plane, block;
};

}  // namespace

std::vector<CylinderState> push(const PushedCylinder& set_up, const std::vector<Push>& pushes, int every) {
  Friction plane(set_up.plane), block(set_up.block);
  const Plane ground(set_up.normal);
  State y;
  y.height = -ground.overlap(1);  // the weight rests
  double time = 0, dent = 0;      // of the block
  std::vector<CylinderState> states;

  // The lowest point moves with v − ω, the side at the block with v_up + ω.
  const auto at_plane = [&](const State& s) {
    return Touch{s.v - s.spin, s.plane_slip, ground.force(-s.height, -s.v_up), -s.height};
  };
  const auto at_block = [&](const State& s, double pushing) {
    return Touch{s.v_up + s.spin, s.block_slip, pushing, dent};
  };
  const auto forces = [&](const State& s, double pushing) {
    const auto touch = at_plane(s);
    return Forces{touch.normal_force, plane.force(touch), block.force(at_block(s, pushing))};
  };
  const auto slope = [&](const State& s, double pushing) {
    const auto f = forces(s, pushing);
    return State{s.v_up,       pushing + f.plane, f.normal - 1 + f.block, (f.block - f.plane) / inertia,
                 s.v - s.spin, s.v_up + s.spin};
  };
  for (const auto& [pushing, duration] : pushes) {
    const auto steps = std::llround(duration / set_up.time_step);
    const double h = set_up.time_step, start = time;
    dent = ground.overlap(pushing);
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
      plane.settle(at_plane(y));
      block.settle(at_block(y, pushing));
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

Steady steady(const std::vector<CylinderState>& states, double from, double to,
              double CylinderState::*quantity) {
  double sum = 0, weights = 0, low = INFINITY, high = -INFINITY;
  for (const auto& s : states) {
    if (s.time <= from || s.time >= to) continue;
    const double weight = 1 - std::cos(2 * std::numbers::pi * (s.time - from) / (to - from));
    sum += weight * s.*quantity;
    weights += weight;
    low = std::min(low, s.*quantity), high = std::max(high, s.*quantity);
  }
  return {sum / weights, (high - low) / 2};
}

}  // namespace chute::experiments
