#pragma once
#include <memory>

#include "core/domain.hpp"
#include "core/engine.hpp"
#include "scene/scene.hpp"

namespace chute::run {

struct Made {
  std::unique_ptr<Engine> engine;
  Domain<2> domain;
};

/// The engine that a scene asks for, with its grains at the start. InputError if the grains do not fit. Only
/// the soft engine has threads, and no more than pay: one for every `grains_per_thread`. Results do not
/// depend on them.
inline constexpr std::int64_t grains_per_thread = 2000;
Made make_engine(const scene::Scene& scene, int threads = 1);

/// The time step of a scene: as given, or at most the asked part of the contact time, and such that outputs
/// are a whole number of steps apart.
double time_step(const scene::Scene& scene);

}  // namespace chute::run
