#pragma once
#include <map>

#include "experiments/experiment.hpp"
#include "run/run.hpp"

namespace chute::experiments {

/// What an experiment gave.
struct Outcome {
  std::vector<Fact> results;
  std::map<std::string, double>
      errors;  ///< of results that are means of a motion that goes on: half of its range
  std::int64_t steps = 0;
  double time = 0;
  // only if recorded:
  std::vector<std::string> columns;
  std::vector<std::vector<double>> series;

  /// InputError, with the nearest name, if there is no such result.
  double operator[](const std::string& name) const;
};

/// Where an experiment is recorded, if it is.
using Recording = std::shared_ptr<io::RunFiles>;

/// Does the experiment. WorkError if grains do not part. With files the series is kept, and frames, if asked for, are
/// written there.
Outcome perform(const Experiment& experiment, const Recording& record = {});

/// Does it and writes a run directory: scene.toml, run.json, series.csv, result.csv, and frames if asked for.
Outcome run_experiment(const Experiment& experiment, const run::RunOptions& options);

}  // namespace chute::experiments
