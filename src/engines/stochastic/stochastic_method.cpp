#include "engines/stochastic/stochastic_method.hpp"

#include "common/error.hpp"
#include "engines/stochastic/stochastic_engine.hpp"

namespace chute::stochastic {

Offers StochasticMethod::offers() const { return {.in_3d = false, .impacts = true}; }

std::optional<Refusal> StochasticMethod::refusal(const engines::Setting& s) const {
  if (s.grains != 1 || s.bead_spacing == 0)
    return Refusal{"engine", "method = \"stochastic\" moves a single ball along a bed"};
  if (!(s.launch_velocity > 0))
    return Refusal{"grains", "the stochastic ball must start downhill: velocity > 0"};
  return {};
}

std::unique_ptr<Engine> StochasticMethod::make(World<2> world, const engines::Setting& s, int) const {
  const auto tangential = walton(s);
  theory::StochasticModel model;
  model.ball_radius = s.mean_diameter / 2;
  model.bead_radius = s.bead_diameter / 2;
  model.gap = s.bead_spacing / s.bead_diameter - 1;  // the mean one (4.52)
  model.theta = s.theta;
  model.gravity = s.gravity;
  model.restitution = e_n(s);
  model.friction = tangential.friction;
  model.beta = tangential.beta;
  model.law = impact_friction;
  model.shadowed = shadowed;
  return std::make_unique<StochasticEngine>(std::move(world), model, s.seed, step(s));
}
std::unique_ptr<Engine> StochasticMethod::make(World<3>, const engines::Setting&, int) const {
  throw InputError("engine.method: \"stochastic\" knows no third dimension");
}

}  // namespace chute::stochastic
