#include "engines/automaton/automaton_engine.hpp"

#include <ostream>

namespace chute::automaton {

AutomatonEngine::AutomatonEngine(std::unique_ptr<Model> model, const Surroundings<2>& surroundings)
    : model_(std::move(model)), surroundings_(surroundings), start_(model_->energy().translation) {}

void AutomatonEngine::advance(std::int64_t step) {
  for (; step_ < step; ++step_) {
    model_->update(step_);
    const auto avalanches = model_->take_avalanches();
    if (collecting_) avalanches_.insert(avalanches_.end(), avalanches.begin(), avalanches.end());
  }
}

GrainsView AutomatonEngine::grains() const {
  if (shown_ != step_) {
    grains_ = {};
    model_->show(grains_);
    shown_ = step_;
  }
  return view_of(grains_, no_force_, surroundings_.domain, time());
}

EnergyAccount AutomatonEngine::energy() const {
  const auto now = model_->energy();
  EnergyAccount e;
  e.start = start_;
  e.translation = now.translation;
  e.normal_loss = now.lost;
  e.gravity_work = now.translation - start_ + now.lost;  // only gravity gives
  return e;
}

void AutomatonEngine::save(std::ostream& out) const {
  StateOutput archive(out);
  archive(step_, start_);
  model_->save(archive);
}

void AutomatonEngine::restore(std::istream& in) {
  StateInput archive(in);
  archive(step_, start_);
  model_->load(archive);
  shown_ = -1;
}

}  // namespace chute::automaton
