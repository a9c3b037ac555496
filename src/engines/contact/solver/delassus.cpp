#include "engines/contact/solver/delassus.hpp"

#include "engines/contact/solver/assemble.hpp"

namespace chute::contact {
namespace {

/// How the velocity at a contact, in its frame, changes with the motion of one of its bodies: Hᵀ, one row an axis.
template <int D>
struct Jacobian {
  std::int32_t body;
  Block<D> linear;
  std::array<Turn<D>, D> angular;
};

template <int D>
Jacobian<D> jacobian(std::int32_t body, double sign, const Vec<D>& normal, const Vec<D>& arm) {
  Jacobian<D> h{body, frame_of(normal), {}};
  for (int k = 0; k < D; ++k) {
    Vec<D> axis;
    for (int l = 0; l < D; ++l) axis[l] = h.linear(k, l) *= sign;
    if constexpr (D == 2)
      h.angular[static_cast<std::size_t>(k)][0] = arm[0] * axis[1] - arm[1] * axis[0];
    else
      h.angular[static_cast<std::size_t>(k)] = cross(arm, axis);
  }
  return h;
}

}  // namespace

template <int D>
Problem<D> delassus(const BodyArrays<D>& bodies, const ContactArrays<D>& contacts) {
  const auto m = contacts.size();
  std::vector<std::array<Jacobian<D>, 2>> sides;
  std::vector<Vec<D>> q(contacts.offset.begin(), contacts.offset.end());
  for (std::size_t i = 0; i < m; ++i) {
    sides.push_back({jacobian<D>(contacts.a[i], 1, contacts.normal[i], contacts.arm_a[i]),
                     jacobian<D>(contacts.b[i], -1, contacts.normal[i], contacts.arm_b[i])});
    for (const auto& h : sides.back()) {
      if (h.body < 0) continue;
      const auto body = static_cast<std::size_t>(h.body);
      Vec<D> v;
      Turn<D> spin;
      for (int k = 0; k < D; ++k) v[k] = bodies.velocity[static_cast<std::size_t>(k)][body];
      for (std::size_t k = 0; k < bodies.spin.size(); ++k) spin[static_cast<int>(k)] = bodies.spin[k][body];
      q[i] = q[i] + h.linear * v;
      for (int k = 0; k < D; ++k) q[i][k] += dot(h.angular[static_cast<std::size_t>(k)], spin);
    }
  }
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < m; ++j)
      for (const auto& one : sides[i])
        for (const auto& other : sides[j]) {
          if (one.body < 0 || one.body != other.body) continue;
          const auto body = static_cast<std::size_t>(one.body);
          for (int k = 0; k < D; ++k)
            for (int l = 0; l < D; ++l) {
              double along = 0;
              for (int x = 0; x < D; ++x) along += one.linear(k, x) * other.linear(l, x);
              entries.push_back(
                  {i * D + static_cast<std::size_t>(k), j * D + static_cast<std::size_t>(l),
                   bodies.inverse_mass[body] * along +
                       bodies.inverse_inertia[body] * dot(one.angular[static_cast<std::size_t>(k)],
                                                          other.angular[static_cast<std::size_t>(l)])});
            }
        }
  return assemble<D>(entries, std::move(q),
                     std::vector<double>(contacts.friction.begin(), contacts.friction.end()));
}

template Problem<2> delassus(const BodyArrays<2>&, const ContactArrays<2>&);
template Problem<3> delassus(const BodyArrays<3>&, const ContactArrays<3>&);

}  // namespace chute::contact
