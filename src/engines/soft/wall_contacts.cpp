#include "engines/soft/wall_contacts.hpp"

namespace chute::soft {

template <int D>
void WallContacts<D>::find(const Grains<D>& grains, double deepest, Contacts<D>& contacts) const {
  contacts.count = 0;
  contacts.deep = 0;
  for (std::size_t i = 0; i < grains.moving; ++i) {
    const Vec<D> place = grains.place(i);
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      const double R = grains.radius[i], overlap = R - walls_[w].height(place);
      if (!(overlap > 0)) continue;
      contacts.reserve(contacts.count + 1);
      const std::size_t c = contacts.count++;
      contacts.i[c] = static_cast<std::int32_t>(i);
      contacts.j[c] = static_cast<std::int32_t>(grains.size() + w);
      contacts.m_eff[c] = 1 / grains.inverse_mass[i];
      contacts.r_eff[c] = R;
      const Vec<D> n = -1.0 * walls_[w].normal, dv = -1.0 * grains.speed(i);
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

template class WallContacts<2>;
template class WallContacts<3>;

}  // namespace chute::soft
