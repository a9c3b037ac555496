#pragma once
#include <random>

#include "engines/contact/solver/assemble.hpp"
#include "engines/contact/solver/exact.hpp"
#include "engines/contact/solver/natural_residual.hpp"
#include "engines/contact/solver/nsgs.hpp"
#include "engines/contact/solver/static_friction.hpp"

namespace chute::contact::test {

/// A few bodies and their contacts, written down by hand.
template <int D>
struct Scene {
  static constexpr std::size_t turns = D == 2 ? 1 : 3;
  std::array<std::vector<double>, D> velocity;
  std::array<std::vector<double>, turns> spin;
  std::vector<double> inverse_mass, inverse_inertia;
  std::vector<std::int32_t> a, b;
  std::vector<Vec<D>> normal, arm_a, arm_b, offset, impulse;
  std::vector<double> friction;

  int body(double mass, double inertia, const Vec<D>& v = {}) {
    for (int k = 0; k < D; ++k) velocity[k].push_back(v[k]);
    for (auto& w : spin) w.push_back(0);
    inverse_mass.push_back(1 / mass);
    inverse_inertia.push_back(1 / inertia);  // 1/∞ = 0
    return static_cast<int>(inverse_mass.size()) - 1;
  }
  /// Discs or spheres: the arms follow from the radii. `n` points into i; j = −1 is a wall.
  void touch(int i, int j, const Vec<D>& n, double mu, double radius = 0.5) {
    a.push_back(i), b.push_back(j);
    normal.push_back(n);
    arm_a.push_back(-radius * n), arm_b.push_back(radius * n);
    offset.push_back({}), impulse.push_back({});
    friction.push_back(mu);
  }
  std::size_t size() const { return normal.size(); }

  BodyArrays<D> bodies() {
    BodyArrays<D> arrays;
    for (int k = 0; k < D; ++k) arrays.velocity[k] = velocity[k];
    for (std::size_t k = 0; k < turns; ++k) arrays.spin[k] = spin[k];
    arrays.inverse_mass = inverse_mass, arrays.inverse_inertia = inverse_inertia;
    return arrays;
  }
  ContactArrays<D> contacts() { return {a, b, normal, arm_a, arm_b, friction, offset, impulse}; }

  /// Runs the fast solver on the bodies and takes what it gives.
  Convergence solve(const Goal& goal, int threads = 1) {
    Team team(threads);
    BodySystem<D> system(bodies(), contacts(), team);
    const auto c = nsgs(system, goal, team);
    system.hand_back(bodies(), contacts());
    return c;
  }

  /// The same problem with its matrix, from the velocity that a unit of each body's motion gives each contact: the
  /// columns of Hᵀ.
  Problem<D> problem() const {
    constexpr int degrees = D + static_cast<int>(turns);
    const auto unit = [](int d) {
      std::array<double, static_cast<std::size_t>(degrees)> motion{};
      motion[static_cast<std::size_t>(d)] = 1;
      return motion;
    };
    const auto seen = [&](std::size_t i, bool of_a, const auto& motion) {
      const auto& arm = of_a ? arm_a[i] : arm_b[i];
      Vec<D> v;
      for (int k = 0; k < D; ++k) v[k] = motion[static_cast<std::size_t>(k)];
      if constexpr (D == 2) {
        v = v + Vec<2>{{-motion[2] * arm[1], motion[2] * arm[0]}};
      } else {
        v = v + cross(Vec<3>{{motion[3], motion[4], motion[5]}}, arm);
      }
      return (of_a ? 1.0 : -1.0) * (frame_of(normal[i]) * v);
    };
    std::vector<Entry> entries;
    std::vector<Vec<D>> q(offset);
    for (std::size_t i = 0; i < size(); ++i) {
      for (const bool of_a : {true, false}) {
        const int body = of_a ? a[i] : b[i];
        if (body < 0) continue;
        const auto at = static_cast<std::size_t>(body);
        std::array<double, static_cast<std::size_t>(degrees)> motion{};
        for (int k = 0; k < D; ++k) motion[static_cast<std::size_t>(k)] = velocity[k][at];
        for (std::size_t k = 0; k < turns; ++k) motion[D + k] = spin[k][at];
        q[i] = q[i] + seen(i, of_a, motion);
        for (std::size_t j = 0; j < size(); ++j)
          for (const bool other : {true, false}) {
            if ((other ? a[j] : b[j]) != body) continue;
            for (int d = 0; d < degrees; ++d) {
              const double inverse = d < D ? inverse_mass[at] : inverse_inertia[at];
              const auto u = seen(i, of_a, unit(d)), v = seen(j, other, unit(d));
              for (int k = 0; k < D; ++k)
                for (int l = 0; l < D; ++l)
                  entries.push_back({i * D + static_cast<std::size_t>(k), j * D + static_cast<std::size_t>(l),
                                     inverse * u[k] * v[l]});
            }
          }
      }
    }
    return assemble<D>(entries, q, friction);
  }
};

/// Impulses that would stop all contacts one by one.
template <int D>
double reference(const Problem<D>& problem) {
  return AssembledSystem<D>(problem).reference();
}

/// A problem with a unique solution: W far from singular, little friction.
template <int D>
Problem<D> random_problem(std::mt19937& dice, std::size_t m, double most_friction) {
  std::normal_distribution<double> any;
  std::uniform_real_distribution<double> share(0, 1);
  const auto n = m * D;
  std::vector<double> a(n * n);
  for (auto& x : a) x = any(dice) / std::sqrt(static_cast<double>(n));
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      double sum = i == j ? 0.5 : 0;
      for (std::size_t k = 0; k < n; ++k) sum += a[k * n + i] * a[k * n + j];
      entries.push_back({i, j, sum});
    }
  std::vector<Vec<D>> q(m);
  std::vector<double> friction(m);
  for (std::size_t i = 0; i < m; ++i) {
    for (int k = 0; k < D; ++k) q[i][k] = any(dice);
    friction[i] = most_friction * share(dice);
  }
  return assemble<D>(entries, q, friction);
}

template <int D>
double largest_difference(std::span<const Vec<D>> x, std::span<const Vec<D>> y) {
  double most = 0;
  for (std::size_t i = 0; i < x.size(); ++i) most = std::max(most, norm(x[i] - y[i]));
  return most;
}

}  // namespace chute::contact::test
