#pragma once
#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/vector.hpp>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/engine.hpp"
#include "io/csv.hpp"
#include "io/vtk_files.hpp"
#include "measure/blocks.hpp"
#include "measure/steadiness.hpp"
#include "run/run_directory.hpp"
#include "run/schedule.hpp"
#include "scene/scene.hpp"

namespace chute::run {

/// What observers know of their run.
struct RunContext {
  const scene::Scene& scene;
  const RunDirectory& directory;
  io::RunFacts facts;
  double time_step;
  double length;  ///< of the line

  Schedule schedule(double from, double every) const { return {from, every, time_step}; }
  /// The time in which averages are taken; from = nothing stands for "steady": the whole run, in blocks fine
  /// enough to choose from when on they count.
  measure::Window window(std::optional<double> from) const {
    return {from.value_or(0), scene.duration, from ? 10u : 64u};
  }
  /// Comment lines of a table: what it holds, and from which run.
  std::vector<std::string> comments(std::string what) const;
};

/// One instant of a run, as observers see it.
struct Look {
  const Engine& engine;
  std::span<const Impact> impacts;  ///< since the look before
};

/// Watches a run: says when it wants to look, remembers what it saw (in checkpoints, too), and writes its
/// files.
class Observer {
 public:
  virtual ~Observer() = default;
  /// The first step after `step` at which it must look.
  virtual std::int64_t next_after(std::int64_t step) const = 0;
  /// Called whenever the engine stops for somebody.
  virtual void look(const Look& look) = 0;
  /// Does it want impacts to be collected from this step on?
  virtual bool wants_impacts(std::int64_t) const { return false; }
  /// Writes its files as of now. Averages from "steady" on count from `flow.from`.
  virtual void write(const measure::Flow& flow) const = 0;
  virtual void save(cereal::PortableBinaryOutputArchive& archive) = 0;
  virtual void load(cereal::PortableBinaryInputArchive& archive) = 0;
};

/// Gives an observer save and load out of its serialize(archive).
template <class Self>
class Remembering : public Observer {
 public:
  void save(cereal::PortableBinaryOutputArchive& archive) override {
    static_cast<Self&>(*this).serialize(archive);
  }
  void load(cereal::PortableBinaryInputArchive& archive) override {
    static_cast<Self&>(*this).serialize(archive);
  }
};

/// The columns of a table with one line per Row.
template <class Row>
class Columns {
 public:
  using Cell = io::Csv::Cell;
  Columns& add(const char* name, std::function<Cell(const Row&)> value) {
    names_.emplace_back(name);
    values_.push_back(std::move(value));
    return *this;
  }
  Columns& add(const char* name, double Row::*member) {
    return add(name, [member](const Row& row) { return row.*member; });
  }
  /// A mean and its error: the columns `name` and `name_err`.
  Columns& add(const std::string& name, measure::Estimate Row::*member) {
    add(name.c_str(), [member](const Row& row) { return (row.*member).mean; });
    return add((name + "_err").c_str(), [member](const Row& row) { return (row.*member).error; });
  }
  std::string csv(const std::vector<std::string>& comments, const std::vector<Row>& rows) const {
    io::Csv csv(comments, {names_.begin(), names_.end()});
    std::vector<Cell> cells;
    for (const auto& row : rows) {
      cells.clear();
      for (const auto& value : values_) cells.push_back(value(row));
      csv.row({}, cells);
    }
    return csv.text();
  }

 private:
  std::vector<std::string> names_;
  std::vector<std::function<Cell(const Row&)>> values_;
};

/// The observers that a scene asks for; nothing where it does not ask.
std::unique_ptr<Observer> observe_frames(const RunContext& run);
std::vector<std::unique_ptr<Observer>> observe_profiles(const RunContext& run);
std::unique_ptr<Observer> observe_fields(const RunContext& run);
std::unique_ptr<Observer> observe_impacts(const RunContext& run);
std::unique_ptr<Observer> observe_impact_histograms(const RunContext& run);

}  // namespace chute::run
