#pragma once
#include "engines/contact/solver/one_contact.hpp"
#include "engines/contact/solver/sweep_order.hpp"

namespace chute::contact {

/// A turn has one component in the plane and three in space.
template <int D>
using Turn = Vec<D == 2 ? 1 : 3>;

/// The bodies of a problem, one array per component, as grains are kept. `velocity` and `spin` are those
/// without impulses; `solve` leaves those with them. A fixed body has both inverses 0 and may move.
template <int D>
struct BodyArrays {
  std::array<std::span<double>, D> velocity;
  std::array<std::span<double>, (D == 2 ? 1 : 3)> spin;
  std::span<const double> inverse_mass, inverse_inertia;

  std::size_t size() const { return inverse_mass.size(); }
};

/// Contacts between them, one array per field. The normal points from b into a; b = −1 is a wall at rest. An
/// impulse acts on a, its opposite on b, both at the point of contact.
template <int D>
struct ContactArrays {
  std::span<const std::int32_t> a, b;
  std::span<const Vec<D>> normal;
  std::span<const Vec<D>> arm_a, arm_b;  ///< from each body's centre to the point of contact
  std::span<const double> friction;
  /// What is added to the relative velocity in the contact's frame: gap/h, e_n v_n of an impact, a wall's own
  /// velocity with the opposite sign.
  std::span<const Vec<D>> offset;
  /// In the contact's frame (see `frame_of`): in, what to start from; out, the solution.
  std::span<Vec<D>> impulse;

  std::size_t size() const { return normal.size(); }
};

/// A contact's axes, row by row: the normal, and s = (n_y, −n_x) in the plane, or two more in space that depend
/// on the normal alone. `frame * v` are the components of v; `transposed(frame) * r` is the vector again.
template <int D>
Block<D> frame_of(const Vec<D>& normal) {
  Block<D> frame;
  for (int k = 0; k < D; ++k) frame(0, k) = normal[k];
  if constexpr (D == 2) {
    frame(1, 0) = normal[1];
    frame(1, 1) = -normal[0];
  } else {
    // Duff et al. 2017: no branch, no loss of accuracy for any normal
    const double sign = std::copysign(1, normal[2]);
    const double p = -1 / (sign + normal[2]), q = normal[0] * normal[1] * p;
    const double rows[2][3] = {{1 + sign * normal[0] * normal[0] * p, sign * q, -sign * normal[0]},
                               {q, sign + normal[1] * normal[1] * p, -normal[1]}};
    for (int k = 0; k < 3; ++k) frame(1, k) = rows[0][k], frame(2, k) = rows[1][k];
  }
  return frame;
}

/// Frameᵀ r.
template <int D>
Vec<D> out_of_frame(const Block<D>& frame, const Vec<D>& r) {
  Vec<D> x;
  for (int k = 0; k < D; ++k)
    for (int i = 0; i < D; ++i) x[k] += frame(i, k) * r[i];
  return x;
}

/// A problem without its matrix: the bodies' velocities carry what one contact does to another, so that a
/// sweep costs the same for each contact however many touch its bodies.
template <int D>
class BodySystem {
 public:
  static constexpr int dimensions = D;

  BodySystem(const BodyArrays<D>& bodies, const ContactArrays<D>& contacts, Team& team);

  const SweepOrder& order() const { return order_; }
  const OneContact<D>& contact(std::size_t place) const { return contacts_[place]; }
  std::vector<Vec<D>>& impulses() { return r_; }
  const std::vector<Vec<D>>& impulses() const { return r_; }

  /// Relative velocity at a contact without its own impulse.
  Vec<D> without(std::size_t place) const {
    const auto& g = geometry_[place];
    const auto& one = motion_[g.a];
    const auto& other = motion_[g.b];
    const auto relative =
        one.velocity + across(one.spin, g.arm_a) - other.velocity - across(other.spin, g.arm_b);
    return g.frame * relative + g.offset - contacts_[place].w() * r_[place];
  }
  void set(std::size_t place, const Vec<D>& r) {
    push(place, r - r_[place]);
    r_[place] = r;
  }
  /// The bodies' velocities anew, after `impulses` were written as a whole.
  void refresh(Team& team);
  void set_friction(std::span<const double> friction);

  /// √Σ|ρ q|²: the impulses that would stop all contacts one by one, the measure of the residual.
  double reference() const { return reference_; }
  /// Impulses in the contacts' own order.
  std::vector<Vec<D>> result() const;
  /// Writes velocities, spins and impulses.
  void hand_back(const BodyArrays<D>& bodies, const ContactArrays<D>& contacts) const;

 private:
  struct Motion {
    Vec<D> velocity;
    Turn<D> spin;
    double inverse_mass, inverse_inertia;
  };
  struct Geometry {
    std::uint32_t a, b;
    bool moves_a, moves_b;
    Block<D> frame;
    Vec<D> arm_a, arm_b, offset;
  };
  SweepOrder order_;
  std::vector<Geometry> geometry_;
  std::vector<OneContact<D>> contacts_;
  std::vector<Motion> motion_, free_;  // the last is the wall at rest
  std::vector<Vec<D>> r_;
  double reference_ = 0;

  /// spin × arm.
  static Vec<D> across(const Turn<D>& spin, const Vec<D>& arm) {
    if constexpr (D == 2)
      return {{-spin[0] * arm[1], spin[0] * arm[0]}};
    else
      return cross(spin, arm);
  }
  /// arm × impulse.
  static Turn<D> torque(const Vec<D>& arm, const Vec<D>& impulse) {
    if constexpr (D == 2)
      return {{arm[0] * impulse[1] - arm[1] * impulse[0]}};
    else
      return cross(arm, impulse);
  }
  void push(std::size_t place, const Vec<D>& change) {
    const auto& g = geometry_[place];
    const auto impulse = out_of_frame(g.frame, change);
    if (g.moves_a) {
      auto& m = motion_[g.a];
      m.velocity = m.velocity + m.inverse_mass * impulse;
      m.spin = m.spin + m.inverse_inertia * torque(g.arm_a, impulse);
    }
    if (g.moves_b) {
      auto& m = motion_[g.b];
      m.velocity = m.velocity - m.inverse_mass * impulse;
      m.spin = m.spin - m.inverse_inertia * torque(g.arm_b, impulse);
    }
  }
  Block<D> own_block(const Geometry& g) const;
};

}  // namespace chute::contact
