#pragma once
#include <algorithm>
#include <cmath>

#include "laws/keys.hpp"
#include "laws/slip.hpp"

namespace chute::laws {

/// Tangential spring that softens towards the Coulomb limit, after Mindlin and Deresiewicz as simplified by
/// Walton and Braun, thesis (3.17), (3.18). With f the friction along the direction of the first slip,
/// positive against it:
///
///     df/dζ = k_s0 (1 − (f − f*)/(μ|F_n| − f*))^{1/3}    while the slip goes that way,
///     df/dζ = k_s0 (1 − (f* − f)/(μ|F_n| + f*))^{1/3}    while it goes back,
///
/// f* is 0, then f at each reversal; the bracket is kept in [0, 1], and |f| ≤ μ|F_n| after each step. (3.17)
/// is an Euler step of this; here it is solved exactly for the F_n of the step, which needs no small steps:
/// with q the bracket, q^{2/3} falls linearly. In 3D the component of the slip along the first direction,
/// which turns with the contact plane, follows this law; the one across is a spring k_s0, and both together
/// are kept within the limit.
struct WaltonBraunMindlin {
  static constexpr std::string_view name = "walton-braun-mindlin";
  static constexpr int vectors = 2, scalars = 3;
  template <int T>
  using Memory = SlipMemory<T, vectors, scalars>;

  PairCoefficient stiffness;  ///< k_s0, N/m
  double friction = 0;        ///< μ

  struct Keys : SpringKeys {
    double friction = 0;
    template <class Archive>
    void describe(Archive& a) {
      a.required("friction", friction, non_negative, "μ");
      SpringKeys::describe(a);
    }
    WaltonBraunMindlin make(const PairCoefficient& k_n) const { return {resolve(k_n), friction}; }
  };

  bool needs_radius() const { return stiffness.needs_radius(); }
  double stiffness_at(double, Pair p) const { return stiffness(p); }

  template <int T>
  Vec<T> operator()(const Slip<T>& slip, Memory<T>& memory) const {
    auto& [axis, across] = memory.vector;         // the first direction; friction across it
    auto& [f, turning, heading] = memory.scalar;  // f, f*, and ±1: which way the slip went last
    const double k = stiffness(slip.pair), limit = friction * std::abs(slip.normal_force);
    if (heading == 0) {
      const double first = magnitude(slip.way);
      if (first == 0) return {};
      axis = (1 / first) * slip.way;
      heading = 1;
    }
    const double along = dot(slip.way, axis);
    if (along * heading < 0) turning = f, heading = -heading;
    f = heading * moved(heading * f, heading * turning, limit, k, std::abs(along));
    f = std::clamp(f, -limit, limit);
    if constexpr (T > 1) {
      across = across + k * (slip.way - along * axis);
      const double total = std::sqrt(f * f + dot(across, across));
      if (total > limit) f *= limit / total, across = (limit / total) * across;
      return -f * axis - across;
    } else {
      return -f * axis;
    }
  }

  /// What turning round now, or going on if the friction is already falling, gives back on the way to f = 0:
  /// ∫ f df / (df/dζ) at the present F_n.
  template <int T>
  double energy(const Slip<T>& slip, const Memory<T>& memory) const {
    const double k = stiffness(slip.pair), limit = friction * std::abs(slip.normal_force);
    const auto& [f, turning, heading] = memory.scalar;
    const double size = std::abs(f);
    if (size == 0 || k == 0) return across_energy(memory, k);
    const double from = f * heading > 0 ? size : std::max(size, std::abs(turning));  // where this fall began
    const double a = limit + from, w0 = limit / a, w1 = (limit + size) / a;
    const auto integral = [&](double w) {
      const double third = std::cbrt(w);
      return 0.6 * a * w * third * third - 1.5 * limit * third * third;
    };
    return a / k * (integral(w1) - integral(w0)) + across_energy(memory, k);
  }

 private:
  /// f after a way ≥ 0 in the heading direction: (L − f)^{2/3} falls linearly.
  static double moved(double f, double turning, double limit, double k, double way) {
    const double room = limit - turning;
    if (room <= 0) return limit;
    const double bracket = std::clamp((limit - f) / room, 0.0, 1.0);
    const double third = std::cbrt(bracket);
    const double left = third * third - 2.0 / 3 * k * way / room;
    return left > 0 ? limit - room * left * std::sqrt(left) : limit;
  }
  template <int T>
  static double across_energy(const Memory<T>& memory, double k) {
    if constexpr (T == 1)
      return 0;
    else
      return k > 0 ? 0.5 * dot(memory.vector[1], memory.vector[1]) / k : 0;
  }
};

}  // namespace chute::laws
