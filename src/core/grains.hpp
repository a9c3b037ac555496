#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <type_traits>
#include <vector>

#include "common/fields.hpp"
#include "core/domain.hpp"
#include "core/orientation.hpp"
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

/// Element k becomes what element from[k] was, for all k that `from` has; the others stay.
template <class Values>
void reorder(Values& values, std::span<const std::int32_t> from) {
  const Values old(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(from.size()));
  for (std::size_t k = 0; k < from.size(); ++k) values[k] = old[static_cast<std::size_t>(from[k])];
}

/// Of `moving` elements those at `stay` are left, in this order, and `more` new ones (zeros) follow; whatever comes after the
/// moving ones stays behind them.
template <class Values>
void renew(Values& values, std::span<const std::int32_t> stay, std::size_t moving, std::size_t more) {
  Values next;
  next.reserve(values.size() - moving + stay.size() + more);
  for (const auto k : stay) next.push_back(values[static_cast<std::size_t>(k)]);
  next.resize(stay.size() + more);
  next.insert(next.end(), values.begin() + static_cast<std::ptrdiff_t>(moving), values.end());
  values = std::move(next);
}

/// What the numbers of a field mean, which decides how files hold them.
enum class FieldKind {
  scalar,
  vector,      ///< D components; files have three
  turn,        ///< about the plane's normal in 2D, which is the third component in files
  orientation  ///< an angle in 2D, a quaternion in 3D
};

/// What one field of the grains is.
struct GrainField {
  const fields::Field* file;  ///< its name in files, with labels and units; null: files do without
  FieldKind kind;
  bool moving_only;  ///< has no numbers for fixed grains
  bool changes;      ///< in the course of a run: checkpoints keep it; the others follow from the scene
};

/// The state of all grains, one array per field. Moving grains come first, [0, moving); fixed ones (the bed)
/// follow. A grain's index is its id in every file, unless grains come and go meanwhile (GrainsView::id). 2D spins count anticlockwise (x downhill, y up from the
/// bed), so a grain that rolls downhill spins negatively.
template <int D>
struct Grains {
  std::size_t moving = 0;
  /// Moving grains do not feel each other: many runs of one grain on the same bed, side by side.
  bool independent = false;
  std::array<Array, D> position, velocity;
  std::array<Array, turns<D>> spin;
  std::array<Array, orientation_numbers<D>> orientation;
  Array radius, mass, inertia;
  Array inverse_mass, inverse_inertia;    ///< 0 for fixed grains
  std::vector<int> material;              ///< species, as the scene numbers them
  std::array<std::vector<int>, D> wraps;  ///< times each moving grain went once around a periodic direction

  /// The fields, declared once: visit(GrainField, columns) for each, where columns is a span of arrays. Whatever has
  /// to go over all fields (orders, checkpoints, snapshots, files) does it by this list.
  template <class Self, class Visit>
  static void for_fields(Self& g, const Visit& visit) {
    const auto each = [&](const GrainField& field, auto& columns) {
      if constexpr (requires { columns[0][0]; })
        visit(field, std::span(columns));
      else
        visit(field, std::span(&columns, 1));
    };
    using Kind = FieldKind;
    each({nullptr, Kind::vector, false, true}, g.position);  // files have points
    each({&fields::velocity, Kind::vector, false, true}, g.velocity);
    each({&fields::angular_velocity, Kind::turn, false, true}, g.spin);
    each({D == 2 ? &fields::angle : &fields::orientation, Kind::orientation, false, true}, g.orientation);
    each({&fields::radius, Kind::scalar, false, false}, g.radius);
    each({&fields::mass, Kind::scalar, false, false}, g.mass);
    each({nullptr, Kind::scalar, false, false}, g.inertia);
    each({nullptr, Kind::scalar, false, false}, g.inverse_mass);
    each({nullptr, Kind::scalar, false, false}, g.inverse_inertia);
    each({&fields::material, Kind::scalar, false, false}, g.material);
    each({nullptr, Kind::vector, true, true}, g.wraps);
  }
  /// visit(GrainField, array) for each single array of all fields.
  template <class Self, class Visit>
  static void for_columns(Self& g, const Visit& visit) {
    for_fields(g, [&](const GrainField& field, auto columns) {
      for (auto& column : columns) visit(field, column);
    });
  }

  std::size_t size() const { return radius.size(); }

  Vec<D> place(std::size_t i) const { return gather(position, i); }
  Vec<D> speed(std::size_t i) const { return gather(velocity, i); }
  Vec<turns<D>> turning(std::size_t i) const { return gather(spin, i); }
  Orientation<D> attitude(std::size_t i) const { return gather(orientation, i); }

  void reserve(std::size_t count) {
    for_columns(*this, [&](const GrainField&, auto& column) { column.reserve(count); });
  }

  /// Adds a grain at rest; all moving grains must be added before the first fixed one.
  void add(const Vec<D>& r, double grain_radius, double grain_mass, double grain_inertia, bool moves) {
    for_columns(*this, [&](const GrainField& field, auto& column) {
      if (moves || !field.moving_only) column.push_back(0);
    });
    const std::size_t i = size() - 1;
    for (int k = 0; k < D; ++k) position[k][i] = r[k];
    for (int k = 0; k < orientation_numbers<D>; ++k) orientation[k][i] = as_at_start<D>()[k];
    radius[i] = grain_radius;
    mass[i] = grain_mass;
    inertia[i] = grain_inertia;
    inverse_mass[i] = moves ? 1 / grain_mass : 0;
    inverse_inertia[i] = moves ? 1 / grain_inertia : 0;
    moving += moves;
  }

