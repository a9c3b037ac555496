#include "engines/soft/contact_memory.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace chute::soft {

template <int D>
ContactMemory<D>::ContactMemory(const laws::ContactLaws& laws, SlipRule rule) : rule_(rule) {
  std::visit(
      [&]<class Law>(const Law&) {
        if constexpr (laws::NormalWithMemory<Law>) normal_count_ = Law::memory;
      },
      laws.normal);
  std::visit(
      [&]<class Law>(const Law&) {
        if constexpr (laws::ShearWithMemory<Law>)
          shear_ = true, vectors_ = Law::vectors, scalars_ = Law::scalars;
      },
      laws.shear);
  columns_.resize(static_cast<std::size_t>(first_scalar() + (shear_ ? 1 + scalars_ : 0)));
}

template <int D>
void ContactMemory<D>::carry(const Grains<D>& grains, const Contacts<D>& contacts, double duration) {
  match(contacts, duration);
  if (!shear_) return;
  if constexpr (D == 3) turn(grains, contacts, duration);
  find_ways(contacts, duration);
}

/// Both lists are ordered by (i, j).
template <int D>
void ContactMemory<D>::match(const Contacts<D>& contacts, double duration) {
  const std::size_t count = contacts.count;
  source_.assign(count, -1);
  released_ = 0;
  const auto end = [&](std::size_t o) {
    if (!shear_) return;
    released_ += stored_column()[o];
    for (int k = 0; k < T; ++k) released_ -= 0.5 * duration * previous_force(k)[o] * previous_slip(k)[o];
  };
  std::size_t o = 0;
  for (std::size_t c = 0; c < count; ++c) {
    const std::pair now{contacts.i[c], contacts.j[c]};
    for (; o < count_ && std::pair{i_[o], j_[o]} < now; ++o) end(o);
    if (o < count_ && std::pair{i_[o], j_[o]} == now) source_[c] = static_cast<std::int32_t>(o++);
  }
  for (; o < count_; ++o) end(o);

  std::swap(columns_, older_);
  columns_.resize(older_.size());
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    columns_[k].resize(count);
    for (std::size_t c = 0; c < count; ++c)
      columns_[k][c] = source_[c] < 0 ? 0 : older_[k][static_cast<std::size_t>(source_[c])];
  }
  i_.assign(contacts.i.begin(), contacts.i.begin() + static_cast<std::ptrdiff_t>(count));
  j_.assign(contacts.j.begin(), contacts.j.begin() + static_cast<std::ptrdiff_t>(count));
  count_ = count;
}

template <int D>
void ContactMemory<D>::turn(const Grains<D>& grains, const Contacts<D>& contacts, double duration) {
  if constexpr (D == 3) {
    for (std::size_t c = 0; c < count_; ++c) {
      if (source_[c] < 0) continue;
      const auto o = static_cast<std::size_t>(source_[c]);
      const auto i = static_cast<std::size_t>(i_[c]), j = static_cast<std::size_t>(j_[c]);
      Vec<3> old, now, spins;
      for (int k = 0; k < 3; ++k) {
        old[k] = normal_[k][o];
        now[k] = contacts.normal[k][c];
        spins[k] = grains.spin[k][i] + (j < grains.size() ? grains.spin[k][j] : 0);  // walls do not turn
      }
      const Vec<3> axis = cross(old, now);
      const double cosine = dot(old, now), twist = 0.5 * duration * dot(spins, now);
      const double c_twist = std::cos(twist), s_twist = std::sin(twist);
      for (int v = 0; v < 2 + vectors_; ++v) {
        Vec<3> a;
        for (int k = 0; k < 3; ++k) a[k] = column(first_vector() + v * T + k)[c];
        a = cosine * a + cross(axis, a) + (dot(axis, a) / (1 + cosine)) * axis;
        a = c_twist * a + s_twist * cross(now, a);
        a = a -
            dot(a, now) * now;  // rounding must not tilt it out of the plane in the course of a long contact
        for (int k = 0; k < 3; ++k) column(first_vector() + v * T + k)[c] = a[k];
      }
    }
    for (int k = 0; k < 3; ++k)
      normal_[k].assign(contacts.normal[k].begin(),
                        contacts.normal[k].begin() + static_cast<std::ptrdiff_t>(count_));
  }
}

template <int D>
void ContactMemory<D>::find_ways(const Contacts<D>& contacts, double duration) {
  for (int k = 0; k < T; ++k) {
    way_[k].resize(count_);
    double* before = previous_slip(k);
    for (std::size_t c = 0; c < count_; ++c) {
      const double now = contacts.slip[k][c];
      if (source_[c] < 0) {  // it began when ξ was 0
        const double closing = contacts.closing[c];
        way_[k][c] = now * (closing > 0 ? std::min(duration, contacts.overlap[c] / closing) : duration);
      } else {
        way_[k][c] = duration * (rule_ == SlipRule::trapezoid ? 0.5 * (before[c] + now) : now);
      }
      before[c] = now;
    }
  }
}

template class ContactMemory<2>;
template class ContactMemory<3>;

}  // namespace chute::soft
