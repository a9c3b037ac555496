#include "engines/automaton/automaton_method.hpp"
#include "engines/contact/contact_method.hpp"
#include "engines/dsmc/dsmc_method.hpp"
#include "engines/event/event_method.hpp"
#include "engines/hybrid/hybrid_method.hpp"
#include "engines/lammps/lammps_method.hpp"
#include "engines/monte_carlo/monte_carlo_method.hpp"
#include "engines/restructuring/restructuring_method.hpp"
#include "engines/soft/soft_method.hpp"
#include "engines/stochastic/stochastic_method.hpp"

namespace chute::engines {

Catalogue<Method>& list() {
  static Catalogue<Method> all{
      kind_of<Method, soft::SoftMethod>(),
      kind_of<Method, event::EventMethod>(),
      kind_of<Method, hybrid::HybridMethod>(),
      kind_of<Method, contact::ContactMethod>(),
      kind_of<Method, stochastic::StochasticMethod>(),
      kind_of<Method, restructuring::RestructuringMethod>(),
      kind_of<Method, monte_carlo::MonteCarloMethod>(),
      kind_of<Method, automaton::AutomatonMethod>(),
      kind_of<Method, dsmc::DsmcMethod>(),
      kind_of<Method, lammps::LammpsMethod>(),
  };
  return all;
}

}  // namespace chute::engines
