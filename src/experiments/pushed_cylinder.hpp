#pragma once
#include <vector>

#include "laws/list.hpp"

namespace chute::experiments {

/// A cylinder on a plane, pushed along it by a block, thesis 3.2: m = g = r = 1, I = 1/2. The block has no
/// mass and stays upright, so that its normal force is the pushing force, exactly (and its overlap, for
/// tangential laws that ask, that of this force at rest); the cylinder's weight and the friction at the block
/// rest on the plane's normal law. The block's friction presses the cylinder down
/// while its side moves up.
struct PushedCylinder {
  laws::Normal normal = laws::SpringDashpot::from_restitution(2e7, 0.2);  ///< one without a memory
  laws::Shear block, plane;  ///< tangential laws, with μ_b and μ_p
  double time_step = 1e-6;
};

/// For how long the block pushes how strongly.
struct Push {
  double force, duration;
};

struct CylinderState {
  double time;
  double plane_force, block_force;  ///< F_s^p, F_s^b, positive as in (3.26), (3.27)
  double acceleration, spin_up;     ///< dv/dt along the plane; dω/dt, positive as the cylinder rolls forward
  double velocity, spin;
};

/// The motion from rest, on the loaded plane, under one push after the other, every `every` steps. Integrated
/// with the classical Runge-Kutta method; memories of the laws are carried through the stages of a step and
/// settled at its end. std::invalid_argument if the normal law has a memory.
std::vector<CylinderState> push(const PushedCylinder& set_up, const std::vector<Push>& pushes, int every);

/// The steady state, (3.26) to (3.31), where only one of the contacts slips. NaN in between, F_p¹ < F_p <
/// F_p².
struct SteadyCylinder {
  double plane_force, block_force, acceleration, spin_up;
};
SteadyCylinder steady_cylinder(double push, double block_friction, double plane_friction);

/// Mean and half of the range of one quantity between two times. The mean is weighted with a bell, 1 − cos,
/// so that a ringing leaves nothing of the period that the interval cuts off.
struct Steady {
  double mean, swing;
};
Steady steady(const std::vector<CylinderState>& states, double from, double to,
              double CylinderState::*quantity);

}  // namespace chute::experiments
