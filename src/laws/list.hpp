#pragma once
#include <variant>

#include "laws/regularised_coulomb.hpp"
#include "laws/spring_dashpot.hpp"

/// Every law that a scene can name. The engine chooses once per step and runs a loop with the law inlined.
/// To add a law: one header beside this, one word here, and its keys in scene/contact.cpp.
namespace chute::laws {

using Normal = std::variant<SpringDashpot>;
using Shear = std::variant<Frictionless, RegularisedCoulomb>;

struct Contact {
  Normal normal;
  Shear shear;
};

}  // namespace chute::laws
