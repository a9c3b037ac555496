#pragma once
#include <memory>

#include "core/engine.hpp"
#include "core/world.hpp"
#include "engines/automaton/model.hpp"

namespace chute::automaton {

/// Cellular automata, thesis 2.3, as an engine: a step is an update of the lattice and no time, and each occupied site is seen
/// as a grain of diameter 1, whose number may change. Ids only number the sites that are occupied now.
class AutomatonEngine final : public Engine {
 public:
  AutomatonEngine(std::unique_ptr<Model> model, const Surroundings<2>& surroundings);

  std::int64_t step() const override { return step_; }
  double time_step() const override { return 1; }
  GrainsView grains() const override;
  EnergyAccount energy() const override;
  std::vector<Contact> contacts() const override { return {}; }
  void collect_avalanches(bool on) override { collecting_ = on; }
  std::vector<Avalanche> take_avalanches() override { return std::exchange(avalanches_, {}); }
  std::vector<std::pair<std::string, double>> tells() const override { return model_->tells(); }
  void save(std::ostream& out) const override;
  void restore(std::istream& in) override;

 private:
  void advance(std::int64_t step) override;

  std::unique_ptr<Model> model_;
  Surroundings<2> surroundings_;
  std::int64_t step_ = 0;
  double start_ = 0;
  bool collecting_ = false;
  std::vector<Avalanche> avalanches_;
  mutable std::int64_t shown_ = -1;  // the update that grains_ are of
  mutable Grains<2> grains_;
  std::array<Array, 2> no_force_;
};

}  // namespace chute::automaton
