#pragma once
#include "engines/contact/solver/one_contact.hpp"
#include "engines/contact/solver/sweep_order.hpp"

namespace chute::contact {

/// A problem with its matrix, laid out for sweeps: contacts in the order in which they are visited, the
/// diagonal blocks apart.
template <int D>
class AssembledSystem {
 public:
  static constexpr int dimensions = D;

  /// `r`: impulses to start from, one per contact, or none.
  explicit AssembledSystem(const Problem<D>& problem, std::span<const Vec<D>> r = {});

  const SweepOrder& order() const { return order_; }
  const OneContact<D>& contact(std::size_t place) const { return contacts_[place]; }
  std::vector<Vec<D>>& impulses() { return r_; }
  const std::vector<Vec<D>>& impulses() const { return r_; }

  /// Relative velocity at a contact without its own impulse.
  Vec<D> without(std::size_t place) const {
    Vec<D> u = q_[place];
    for (auto k = starts_[place]; k < starts_[place + 1]; ++k) u = u + blocks_[k] * r_[columns_[k]];
    return u;
  }
  void set(std::size_t place, const Vec<D>& r) { r_[place] = r; }
  /// After `impulses` were written as a whole.
  void refresh(Team&) {}
  void set_friction(std::span<const double> friction);

  /// √Σ|ρ q|²: the impulses that would stop all contacts one by one, the measure of the residual.
  double reference() const;
  /// In the contacts' own order.
  std::vector<Vec<D>> result() const;

 private:
  SweepOrder order_;
  std::vector<std::size_t> starts_;
  std::vector<std::uint32_t> columns_;  // places
  std::vector<Block<D>> blocks_;
  std::vector<OneContact<D>> contacts_;
  std::vector<Vec<D>> q_, r_;
};

}  // namespace chute::contact
