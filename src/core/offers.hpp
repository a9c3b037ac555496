#pragma once
#include <string_view>

namespace chute {

/// What a method gives to whoever watches it.
struct Offers {
  bool in_2d = true, in_3d = true;
  bool by_contact = true;  ///< grains act on each other as [contact] says; else all they do is not to overlap
  bool contacts = false;   ///< what touches, with forces
  bool forces = false;     ///< of these act all the time, as between soft grains, and not as blows
  bool collisions = false;   ///< what passes between hard grains, collision by collision
  bool impacts = false;      ///< the begin of each contact
  bool independent = false;  ///< grains side by side that do not feel each other
  bool clumps = false;       ///< grains that are not round
  bool walls = false;        ///< planes that stand still
  bool only_floor = false;   ///< of these only level ones, below the grains
  bool drum = false;         ///< besides, in the plane, a circle around all grains, alone, with its friction
  bool wall_shapes = false;  ///< segments, polygons and cylinders
  bool wall_motion = false;  ///< walls that move
  bool wall_surfaces = false;      ///< friction and restitution of a wall's own
  bool wall_sticking = false;      ///< tangential restitution of a wall's own
  bool wall_temperatures = false;  ///< walls that heat
  bool static_friction = false;    ///< a friction at rest that is not that of sliding
  bool materials = false;          ///< species with contact laws by pair
  bool tilting = false;            ///< an incline that is tilted meanwhile
  bool open = false;               ///< grains that come in and leave meanwhile
  bool avalanches = false;         ///< what follows when a grain is added
  bool threads = false;
  std::string_view clock = "time";  ///< what a step counts
};

}  // namespace chute
