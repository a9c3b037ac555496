#include "scene/scene.hpp"

#include <stdexcept>

#include "common/toml_reader.hpp"
#include "targets.hpp"

namespace {

/// Thousands of beads take seconds to be arranged on a plane, which is no fault: a plane of few has the same code.
std::vector<std::string> with_small_planes(std::string_view bytes) {
  constexpr std::int64_t usual = 4085, few = 100;
  const auto table = chute::parse_toml(bytes, "scene.toml");
  const auto bed = table["bed"];
  const bool many =
      bed["kind"].value_or(std::string()).starts_with("plane") && bed["count"].value_or(usual) > few;
  return many ? std::vector<std::string>{"bed.count=" + std::to_string(few)} : std::vector<std::string>{};
}

}  // namespace

/// A scene that is taken says of itself what reads as the same scene: resumes and caches rest on that.
void chute::fuzz::scene(std::string_view bytes) {
  const auto scene = scene::parse_scene(bytes, "scene.toml", with_small_planes(bytes));
  const auto whole = scene::to_toml(scene);
  if (scene::to_toml(scene::parse_scene(whole, "whole.toml")) != whole)
    throw std::logic_error("a scene is not what it says of itself:\n" + whole);
}
