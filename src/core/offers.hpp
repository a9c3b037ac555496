#pragma once
#include <string_view>

namespace chute {

/// What a method gives to whoever watches it.
struct Offers {
  bool in_2d = true, in_3d = true;
  bool contacts = false;     ///< what touches, with forces
  bool collisions = false;   ///< what passes between hard grains, collision by collision
  bool impacts = false;      ///< the begin of each contact
  bool independent = false;  ///< grains side by side that do not feel each other
  bool walls = false;
  bool threads = false;
  std::string_view clock = "time";  ///< what a step counts
};

}  // namespace chute
