#include "engines/soft/wall_contacts.hpp"

#include <algorithm>

namespace chute::soft {

template <int D>
WallContacts<D>::WallContacts(const Surroundings<D>& around, const LawTable& laws,
                              const std::vector<std::optional<LawTable>>& own, Kernels kernels)
    : domain_(around.domain), walls_(around.walls) {
  const auto add = [&](const LawTable& theirs) -> Group& {
    return groups_.emplace_back(Group{{}, ContactStages<D>(domain_, theirs, kernels.isa, kernels.rule)});
  };
  if (any()) add(laws);
  for (std::size_t w = 0; w < walls_.size(); ++w)
    (w < own.size() && own[w] ? add(*own[w]) : groups_.front()).walls.push_back(w);
}

template <int D>
typename WallContacts<D>::Touch WallContacts<D>::touch(std::size_t wall, const Vec<D>& place,
                                                       double time) const {
  const auto nearest = walls_[wall].nearest(place, time, domain_);
  return {nearest, walls_[wall].surface_velocity(nearest, time)};
}

/// A flat wall with edges is no nearer than the plane that it lies in, which is found much faster. With some room for rounding,
/// so that contacts are the same as without this.
template <int D>
bool WallContacts<D>::is_far(const Wall<D>& wall, const Vec<D>& place, double R, double time) const {
  constexpr double room = 1 + 1e-9;
  return wall.bounded() && std::abs(dot(wall.way_to(place, time, domain_), wall.normal)) > room * R;
}

template <int D>
void WallContacts<D>::find(const Grains<D>& grains, double time, double deepest, Group& group) const {
  Contacts<D>& contacts = group.contacts;
  contacts.count = 0;
  contacts.deep = 0;
  const bool several = group.stages.several_laws();
  const double apart = group.stages.apart();
  for (std::size_t i = 0; i < grains.moving; ++i) {
    const Vec<D> place = grains.place(i);
    for (const std::size_t w : group.walls) {
      const double R = grains.radius[i];
      if (is_far(walls_[w], place, R + apart, time)) continue;
      const auto nearest = walls_[w].nearest(place, time, domain_);
      const double overlap = R - nearest.height;
      if (!(overlap > -apart)) continue;
      contacts.reserve(contacts.count + 1);
      const std::size_t c = contacts.count++;
      contacts.i[c] = static_cast<std::int32_t>(i);
      contacts.j[c] = static_cast<std::int32_t>(grains.size() + w);
      if (several) contacts.law[c] = grains.material[i];
      contacts.m_eff[c] = 1 / grains.inverse_mass[i];
      contacts.r_eff[c] = walls_[w].effective_radius(R);
      const Vec<D> n = -1.0 * nearest.normal,
                   dv = walls_[w].surface_velocity(nearest, time) - grains.speed(i);
      const double v_n = dot(dv, n);
      for (int k = 0; k < D; ++k) contacts.normal[k][c] = n[k];
      if constexpr (D == 2) {
        contacts.slip[0][c] = dv[0] * n[1] - dv[1] * n[0] + R * grains.spin[0][i];
      } else {
        const Vec<3> turn = cross(n, R * grains.turning(i));
        for (int k = 0; k < 3; ++k) contacts.slip[k][c] = dv[k] - v_n * n[k] + turn[k];
      }
      contacts.overlap[c] = overlap;
      contacts.closing[c] = -v_n;
      contacts.deep |= overlap > deepest;
    }
  }
}

template <int D>
void WallContacts<D>::evaluate(const Grains<D>& grains, double time, double duration, double deepest,
                               GrainSums<D>& sums) {
  work_ = 0;
  for (auto& group : groups_) {
    find(grains, time, deepest, group);
    group.stages.evaluate_found(grains, group.contacts, duration);
    group.stages.apply_first(group.contacts, grains, duration, sums);
    if (duration > 0) work_ += duration * power(grains, time, group.contacts);
  }
}

/// Of the walls on the grains.
template <int D>
double WallContacts<D>::power(const Grains<D>& grains, double time, const Contacts<D>& contacts) const {
  double sum = 0;
  for (std::size_t c = 0; c < contacts.count; ++c) {
    const auto w = static_cast<std::size_t>(contacts.j[c]) - grains.size();
    if (!walls_[w].moves()) continue;
    Nearest<D> nearest;
    for (int k = 0; k < D; ++k) nearest.normal[k] = -contacts.normal[k][c];
    sum -= dot(force_on_second(contacts, c), walls_[w].surface_velocity(nearest, time));
  }
  return sum;
}

template <int D>
bool WallContacts<D>::deep() const {
  return std::ranges::any_of(groups_, [](const Group& group) { return group.contacts.deep != 0; });
}
template <int D>
double WallContacts<D>::released() const {
  double sum = 0;
  for (const auto& group : groups_) sum += group.stages.memory().released();
  return sum;
}
template <int D>
double WallContacts<D>::elastic_energy() const {
  double sum = 0;
  for (const auto& group : groups_) sum += group.stages.elastic_energy(group.contacts);
  return sum;
}
template <int D>
std::size_t WallContacts<D>::count() const {
  std::size_t sum = 0;
  for (const auto& group : groups_) sum += group.contacts.count;
  return sum;
}
template <int D>
std::vector<ContactMemory<D>> WallContacts<D>::memories() const {
  std::vector<ContactMemory<D>> all;
  for (const auto& group : groups_) all.push_back(group.stages.memory());
  return all;
}
template <int D>
void WallContacts<D>::remember(const std::vector<ContactMemory<D>>& memories) {
  for (std::size_t k = 0; k < groups_.size(); ++k) groups_[k].stages.memory() = memories[k];
}

template class WallContacts<2>;
template class WallContacts<3>;

}  // namespace chute::soft
