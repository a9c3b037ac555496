#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "common/state_archive.hpp"
#include "core/avalanche.hpp"
#include "core/grains.hpp"

namespace chute::automaton {

/// One of the lattice models behind the engine.
class Model {
 public:
  virtual ~Model() = default;
  /// The next update; `update` counts from 0.
  virtual void update(std::int64_t update) = 0;
  /// Fills `grains` with what is on the lattice now: a grain of diameter 1 on each occupied site.
  virtual void show(Grains<2>& grains) const = 0;
  /// Names and values of the series.
  virtual std::vector<std::pair<std::string, double>> tells() const = 0;
  /// Energy of motion now, and what collisions took so far; 0 where sites have no velocities.
  struct Energy {
    double translation = 0, lost = 0;
  };
  virtual Energy energy() const { return {}; }
  virtual std::vector<Avalanche> take_avalanches() { return {}; }
  virtual void save(StateOutput& archive) = 0;
  virtual void load(StateInput& archive) = 0;
};

/// Gives a model save and load out of its serialize(archive).
template <class Self>
class SavedModel : public Model {
 public:
  void save(StateOutput& archive) override { static_cast<Self&>(*this).serialize(archive); }
  void load(StateInput& archive) override { static_cast<Self&>(*this).serialize(archive); }
};

}  // namespace chute::automaton
