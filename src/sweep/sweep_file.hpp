#pragma once
#include <string>

#include "sweep/grid.hpp"

namespace chute::sweep {

/// Does the scene file hold a [sweep]? InputError if it cannot be read.
bool is_sweep(const Base& base);

/// [sweep] of a scene file. InputError `FILE:LINE: …` if there is none, or something is wrong in it.
SweepSpec read_sweep(const Base& base);

/// The complete sweep as TOML: its scene with every default filled in, and [sweep].
std::string to_toml(const Base& base, SweepSpec spec);

}  // namespace chute::sweep
