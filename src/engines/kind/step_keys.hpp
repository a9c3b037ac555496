#pragma once
#include <optional>
#include <string_view>

#include "engines/kind/method.hpp"

namespace chute::engines {

/// Whether this archive reads a scene; others write one, or list its keys.
template <class Archive>
concept ReadsKeys = requires(Archive& a) {
  a.has(std::string_view{});
};

/// How long a step of soft grains is: in parts of a contact, or as it is. One of them: where a setting adds the second it counts.
template <class Archive>
void describe_step(Archive& a, double& steps_per_contact, std::optional<double>& time_step) {
  // A scene that is written as it was understood must be one that can be read.
  if (ReadsKeys<Archive> || !time_step)
    a.value("steps_per_contact", steps_per_contact, at_least(5),
            "time steps in the shortest contact time t_n");
  a.value("time_step", time_step, positive, "instead of steps_per_contact");
}

}  // namespace chute::engines
