#pragma once
#include <memory>

#include "core/engine.hpp"
#include "search/neighbour_list.hpp"
#include "soft/contact_stages.hpp"
#include "soft/integrator.hpp"

namespace chute::soft {

/// What a soft-sphere run needs besides its grains.
template <int D>
struct SoftSetup {
  Domain<D> domain;
  Vec<D> gravity{};
  laws::Contact laws;
  Scheme scheme = Scheme::gear5;
  double time_step = 0;
  typename search::NeighbourList<D>::Skins skins{};
  double deepest_overlap = 0.25;  ///< of the smallest radius; beyond it the run has left physics
  double floor = -std::numeric_limits<double>::infinity();  ///< a grain below (last coordinate) is lost
  double contact_time = 0;  ///< t_n of a usual impact: what impacts call rolling (core/impact.hpp)
  search::Method search = search::Method::cells;
  Isa isa = best_isa();
  int threads = 1;  ///< results do not depend on it
};

/// Time-step driven molecular dynamics of soft grains, thesis 2.1.1. A step:
/// predict → neighbour list → contacts → forces → account → impacts → correct.
template <int D>
class SoftEngine final : public Engine {
 public:
  SoftEngine(Grains<D> grains, const SoftSetup<D>& setup);

  void advance_to(std::int64_t step) override;
  std::int64_t step() const override { return step_; }
  double time_step() const override { return setup_.time_step; }
  GrainsView grains() const override;
  EnergyAccount energy() const override;
  std::vector<ContactRecord> contacts() const override;
  void collect_impacts(bool on) override;
  std::vector<Impact> take_impacts() override;
  void save(std::ostream& out) const override;
  void restore(std::istream& in) override;

  const Grains<D>& state() const { return grains_; }
  const search::NeighbourList<D>& neighbours() const { return list_; }

 private:
  SoftSetup<D> setup_;
  Grains<D> grains_;
  search::NeighbourList<D> list_;
  ContactStages<D> stages_;
  Integrator<D> integrator_;
  Contacts<D> contacts_;
  GrainSums<D> sums_;
  std::array<Array, D> start_place_;  // of the moving grains, for gravity's work
  EnergyAccount account_;             // start, and the losses that are no grain's; the rest when asked for
  std::int64_t step_ = 0;
  bool collecting_ = false;
  std::vector<Impact> impacts_;
  std::vector<std::pair<std::int32_t, std::int32_t>> touched_;  // contacts of the previous step
  TouchLog touches_;
  std::unique_ptr<Team> team_;

  void forces(double duration);
  void check_overlaps() const;
  void find_impacts();
  void remember_touching();
  Impact impact(std::size_t contact) const;
  void check_floor() const;
  [[noreturn]] void leave_physics(std::size_t grain, const std::string& what) const;
  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self);
};

/// The skins that make steps cheapest for grains of about the given diameter; results do not depend on them.
template <int D>
typename search::NeighbourList<D>::Skins usual_skins(double diameter) {
  return {0.04 * diameter, 0.3 * diameter};
}

}  // namespace chute::soft
