#pragma once
#include "core/domain.hpp"
#include "core/grains.hpp"
#include "scene/scene.hpp"

namespace chute::scene {

struct Start2D {
  Grains<2> grains;
  Domain<2> domain;
};

/// Why the grains of a scene cannot start, and which key to change.
struct Misfit {
  std::string key, message;
};
std::optional<Misfit> misfit(const Scene& scene);

/// Grains and bed as the scene starts them: moving grains first, then the bed. The same scene and seed give
/// the same grains. InputError if the grains do not fit.
Start2D make_start(const Scene& scene);

}  // namespace chute::scene
