// How the soft engine lets grains come and go: what else is kept of them follows.
#include <numeric>

#include "core/sphere.hpp"
#include "engines/soft/soft_engine.hpp"

namespace chute::soft {

/// Grains that are beyond the end leave, and with them the energy of their motion and that of their contacts. What they have lost
/// and what gravity gave them stays in the account.
template <int D>
void SoftEngine<D>::let_out() {
  const auto leaves = [&](std::size_t i) { return exchange_.leaves(grains_, i); };
  std::size_t first = 0;
  while (first < grains_.moving && !leaves(first)) ++first;
  if (first == grains_.moving) return;
  back_to_ids();
  look_again();
  const auto now = energy();
  const Vec<D> g = setup_.tilt ? Vec<D>{} : setup_.gravity;
  const auto view = grains();
  std::vector<std::int32_t> stay;
  for (std::size_t i = 0; i < grains_.moving; ++i) {
    if (!leaves(i)) {
      stay.push_back(static_cast<std::int32_t>(i));
      continue;
    }
    exchange_.let_out(grains_, i);
    for (std::size_t k = 0; k < D; ++k)
      account_.gravity_work +=
          grains_.mass[i] * g[static_cast<int>(k)] * (view.unwrapped(i, k) - start_place_[k][i]);
    account_.normal_loss += sums_.normal_loss[i];
    account_.shear_loss += sums_.shear_loss[i];
  }
  renew(stay, {});
  account_.outflow += now.stored() - energy().stored();
}

template <int D>
void SoftEngine<D>::let_in() {
  back_to_ids();
  const auto come = exchange_.let_in(grains_, step_);
  if (come.empty()) return;
  std::vector<std::int32_t> stay(grains_.moving);
  std::iota(stay.begin(), stay.end(), 0);
  renew(stay, come);
  for (const auto& [grain, place, velocity] : come)
    account_.inflow += 0.5 * grain.mass * dot(velocity, velocity);
}

/// Of the moving grains those at `stay` are left, and others come. Grains are kept in the order of their ids.
template <int D>
void SoftEngine<D>::renew(std::span<const std::int32_t> stay, std::span<const Arrival<D>> come) {
  const std::size_t before = grains_.moving, more = come.size();
  std::vector<std::int32_t> place(before, -1);
  for (std::size_t k = 0; k < stay.size(); ++k)
    place[static_cast<std::size_t>(stay[k])] = static_cast<std::int32_t>(k);
  resize(stay, more);
  const auto shift = static_cast<std::int32_t>(grains_.moving) - static_cast<std::int32_t>(before);
  stages_.memory().renumber(place, shift);
  walls_.renumber(place, shift);
  for (std::size_t k = 0; k < more; ++k) put_in(stay.size() + k, come[k]);
  // Ids go on behind all that there ever were.
  for (std::size_t k = 0; k < more; ++k)
    ids_[stay.size() + k] = grains_at_start_ + exchange_.entered() - static_cast<std::int64_t>(more - k);
  watch_overlaps();
  look_again();
}

/// The arrays of all that is kept of grains, for those that stay and so many more (zeros).
template <int D>
void SoftEngine<D>::resize(std::span<const std::int32_t> stay, std::size_t more) {
  const std::size_t before = grains_.moving;
  const auto each = [&](auto& values) { chute::renew(values, stay, before, more); };
  const std::size_t orders = setup_.scheme == Scheme::gear5 ? 3 : 1;
  for (std::size_t order = 0; order < orders; ++order)
    for (auto& a : integrator_.derivatives()[order]) each(a);
  for (auto& a : start_place_) each(a);
  each(sums_.normal_loss), each(sums_.shear_loss), each(ids_);
  grains_.renew(stay, more);
  sums_.resize(grains_.size());
  sums_.clear({0, grains_.size()});
  contacts_.count = 0;
  list_.start_over();
}

/// A grain that has come in.
template <int D>
void SoftEngine<D>::put_in(std::size_t at, const Arrival<D>& arrival) {
  const auto& [grain, r, v] = arrival;
  const Vec<D> g = setup_.gravity_at(time());
  for (int k = 0; k < D; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    grains_.position[axis][at] = start_place_[axis][at] = r[k];
    grains_.velocity[axis][at] = v[k];
    integrator_.derivatives()[0][axis][at] = g[k];
  }
  for (int k = 0; k < orientation_numbers<D>; ++k)
    grains_.orientation[static_cast<std::size_t>(k)][at] = as_at_start<D>()[k];
  grains_.radius[at] = grain.radius;
  grains_.mass[at] = grain.mass;
  grains_.inertia[at] = sphere_inertia(grain.mass, grain.radius);
  grains_.inverse_mass[at] = 1 / grain.mass;
  grains_.inverse_inertia[at] = setup_.inflow->rotation ? 1 / grains_.inertia[at] : 0;
  grains_.material[at] = grain.material;
}

template void SoftEngine<2>::let_out();
template void SoftEngine<3>::let_out();
template void SoftEngine<2>::let_in();
template void SoftEngine<3>::let_in();
template void SoftEngine<2>::resize(std::span<const std::int32_t>, std::size_t);
template void SoftEngine<3>::resize(std::span<const std::int32_t>, std::size_t);

}  // namespace chute::soft
