#include "engines/contact/solver/body_system.hpp"

#include <algorithm>
#include <cassert>

namespace chute::contact {

template <int D>
Block<D> BodySystem<D>::own_block(const Geometry& g) const {
  const auto& one = motion_[g.a];
  const auto& other = motion_[g.b];
  Block<D> w;
  for (int k = 0; k < D; ++k) {
    Vec<D> axis;
    for (int i = 0; i < D; ++i) axis[i] = g.frame(k, i);
    for (int l = 0; l < D; ++l) {
      Vec<D> second;
      for (int i = 0; i < D; ++i) second[i] = g.frame(l, i);
      w(k, l) = (k == l ? one.inverse_mass + other.inverse_mass : 0) +
                one.inverse_inertia * dot(torque(g.arm_a, axis), torque(g.arm_a, second)) +
                other.inverse_inertia * dot(torque(g.arm_b, axis), torque(g.arm_b, second));
    }
  }
  return w;
}

template <int D>
BodySystem<D>::BodySystem(const BodyArrays<D>& bodies, const ContactArrays<D>& contacts, Team& team) {
  const auto count = bodies.size(), m = contacts.size();
  motion_.resize(count + 1);
  for (std::size_t i = 0; i < count; ++i) {
    auto& body = motion_[i];
    for (int k = 0; k < D; ++k) body.velocity[k] = bodies.velocity[k][i];
    for (std::size_t k = 0; k < bodies.spin.size(); ++k) body.spin[static_cast<int>(k)] = bodies.spin[k][i];
    body.inverse_mass = bodies.inverse_mass[i];
    body.inverse_inertia = bodies.inverse_inertia[i];
  }
  motion_.back() = {{}, {}, 0, 0};
  free_ = motion_;

  const auto moves = [&](std::int32_t body) {
    return body >= 0 && (motion_[static_cast<std::size_t>(body)].inverse_mass > 0 ||
                         motion_[static_cast<std::size_t>(body)].inverse_inertia > 0);
  };
  if (m < few_contacts) {
    order_ = natural_order(m);
  } else {
    std::vector<std::int32_t> a(contacts.a.begin(), contacts.a.end()),
        b(contacts.b.begin(), contacts.b.end());
    for (auto* side : {&a, &b})
      for (auto& body : *side)
        if (!moves(body)) body = -1;
    order_ = coloured_by_bodies(a, b, count);
  }

  geometry_.resize(m);
  contacts_.resize(m);
  r_.assign(m, {});
  const auto index = [&](std::int32_t body) {
    return static_cast<std::uint32_t>(body < 0 ? count : static_cast<std::size_t>(body));
  };
  for (std::size_t k = 0; k < m; ++k) {
    const auto i = order_.contacts[k];
    auto& g = geometry_[k];
    g = {index(contacts.a[i]),         index(contacts.b[i]), moves(contacts.a[i]), moves(contacts.b[i]),
         frame_of(contacts.normal[i]), contacts.arm_a[i],    contacts.arm_b[i],    contacts.offset[i]};
    contacts_[k] = OneContact<D>(own_block(g), contacts.friction[i]);
    assert(contacts_[k].w()(0, 0) > 0 && "a contact needs a body that moves");
    const auto q = without(k);
    reference_ += std::pow(contacts_[k].rho(), 2) * dot(q, q);
  }
  reference_ = std::sqrt(reference_);
  for (std::size_t k = 0; k < m; ++k)
    r_[k] = project_on_cone(contacts.impulse[order_.contacts[k]], contacts_[k].friction());
  refresh(team);
}

template <int D>
void BodySystem<D>::refresh(Team& team) {
  motion_ = free_;
  order_.visit(team, [this](std::size_t place) { push(place, r_[place]); });
}

template <int D>
void BodySystem<D>::set_friction(std::span<const double> friction) {
  for (std::size_t k = 0; k < contacts_.size(); ++k)
    contacts_[k] = OneContact<D>(contacts_[k].w(), friction[order_.contacts[k]]);
}

template <int D>
void BodySystem<D>::hand_back(const BodyArrays<D>& bodies, const ContactArrays<D>& contacts) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (int k = 0; k < D; ++k) bodies.velocity[k][i] = motion_[i].velocity[k];
    for (std::size_t k = 0; k < bodies.spin.size(); ++k)
      bodies.spin[k][i] = motion_[i].spin[static_cast<int>(k)];
  }
  std::ranges::copy(result(), contacts.impulse.begin());
}

template <int D>
std::vector<Vec<D>> BodySystem<D>::result() const {
  std::vector<Vec<D>> r(r_.size());
  for (std::size_t k = 0; k < r.size(); ++k) r[order_.contacts[k]] = r_[k];
  return r;
}

template class BodySystem<2>;
template class BodySystem<3>;

}  // namespace chute::contact
