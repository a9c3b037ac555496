#pragma once
#include "common/error.hpp"

namespace chute {

/// The state in a checkpoint is not one of this scene's: what the user is told.
[[noreturn]] inline void wrong_state() {
  throw InputError("the checkpoint's state does not fit its scene: damaged, or made by something else");
}

}  // namespace chute
