#include "engines/soft/contact_memory.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "engines/soft/memory_kernels.hpp"

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

/// What an ended contact leaves to the account.
template <int D>
void ContactMemory<D>::release(std::size_t old, double duration) {
  if (!shear_) return;
  const auto of = [&](int k) { return older_[static_cast<std::size_t>(k)][old]; };
  released_ += of(first_scalar());
  for (int k = 0; k < T; ++k)
    released_ -= 0.5 * duration * of(first_vector() + T + k) * of(first_vector() + k);
}

template <int D>
void ContactMemory<D>::begin() {
  released_ = 0;
  older_count_ = std::exchange(count_, 0);
  first_ = matched_ = 0;
  std::swap(i_, older_i_);
  std::swap(j_, older_j_);
  i_.clear(), j_.clear();
  std::swap(columns_, older_);
  columns_.resize(older_.size());
  // at least one: where nothing was, new contacts still look at the first and make nothing of it
  const auto have_one = [](Array& column) {
    if (column.empty()) column.resize(1);
  };
  std::ranges::for_each(older_, have_one);
  if constexpr (D == 3) {
    if (!shear_) return;
    std::swap(normal_, older_normal_);
    std::ranges::for_each(older_normal_, have_one);
  }
}

/// Both lists are ordered by (i, j).
template <int D>
void ContactMemory<D>::match_piece(const Contacts<D>& contacts, double duration) {
  const std::size_t count = contacts.count;
  source_.resize(count);
  const auto name = [](const std::int32_t* i, const std::int32_t* j, std::size_t c) {
    return static_cast<std::int64_t>(i[c]) << 32 | j[c];
  };
  const auto *i = contacts.i.data(), *j = contacts.j.data(), *i_old = older_i_.data(),
             *j_old = older_j_.data();
  std::size_t o = matched_;
  for (std::size_t c = 0; c < count; ++c) {
    const auto now = name(i, j, c);
    while (o < older_count_ && name(i_old, j_old, o) < now) release(o++, duration);
    const bool known = o < older_count_ && name(i_old, j_old, o) == now;
    source_[c] = known ? static_cast<std::int32_t>(o) : -1;
    o += known;
  }
  matched_ = o;
  i_.insert(i_.end(), i, i + count);
  j_.insert(j_.end(), j, j + count);
  first_ = std::exchange(count_, count_ + count);
  const auto hold_all = [&](Array& column) {
    if (column.size() < count_) column.resize(count_);
  };
  std::ranges::for_each(columns_, hold_all);
  if (!shear_) return;
  for (auto& way : way_) way.resize(count);
  if constexpr (D == 3) std::ranges::for_each(normal_, hold_all);
}

template <int D>
void ContactMemory<D>::end(double duration) {
  while (matched_ < older_count_) release(matched_++, duration);
  const auto trim = [&](Array& column) { column.resize(std::max<std::size_t>(1, count_)); };
  std::ranges::for_each(columns_, trim);
  if constexpr (D == 3)
    if (shear_) std::ranges::for_each(normal_, trim);
}

template <int D>
void ContactMemory<D>::carry(const Grains<D>& grains, const Contacts<D>& contacts, double duration,
                             Part range, Isa isa) {
  const auto take_over = [&](int k) {
    run_kernel(isa,
               TakeOverKernel{source_.data(), older_[static_cast<std::size_t>(k)].data(), range, column(k)});
  };
  for (int k = 0; k < normal_count_; ++k) take_over(k);
  if (!shear_) return;
  for (int k = 0; k < 1 + scalars_; ++k) take_over(first_scalar() + k);
  vectors_ == 1 ? carry_vectors<3>(grains, contacts, duration, range, isa)
                : carry_vectors<4>(grains, contacts, duration, range, isa);
  if constexpr (D == 3)
    for (std::size_t k = 0; k < 3; ++k)
      std::copy(contacts.normal[k].data() + range.begin, contacts.normal[k].data() + range.end,
                normal_[k].data() + first_ + range.begin);
}

