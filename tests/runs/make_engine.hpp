#pragma once
#include <memory>

#include "run/session.hpp"

namespace chute::test {

/// The engine of a scene, as a run makes it, for tests that drive it themselves.
struct Made {
  std::unique_ptr<run::Session> session;
  Engine* engine;
};
inline Made make_engine(const scene::Scene& scene, int threads = 1) {
  Made made{std::make_unique<run::Session>(scene, threads), nullptr};
  made.engine = &made.session->engine();
  return made;
}

}  // namespace chute::test
