#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.hpp"

/// Runs that grow: what a scene may have otherwise than the run that it goes on with. These are `run.duration`, `title` and
/// everything in [output]; the run's step stays.
namespace chute::run {

/// What may change, for messages.
inline constexpr const char* may_change = "run.duration, title and [output]";

/// A scene that goes on with the run in `directory`, if there is one with a checkpoint: what it leaves open, and what
/// would follow from the duration, is as the run has it (the time between rows of the series). InputError as parse_scene.
scene::Scene parse_to_go_on(std::string_view text, const std::string& name, std::vector<std::string> settings,
                            const std::filesystem::path& directory);

/// `wanted` such that it goes on with the run of the complete scene `before`: with that run's step. InputError, which begins
/// with `where`, if it changes what may not change, or asks for an interval that is no whole number of steps.
scene::Scene grown(const scene::Scene& wanted, const std::string& before, const std::string& where);

/// The first key in which two complete scenes differ that may not change, with both values, or nothing.
std::optional<std::string> difference_that_matters(const std::string& before, const std::string& now);
/// The same, where others may change.
std::optional<std::string> difference_that_matters(
    const std::string& before, const std::string& now,
    const std::function<bool(const std::string& key)>& may_differ);

}  // namespace chute::run
