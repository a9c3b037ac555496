#pragma once
#include <memory>

#include "core/engine.hpp"
#include "engines/soft/contact_stages.hpp"
#include "engines/soft/exchange.hpp"
#include "engines/soft/integrator.hpp"
#include "engines/soft/soft_setup.hpp"
#include "engines/soft/strips.hpp"
#include "engines/soft/time_tiles.hpp"
#include "engines/soft/wall_contacts.hpp"
#include "search/neighbour_list.hpp"

namespace chute::soft {

/// Time-step driven molecular dynamics of soft grains, thesis 2.1.1. A step:
/// predict → neighbour list → contacts → forces → account → impacts → correct.
///
/// Inside, many grains are kept in the order of Strips, and take several steps at once (TimeTiles) where
/// nobody looks. Outside they always have their ids: those of the start, and of grains that come in meanwhile (Exchange) the
/// numbers that follow. Then the moving grains lie in the order of these ids, and GrainsView::id tells them.
template <int D>
class SoftEngine final : public Engine {
 public:
  SoftEngine(Grains<D> grains, const SoftSetup<D>& setup);

  std::int64_t step() const override { return step_; }
  double time_step() const override { return setup_.time_step; }
  GrainsView grains() const override;
  EnergyAccount energy() const override;
  std::vector<Contact> contacts() const override;
  void collect_impacts(bool on) override;
  std::vector<Impact> take_impacts() override;
  std::vector<Parting> take_partings() override { return std::exchange(partings_, {}); }
  std::vector<std::pair<std::string, double>> tells() const override;
  void save(std::ostream& out) const override;
  void restore(std::istream& in) override;

  /// The grains by their ids; a copy if they are kept in another order, which stays until the next call.
  const Grains<D>& state() const;
  /// Which of `state()` the grain is that is kept at this place of the order.
  std::size_t id_at(std::size_t place) const {
    return place < order_.size() ? static_cast<std::size_t>(order_[place]) : place;
  }
  /// Steps that were taken several at once.
  std::int64_t tiled_steps() const { return tiled_steps_; }
  /// How often such steps had to be taken back.
  std::int64_t undone() const { return undone_; }
  const search::NeighbourList<D>& neighbours() const { return list_; }

 private:
  void advance(std::int64_t step) override;
  void advance_same_grains(std::int64_t step);

  SoftSetup<D> setup_;
  Grains<D> grains_;
  ContactStages<D> stages_;
  search::NeighbourList<D> list_;
  Integrator<D> integrator_;
  WallContacts<D> walls_;
  Exchange<D> exchange_;
  std::int64_t grains_at_start_;   // bed and all: those that come in are numbered from here on
  std::vector<std::int64_t> ids_;  // of all grains as `state()` has them; empty where nobody comes or goes
  Contacts<D> contacts_;
  Contacts<D> piece_;  // of them, where nobody looks at all
  bool whole_ = true;  // does contacts_ tell of the last step?
  GrainSums<D> sums_;
  std::array<Array, D> start_place_;  // of the moving grains, for gravity's work
  EnergyAccount account_;             // start, and the losses that are no grain's; the rest when asked for
  std::int64_t step_ = 0;
  bool collecting_ = false;
  std::vector<Impact> impacts_;
  std::vector<Parting> partings_;
  std::vector<std::pair<std::int32_t, std::int32_t>> touched_,
      touched_before_;  // contacts of the last two steps
  TouchLog touches_;
  std::unique_ptr<Team> team_;
  std::vector<std::int32_t> order_;  // id of the grain at each place; empty: as they are
  std::unique_ptr<Strips<D>> strips_ = std::make_unique<Strips<D>>();
  std::unique_ptr<TimeTiles<D>> tiles_;
  std::int64_t tiled_steps_ = 0, undone_ = 0;
  std::int64_t tile_pause_ = 0, no_tiles_until_ = 0;  // after blocks that had to be undone
  mutable Grains<D> by_id_;                           // for who looks, if they are kept in another order
  mutable std::array<Array, D> force_by_id_;

  search::Candidates<D> candidates();
  void forces(double duration, bool looked_at = true);
  bool sorts() const;
  bool advance_in_tiles(std::int64_t step);
  void sort();
  void reorder(std::span<const std::int32_t> from);
  void back_to_ids();
  void look_again();
  std::vector<std::int32_t> places() const;
  void tilt();
  void watch_overlaps();
  void check_overlaps() const;
  void let_out();
  void let_in();
  void renew(std::span<const std::int32_t> stay, std::span<const Arrival<D>> come);
  void resize(std::span<const std::int32_t> stay, std::size_t more);
  void put_in(std::size_t at, const Arrival<D>& arrival);
  std::int64_t name_at(std::size_t place) const {
    return ids_.empty() ? static_cast<std::int64_t>(id_at(place)) : ids_[id_at(place)];
  }
  void find_impacts();
  void remember_touching();
  Contact told(const Contacts<D>& contacts, std::size_t c) const;
  template <class Each>
  void for_contacts(const Each& each) const;
  Impact impact(std::size_t i, std::size_t j) const;
  /// As others know it: grains as they are, walls beyond all grains.
  std::int64_t bead_id(std::int64_t bead) const {
    const auto k = static_cast<std::size_t>(bead);
    return k < grains_.size() ? bead : wall_id(k - grains_.size());
  }
  void check_floor() const;
  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self);
  template <class Archive, class Self>
  static void transfer_who_is_there(Archive& archive, Self& self);
};

}  // namespace chute::soft
