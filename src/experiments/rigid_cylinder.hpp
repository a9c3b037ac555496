#pragma once
#include <vector>

#include "experiments/pushed_cylinder.hpp"

namespace chute::experiments {

/// The pushed cylinder of thesis 3.2 by contact dynamics (2.2): rigid, its two contacts obey Coulomb's relation in place of
/// a force law. As with PushedCylinder m = g = r = 1, I = 1/2, and the block has no mass and stays upright, so that it
/// passes on the pushing force, exactly.
struct RigidCylinder {
  double block_friction = 0.5, plane_friction = 0.25;  ///< μ_b, μ_p ≥ 0
  double time_step = 1e-4;
  bool exact = false;  ///< solved by the thesis's iteration over states in place of Gauss-Seidel
};

/// The motion from rest under one push after the other: a state each step, forces and accelerations being its means, at
/// its end. WorkError if a step does not converge.
std::vector<CylinderState> push(const RigidCylinder& set_up, const std::vector<Push>& pushes);

}  // namespace chute::experiments
