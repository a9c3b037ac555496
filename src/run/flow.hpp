#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>

#include "core/grains.hpp"
#include "measure/series.hpp"
#include "measure/steadiness.hpp"
#include "scene/scene.hpp"

namespace chute::run {

/// What became of the flow of a run, from its series. Lengths are measured by the mean distance of the bed's
/// grains (of a mean grain's diameter, where there is no bed); `kinetic` is the kinetic energy of all grains,
/// as the series has it.
measure::Flow judge_run(std::span<const measure::SeriesRow> series, const scene::Scene& scene,
                        const GrainsView& grains);

/// `"flow"` of run.json: verdict, from, v_x, v_x_err, omega, omega_err, kinetic, kinetic_err; null where
/// unknown.
nlohmann::ordered_json to_json(const measure::Flow& flow);

/// The flow that the run.json of a run directory tells of. InputError if there is none, or no run.
measure::Flow read_flow(const std::filesystem::path& directory);

}  // namespace chute::run