/// Velocity of the slip, force, and V − 2 vectors of the law.
template <int D>
template <int V>
void ContactMemory<D>::carry_vectors(const Grains<D>& grains, const Contacts<D>& contacts, double duration,
                                     Part range, Isa isa) {
  CarryKernel<T, V> kernel{};
  kernel.source = source_.data(), kernel.first = contacts.i.data(), kernel.second = contacts.j.data();
  kernel.overlap = contacts.overlap.data(), kernel.closing = contacts.closing.data();
  kernel.grains = static_cast<std::int32_t>(grains.size());
  kernel.duration = duration, kernel.trapezoid = rule_ == SlipRule::trapezoid, kernel.range = range;
  for (std::size_t k = 0; k < static_cast<std::size_t>(T); ++k) {
    kernel.slip[k] = contacts.slip[k].data(), kernel.way[k] = way_[k].data();
    if constexpr (D == 3)
      kernel.spin[k] = grains.spin[k].data(), kernel.old_normal[k] = older_normal_[k].data(),
      kernel.normal[k] = contacts.normal[k].data();
    for (std::size_t v = 0; v < static_cast<std::size_t>(V); ++v) {
      const auto at = static_cast<std::size_t>(first_vector()) + v * static_cast<std::size_t>(T) + k;
      kernel.old[v][k] = older_[at].data(), kernel.now[v][k] = columns_[at].data() + first_;
    }
  }
  run_kernel(isa, kernel);
}

/// A contact whose grains change places is seen from the other side: in space its vectors turn round; in the plane they
/// are components along s, which turns with n as well.
template <int D>
void ContactMemory<D>::reorder(std::span<const std::int32_t> place) {
  first_ = 0;
  std::vector<std::int32_t> from(count_);
  std::iota(from.begin(), from.end(), 0);
  std::vector<char> turned(count_);
  const auto new_place = [&](std::int32_t k) {
    return static_cast<std::size_t>(k) < place.size() ? place[static_cast<std::size_t>(k)] : k;
  };
  for (std::size_t c = 0; c < count_; ++c) {
    i_[c] = new_place(i_[c]), j_[c] = new_place(j_[c]);
    turned[c] = i_[c] > j_[c];
    if (turned[c]) std::swap(i_[c], j_[c]);
  }
  if constexpr (D == 3)
    for (std::size_t c = 0; c < count_; ++c) {
      if (!turned[c] || !shear_) continue;
      for (int k = first_vector(); k < first_scalar(); ++k) column(k)[c] *= -1;
      for (auto& n : normal_) n[c] *= -1;
    }
  std::sort(from.begin(), from.end(), [&](std::int32_t a, std::int32_t b) {
    const auto x = static_cast<std::size_t>(a), y = static_cast<std::size_t>(b);
    return std::pair(i_[x], j_[x]) < std::pair(i_[y], j_[y]);
  });
  chute::reorder(i_, from);
  chute::reorder(j_, from);
  for (auto& column : columns_)
    if (!column.empty()) chute::reorder(column, from);
  for (auto& n : normal_)
    if (!n.empty()) chute::reorder(n, from);
}

template <int D>
void ContactMemory<D>::renumber(std::span<const std::int32_t> place, std::int32_t shift) {
  const auto now = [&](std::int32_t k) {
    return static_cast<std::size_t>(k) < place.size() ? place[static_cast<std::size_t>(k)] : k + shift;
  };
  std::vector<std::int32_t> from;
  for (std::size_t c = 0; c < count_; ++c) {
    i_[c] = now(i_[c]), j_[c] = now(j_[c]);
    if (i_[c] >= 0 && j_[c] >= 0) from.push_back(static_cast<std::int32_t>(c));
  }
  const auto keep = [&](auto& values) {
    if (!values.empty()) chute::reorder(values, from);
  };
  keep(i_), keep(j_);
  for (auto& column : columns_) keep(column);
  for (auto& n : normal_) keep(n);
  count_ = from.size();
  i_.resize(count_), j_.resize(count_);
}

template class ContactMemory<2>;
template class ContactMemory<3>;

}  // namespace chute::soft
