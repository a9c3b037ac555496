#include "scene/scene.hpp"

#include <stdexcept>

#include "targets.hpp"

/// A scene that is taken says of itself what reads as the same scene: resumes and caches rest on that.
void chute::fuzz::scene(std::string_view bytes) {
  const auto scene = scene::parse_scene(bytes, "scene.toml");
  const auto whole = scene::to_toml(scene);
  if (scene::to_toml(scene::parse_scene(whole, "whole.toml")) != whole)
    throw std::logic_error("a scene is not what it says of itself:\n" + whole);
}
