#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/wrong_state.hpp"
#include "core/impact.hpp"

namespace chute::hard {

/// The contact of two grains as hard spheres know it: a train of collisions that follow each other closely.
struct Meeting {
  std::int32_t other = 0;           ///< the grain with the higher id; from the number of grains on, a wall
  double first = 0;                 ///< when the train began
  double last = 0;                  ///< its last collision
  std::array<double, 3> impulse{};  ///< on `other` since `first`, without the collision that began it
  bool lasting() const { return last > first; }

  template <class Archive>
  void serialize(Archive& a) {
    a(other, first, last, impulse);
  }
};

/// Who met whom lately: what is needed to tell a lasting contact from a bounce. A collision continues a train
/// if it comes less than 4 t_c (`rolling_ends`) after the one before; those that come within t_c are elastic.
/// The two differ because the bounces of a train grow where the force that presses the grains together fades,
/// and then lose energy again: a ball that rolls over a bead must not seem to hit it anew each time.
class Meetings {
 public:
  Meetings() = default;
  Meetings(std::size_t grains, double contact_time) : of_(grains), contact_time_(contact_time) {}

  double contact_time() const { return contact_time_; }

  bool runs(const Meeting& m, double t) const { return t - m.last < rolling_ends * contact_time_; }

  /// The train that a collision of i < j at time t continues; nothing if it begins one.
  const Meeting* running(std::size_t i, std::size_t j, double t) const {
    if (contact_time_ <= 0) return nullptr;
    for (const auto& m : of_[i])
      if (static_cast<std::size_t>(m.other) == j && runs(m, t)) return &m;
    return nullptr;
  }

  void note(std::size_t i, std::size_t j, double t, const std::array<double, 3>& impulse) {
    if (contact_time_ <= 0) return;
    std::erase_if(of_[i], [&](const Meeting& m) { return !runs(m, t); });
    for (auto& m : of_[i]) {
      if (static_cast<std::size_t>(m.other) != j) continue;
      m.last = t;
      for (std::size_t k = 0; k < 3; ++k) m.impulse[k] += impulse[k];
      return;
    }
    of_[i].push_back({static_cast<std::int32_t>(j), t, t, {}});
  }

  const std::vector<Meeting>& of(std::size_t i) const { return of_[i]; }

  template <class Archive>
  void serialize(Archive& a) {
    const auto grains = of_.size();
    a(of_);
    if (of_.size() != grains) wrong_state();
  }

 private:
  std::vector<std::vector<Meeting>> of_;
  double contact_time_ = 0;
};

}  // namespace chute::hard
