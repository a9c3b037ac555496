#include "replay/replay_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "core/sphere.hpp"
#include "core/world.hpp"
#include "replay/touching.hpp"

namespace chute::replay {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The numbers of a file's grains in the order in which they are played.
std::vector<std::size_t> order_of(const Snapshot& frame) {
  std::vector<std::size_t> order(frame.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    return std::pair(frame.fixed.empty() ? 0 : static_cast<int>(frame.fixed[i]),
                     frame.id.empty() ? static_cast<std::int64_t>(i) : frame.id[i]);
  };
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
  return order;
}

template <int D>
class Replay final : public ReplayEngine {
 public:
  explicit Replay(double gap) : gap_(gap) {}

  void show(const Snapshot& frame, std::int64_t step, double time) override {
    assert(frame.dimensions == D);
    const auto before = std::exchange(grains_, {});
    const auto ids_before = std::exchange(ids_, {});
    step_ = step, time_ = time;
    domain_ = {};
    for (int k = 0; k < D; ++k) {
      const double low = frame.domain[static_cast<std::size_t>(2 * k)],
                   high = frame.domain[static_cast<std::size_t>(2 * k + 1)];
      if (high > low) domain_.lower[k] = low, domain_.length[k] = high - low;
    }
    for (int k = 0; k < D; ++k) gravity_[k] = frame.gravity[static_cast<std::size_t>(k)];
    for (auto& column : force_) column.clear();
    place_of_.clear();
    const auto order = order_of(frame);
    grains_.reserve(order.size());
    for (const std::size_t i : order) add(frame, i);
    wrap_into(domain_, grains_);
    count_on(before, ids_before);
    take_contacts(frame);
    if (start_.empty() || start_[0].size() != grains_.moving) {
      start_ = unwrapped_places_now();
      shown_from_start_ = shown_ == 0;
    }
    ++shown_;
  }
  bool knows_forces() const override { return forces_; }

  std::int64_t step() const override { return step_; }
  /// Such that the time of the step is that of the frame.
  double time_step() const override { return step_ == 0 ? 1 : time_ / static_cast<double>(step_); }
  GrainsView grains() const override { return view_of<D>(grains_, force_, domain_, time_); }
  std::vector<Contact> contacts() const override { return contacts_; }
  EnergyAccount energy() const override {
    EnergyAccount account;
    account.elastic = account.normal_loss = account.shear_loss = account.start = unknown;
    account.add_motion<D>(grains(), gravity_, start_);
    if (!shown_from_start_ || norm(gravity_) == 0) account.gravity_work = unknown;
    return account;
  }
  void save(std::ostream&) const override { throw WorkError("frames that are played back have no state"); }
  void restore(std::istream&) override { throw WorkError("frames that are played back have no state"); }

 private:
  double gap_;
  std::int64_t step_ = 0;
  double time_ = 0;
  Grains<D> grains_;
  Domain<D> domain_;
  Vec<D> gravity_{};
  std::array<Array, D> force_;
  std::vector<std::int64_t> ids_;
  std::map<std::int64_t, std::int64_t> place_of_;  // of an id among the grains
  std::vector<Contact> contacts_;
  bool forces_ = false, shown_from_start_ = false;
  std::int64_t shown_ = 0;
  std::vector<Array> start_;

  void advance(std::int64_t) override { throw WorkError("frames that are played back do not go on"); }

  template <int N, std::size_t M, class Columns>
  void set(Columns& columns, const std::vector<std::array<double, M>>& values, std::size_t i,
           std::size_t shift, double otherwise) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(N); ++k)
      columns[k].back() = values.empty() ? otherwise : values[i][k + shift];
  }

  void add(const Snapshot& frame, std::size_t i) {
    const bool moves = frame.fixed.empty() || !frame.fixed[i];
    const double mass = frame.mass.empty() ? unknown : frame.mass[i];
    Vec<D> place;
    for (int k = 0; k < D; ++k) place[k] = frame.place[i][static_cast<std::size_t>(k)];
    grains_.add(place, frame.radius[i], mass, sphere_inertia(mass, frame.radius[i]), moves);
    set<D>(grains_.velocity, frame.velocity, i, 0, unknown);
    set<turns<D>>(grains_.spin, frame.spin, i, D == 2 ? 2 : 0, unknown);
    if (!frame.orientation.empty())
      set<orientation_numbers<D>>(grains_.orientation, frame.orientation, i, 0, 0);
    if (!frame.material.empty()) grains_.material.back() = frame.material[i];
    for (std::size_t k = 0; k < static_cast<std::size_t>(D); ++k)
      force_[k].push_back(frame.force.empty() ? unknown : frame.force[i][k]);
    const std::int64_t id = frame.id.empty() ? static_cast<std::int64_t>(i) : frame.id[i];
    if (!place_of_.emplace(id, std::ssize(ids_)).second)
      throw InputError(fmt::format("{}: two grains have the id {}", frame.name, id));
    ids_.push_back(id);
  }

  /// How often each grain went around the periods, by the shortest way from the frame before: the true one if none goes
  /// half a period from frame to frame.
  void count_on(const Grains<D>& before, const std::vector<std::int64_t>& ids_before) {
    if (ids_before != ids_ || before.moving != grains_.moving) return;
    for (std::size_t k = 0; k < static_cast<std::size_t>(D); ++k) {
      const int axis = static_cast<int>(k);
      if (!domain_.periodic(axis)) continue;
      for (std::size_t i = 0; i < grains_.moving; ++i) {
        const double way = grains_.position[k][i] - before.position[k][i];
        grains_.wraps[k][i] = before.wraps[k][i] - static_cast<int>(std::lround(way / domain_.length[axis]));
      }
    }
  }

  void take_contacts(const Snapshot& frame) {
    forces_ = frame.contacts.has_value();
    if (!frame.contacts) {
      contacts_ = touching<D>(grains_, domain_, gap_);
      return;
    }
    contacts_ = *frame.contacts;
    for (auto& contact : contacts_)
      for (auto* id : {&contact.a, &contact.b}) {
        if (is_wall(*id)) continue;
        const auto at = place_of_.find(*id);
        if (at == place_of_.end())
          throw InputError(
              fmt::format("{}: its contacts name grain {}, which is not there", frame.name, *id));
        *id = at->second;
      }
    forces_ = std::ranges::all_of(contacts_, [](const Contact& c) { return std::isfinite(c.normal_force); });
  }

  std::vector<Array> unwrapped_places_now() const {
    const auto places = unwrapped_places<D>(grains());
    return {places.begin(), places.end()};
  }
};

}  // namespace

std::unique_ptr<ReplayEngine> ReplayEngine::make(int dimensions, double gap) {
  if (dimensions == 2) return std::make_unique<Replay<2>>(gap);
  return std::make_unique<Replay<3>>(gap);
}

}  // namespace chute::replay
