#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/vec.hpp"

namespace chute {

/// A wall's place among the partners of a contact: wall k is −1 − k.
constexpr std::int64_t wall_id(std::size_t wall) { return -1 - static_cast<std::int64_t>(wall); }
constexpr bool is_wall(std::int64_t id) { return id < 0; }

/// What two surfaces in contact do.
enum class ContactState : int { unknown = 0, stick = 1, slide = 2 };

/// A contact as every engine tells of it and everybody reads it: stresses, networks, files, figures. Vectors have the
/// components of files; in 2D the third is 0.
struct Contact {
  /// Places among the engine's grains, a < b, and a a moving grain; b may be a wall (see wall_id). Files have ids.
  std::int64_t a = 0, b = 0;
  std::array<double, 3> point{};   ///< where the surfaces touch, halfway through the overlap
  std::array<double, 3> normal{};  ///< n, from a to b (1.10)
  std::array<double, 3> branch{};  ///< from a's centre to b's, by the nearest image; to the wall's surface
  double overlap = 0;              ///< ξ; the negative gap of rigid grains
  std::array<double, 3> force{};   ///< on b: F_n n + F_s; of hard grains the impulse over the time it took
  double normal_force = 0;         ///< F_n, repulsion positive
  double shear_force = 0;          ///< 2D: along s = (n_y, −n_x); 3D: |F_s|
  ContactState state = ContactState::unknown;
  double impulse_time =
      0;  ///< of methods that give impulses: the step that they belong to, impulse = force × this
  double mobilisation = 0;  ///< |F_s|/(μ F_n) with the μ that binds it, where the method tells

  template <class Archive>
  void serialize(Archive& archive) {
    archive(a, b, point, normal, branch, overlap, force, normal_force, shear_force, state, impulse_time,
            mobilisation);
  }
};

/// A collision of hard grains: what passed between them at once. As a Contact, with impulses in place of forces.
struct Collision : Contact {
  double time = 0;
};

template <int D>
std::array<double, 3> as_file_vector(const Vec<D>& v) {
  std::array<double, 3> out{};
  for (int k = 0; k < D; ++k) out[static_cast<std::size_t>(k)] = v[k];
  return out;
}

/// The contact of a and b that `normal` and `force` (on b) describe; the other members are left as they are.
template <int D>
void set_force(Contact& contact, const Vec<D>& normal, const Vec<D>& force) {
  contact.normal = as_file_vector(normal);
  contact.force = as_file_vector(force);
  contact.normal_force = dot(force, normal);
  if constexpr (D == 2)
    contact.shear_force = force[0] * normal[1] - force[1] * normal[0];
  else
    contact.shear_force = norm(force - contact.normal_force * normal);
}

}  // namespace chute
