#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <vector>

#include "core/domain.hpp"
#include "core/vec.hpp"

namespace chute {

/// Allocates on cache lines, so that vector loads of a whole array never straddle two.
template <class T>
struct CacheAligned {
  using value_type = T;
  CacheAligned() = default;
  template <class U>
  CacheAligned(const CacheAligned<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{64})); }
  void deallocate(T* p, std::size_t) { ::operator delete (p, std::align_val_t{64}); }
  bool operator==(const CacheAligned&) const = default;
};

/// One number per grain.
using Array = std::vector<double, CacheAligned<double>>;

/// Components of a turn: one about the plane's normal in 2D, three in 3D.
template <int D>
inline constexpr int turns = D == 2 ? 1 : 3;

/// Element k becomes what element from[k] was, for all k that `from` has; the others stay.
template <class Values>
void reorder(Values& values, std::span<const std::int32_t> from) {
  const Values old(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(from.size()));
  for (std::size_t k = 0; k < from.size(); ++k) values[k] = old[static_cast<std::size_t>(from[k])];
}

/// The state of all grains, one array per field. Moving grains come first, [0, moving); fixed ones (the bed)
/// follow. A grain's index is its id in every file. 2D spins count anticlockwise (x downhill, y up from the
/// bed), so a grain that rolls downhill spins negatively.
template <int D>
struct Grains {
  std::size_t moving = 0;
  /// Moving grains do not feel each other: many runs of one grain on the same bed, side by side.
  bool independent = false;
  std::array<Array, D> position, velocity;
  std::array<Array, turns<D>> angle,
      spin;  ///< 3D: `angle` is the time integral of the spin, component by component
  Array radius, mass, inertia;
  Array inverse_mass, inverse_inertia;    ///< 0 for fixed grains
  std::array<std::vector<int>, D> wraps;  ///< times each moving grain went once around a periodic direction

  std::size_t size() const { return radius.size(); }

  Vec<D> place(std::size_t i) const { return gather(position, i); }
  Vec<D> speed(std::size_t i) const { return gather(velocity, i); }

  void reserve(std::size_t count) {
    for (int k = 0; k < D; ++k)
      position[k].reserve(count), velocity[k].reserve(count), wraps[k].reserve(count);
    for (int k = 0; k < turns<D>; ++k) angle[k].reserve(count), spin[k].reserve(count);
    for (auto* a : {&radius, &mass, &inertia, &inverse_mass, &inverse_inertia}) a->reserve(count);
  }

  /// Adds a grain at rest; all moving grains must be added before the first fixed one.
  void add(const Vec<D>& r, double grain_radius, double grain_mass, double grain_inertia, bool moves) {
    for (int k = 0; k < D; ++k) {
      position[k].push_back(r[k]);
      velocity[k].push_back(0);
      if (moves) wraps[k].push_back(0);
    }
    for (int k = 0; k < turns<D>; ++k) angle[k].push_back(0), spin[k].push_back(0);
    radius.push_back(grain_radius);
    mass.push_back(grain_mass);
    inertia.push_back(grain_inertia);
    inverse_mass.push_back(moves ? 1 / grain_mass : 0);
    inverse_inertia.push_back(moves ? 1 / grain_inertia : 0);
    moving += moves;
  }

  /// Puts the moving grains into another order: grain k becomes what grain from[k] was. Fixed ones stay.
  void reorder(std::span<const std::int32_t> from) {
    for (int k = 0; k < D; ++k)
      chute::reorder(position[k], from), chute::reorder(velocity[k], from), chute::reorder(wraps[k], from);
    for (int k = 0; k < turns<D>; ++k) chute::reorder(angle[k], from), chute::reorder(spin[k], from);
    for (auto* a : {&radius, &mass, &inertia, &inverse_mass, &inverse_inertia}) chute::reorder(*a, from);
  }

 private:
  template <std::size_t K>
  static Vec<D> gather(const std::array<Array, K>& field, std::size_t i) {
    Vec<D> r;
    for (int k = 0; k < D; ++k) r[k] = field[k][i];
    return r;
  }
};

/// What observers and writers see of the grains, whatever the dimension and the engine: spans that stay valid
/// until the engine moves on. Components that do not exist in 2D are empty.
struct GrainsView {
  int dimensions = 2;
  double time = 0;
  std::size_t moving = 0;
  std::array<std::span<const double>, 3> position, velocity, force;
  std::array<std::span<const double>, 3> angle, spin;  ///< in 2D only [0], about the plane's normal
  std::span<const double> radius, mass, inertia;
  std::array<std::span<const int>, 3>
      wraps;                       ///< of the moving grains; with `period`, the way around the domain
  std::array<double, 3> period{};  ///< 0 where the domain is not periodic

  std::size_t size() const { return radius.size(); }

  /// Place of a moving grain in direction k, counted on through the periods.
  double unwrapped(std::size_t i, std::size_t k) const {
    return position[k][i] + static_cast<double>(wraps[k][i]) * period[k];
  }
};

/// The view of these grains at `time`, under these forces; it points into both.
template <int D>
GrainsView view_of(const Grains<D>& grains, std::span<const Array> force, const Domain<D>& domain,
                   double time) {
  GrainsView view;
  view.dimensions = D;
  view.time = time;
  view.moving = grains.moving;
  for (int k = 0; k < D; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    view.position[axis] = grains.position[axis];
    view.velocity[axis] = grains.velocity[axis];
    view.force[axis] = force[axis];
    view.wraps[axis] = grains.wraps[axis];
    view.period[axis] = domain.periodic(k) ? domain.length[k] : 0;
  }
  for (std::size_t k = 0; k < turns<D>; ++k) view.angle[k] = grains.angle[k], view.spin[k] = grains.spin[k];
  view.radius = grains.radius;
  view.mass = grains.mass;
  view.inertia = grains.inertia;
  return view;
}

}  // namespace chute
