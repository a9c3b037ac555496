#include "scene/scene.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "common/toml_reader.hpp"
#include "targets.hpp"

namespace {

/// Thousands of beads take seconds to be arranged on a plane, which is no fault: a plane of few, as dense as the thesis's, has the
/// same code.
std::vector<std::string> with_small_planes(std::string_view bytes) {
  constexpr std::int64_t usual = 4085, few = 100;
  constexpr double side = 11;  // in diameters of a bead
  const auto table = chute::parse_toml(bytes, "scene.toml");
  const auto bed = table["bed"];
  const bool many =
      bed["kind"].value_or(std::string()).starts_with("plane") && bed["count"].value_or(usual) > few;
  if (!many) return {};
  const double d = bed["diameter"].value_or(1.0);
  return {"bed.count=" + std::to_string(few), fmt::format("bed.size=[{0:e},{0:e}]", side * d)};
}

}  // namespace

/// A scene that is taken says of itself what reads as the same scene: resumes and caches rest on that.
void chute::fuzz::scene(std::string_view bytes) {
  const auto scene = scene::parse_scene(bytes, "scene.toml", with_small_planes(bytes));
  const auto whole = scene::to_toml(scene);
  if (scene::to_toml(scene::parse_scene(whole, "whole.toml")) != whole)
    throw std::logic_error("a scene is not what it says of itself:\n" + whole);
}