  /// Puts the moving grains into another order: grain k becomes what grain from[k] was. Fixed ones stay.
  void reorder(std::span<const std::int32_t> from) {
    for_columns(*this, [&](const GrainField&, auto& column) { chute::reorder(column, from); });
  }

  /// Moving grains leave and come in: see chute::renew. New ones have nothing but zeros yet.
  void renew(std::span<const std::int32_t> stay, std::size_t more) {
    for_columns(*this, [&](const GrainField&, auto& column) { chute::renew(column, stay, moving, more); });
    moving = stay.size() + more;
  }

  /// What changes in a run, for checkpoints.
  template <class Archive>
  void serialize(Archive& archive) {
    for_columns(*this, [&](const GrainField& field, auto& column) {
      if (field.changes) archive(column);
    });
  }

 private:
  template <std::size_t K>
  static Vec<static_cast<int>(K)> gather(const std::array<Array, K>& field, std::size_t i) {
    Vec<static_cast<int>(K)> r;
    for (std::size_t k = 0; k < K; ++k) r[static_cast<int>(k)] = field[k][i];
    return r;
  }
};

/// One field of the grains as files hold it.
struct FieldView {
  GrainField what;
  std::vector<std::span<const double>> numbers;  ///< one span per component,
  std::span<const int> words;                    ///< or whole numbers
};

/// What observers and writers see of the grains, whatever the dimension and the engine: spans that stay valid
/// until the engine moves on. Components that do not exist in 2D are empty.
struct GrainsView {
  int dimensions = 2;
  double time = 0;
  std::size_t moving = 0;
  std::array<std::span<const double>, 3> position, velocity, force;
  std::array<std::span<const double>, 3> spin;         ///< in 2D only [0], about the plane's normal
  std::array<std::span<const double>, 4> orientation;  ///< in 2D only [0], an angle
  std::span<const double> radius, mass, inertia;
  std::span<const int> material;
  std::array<std::span<const int>, 3>
      wraps;                         ///< of the moving grains; with `period`, the way around the domain
  std::array<double, 3> period{};    ///< 0 where the domain is not periodic
  std::vector<FieldView> fields;     ///< those that files hold, but for `force`
  std::span<const std::int64_t> id;  ///< what files call them; empty: as they are numbered here

  std::size_t size() const { return radius.size(); }

  std::int64_t id_of(std::size_t i) const { return id.empty() ? static_cast<std::int64_t>(i) : id[i]; }
  /// Place of a moving grain in direction k, counted on through the periods.
  double unwrapped(std::size_t i, std::size_t k) const {
    return position[k][i] + static_cast<double>(wraps[k][i]) * period[k];
  }
  std::array<double, 3> place(std::size_t i) const {
    return {position[0][i], position[1][i], dimensions == 3 ? position[2][i] : 0};
  }
  /// The shortest way from grain i to grain j.
  std::array<double, 3> way(std::size_t i, std::size_t j) const {
    std::array<double, 3> d{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimensions); ++k) {
      d[k] = position[k][j] - position[k][i];
      if (period[k] > 0) d[k] = Domain<3>::nearest_image(d[k], period[k], period[k] / 2);
    }
    return d;
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
  for (std::size_t k = 0; k < turns<D>; ++k) view.spin[k] = grains.spin[k];
  for (std::size_t k = 0; k < orientation_numbers<D>; ++k) view.orientation[k] = grains.orientation[k];
  view.radius = grains.radius;
  view.mass = grains.mass;
  view.inertia = grains.inertia;
  view.material = grains.material;
  Grains<D>::for_fields(grains, [&](const GrainField& field, auto columns) {
    if (!field.file) return;
    FieldView& f = view.fields.emplace_back(FieldView{field, {}, {}});
    for (const auto& column : columns)
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(column)>, Array>)
        f.numbers.emplace_back(column);
      else
        f.words = column;
  });
  return view;
}

/// Brings the moving grains into the periods, and counts their turns around the domain.
template <int D>
void wrap_into(const Domain<D>& domain, Grains<D>& grains) {
  for (std::size_t k = 0; k < D; ++k) {
    const int axis = static_cast<int>(k);
    if (!domain.periodic(axis)) continue;
    const double lower = domain.lower[axis], length = domain.length[axis];
    for (std::size_t i = 0; i < grains.moving; ++i) {
      double& x = grains.position[k][i];
      const double laps = std::floor((x - lower) / length);
      x -= laps * length;
      grains.wraps[k][i] += static_cast<int>(laps);
    }
  }
}

/// Where the moving grains are, counted on through the periods.
template <int D>
std::array<Array, D> unwrapped_places(const GrainsView& grains) {
  std::array<Array, D> places;
  for (std::size_t k = 0; k < D; ++k) {
    places[k].resize(grains.moving);
    for (std::size_t i = 0; i < grains.moving; ++i) places[k][i] = grains.unwrapped(i, k);
  }
  return places;
}

}  // namespace chute
