#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "measure/steadiness.hpp"

namespace chute::run {

/// `"flow"` of run.json: verdict, from, v_x, v_x_err, omega, omega_err, kinetic, kinetic_err; null where
/// unknown.
nlohmann::ordered_json to_json(const measure::Flow& flow);
/// The other way. nlohmann::json::exception if it is not of that form.
measure::Flow flow_from(const nlohmann::json& json);

/// The flow that the run.json of a run directory tells of. InputError if there is none, or no run.
measure::Flow read_flow(const std::filesystem::path& directory);

}  // namespace chute::run
