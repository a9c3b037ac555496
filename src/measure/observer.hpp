#pragma once
#include <cereal/types/array.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/keys.hpp"
#include "common/state_archive.hpp"
#include "core/engine.hpp"
#include "core/frame.hpp"
#include "core/offers.hpp"
#include "io/csv.hpp"
#include "io/run_files.hpp"
#include "io/vtk_files.hpp"
#include "measure/blocks.hpp"
#include "measure/layer_sums.hpp"
#include "measure/schedule.hpp"
#include "measure/steadiness.hpp"

/// Observers: what watches a run, and what it leaves. One file an observer, and a line in list.cpp.
namespace chute::measure {

/// What observers know of their run.
struct RunContext {
  std::string title, made_by;  ///< the scene's title; seed, program and units, for comments
  io::RunFacts facts;
  Frame frame;
  Offers offers;
  double gravity = 0;
  double diameter = 1;                   ///< of a mean grain
  std::optional<Tilt> tilt{};            ///< of an incline that is tilted meanwhile
  std::vector<std::string> materials{};  ///< their names, by number
  bool independent = false;              ///< grains do not feel each other: each is a run of its own
  bool open = false;                     ///< grains come in and leave
  double time_step = 0, duration = 0;
  double contact_time = 0;                ///< t_n of the contact that the scene is about
  std::shared_ptr<io::RunFiles> files{};  ///< where they are written; without them nothing is

  Schedule schedule(double from, double every) const { return {from, every, time_step}; }
  /// The time in which averages are taken; from = nothing stands for "steady": the whole run, in blocks fine
  /// enough to choose from when on they count.
  Window window(std::optional<double> from) const { return {from.value_or(0), duration, from ? 10u : 64u}; }
  /// Comment lines of a table: what it holds, and from which run.
  std::vector<std::string> comments(std::string what) const;
  /// Gravity in the coordinates of files, as it is by then where an incline is tilted meanwhile.
  std::array<double, 3> gravity_at(double time) const;
  /// "t = 5"; "sweeps = 5" where the engine counts those.
  std::string moment(double time) const;
  /// From when on averages with from = "steady" count, and whether that was a steady state: for the comments of a table.
  /// Nothing where the scene names the time.
  std::vector<std::string> average_note(const std::optional<double>& from, const Flow& flow) const;
  /// A table, which is written again and again, as of now.
  void write(const std::string& name, const std::string& bytes) const;
  /// A frame, which never changes.
  void write_once(const std::string& name, const std::string& bytes) const;
};

/// One instant of a run, as observers see it.
struct Look {
  const Engine& engine;
  std::span<const Impact> impacts;          ///< since the look before
  std::span<const Collision> collisions;    ///< of hard grains, since the look before
  std::span<const Parting> partings{};      ///< collected with impacts, since the look before
  std::span<const Avalanche> avalanches{};  ///< of piles, since the look before
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
  /// Does it want impacts, or collisions, to be collected from this step on?
  virtual bool wants_impacts(std::int64_t) const { return false; }
  virtual bool wants_collisions(std::int64_t) const { return false; }
  virtual bool wants_avalanches(std::int64_t) const { return false; }
  /// Writes its files as of now. Averages from "steady" on count from `flow.from`.
  virtual void write(const Flow& flow) const = 0;
  virtual void save(StateOutput& archive) = 0;
  virtual void load(StateInput& archive) = 0;
};

/// Gives an observer save and load out of its serialize(archive).
template <class Self>
class Remembering : public Observer {
 public:
  void save(StateOutput& archive) override { static_cast<Self&>(*this).serialize(archive); }
  void load(StateInput& archive) override { static_cast<Self&>(*this).serialize(archive); }
};

/// What an observer asks of the engine.
struct Needs {
  bool contacts = false, impacts = false, avalanches = false;
  bool powers = false;  ///< what forces and velocities at contacts make: grains are soft, walls stand still
  bool plane_of_beads = false;  ///< a bed of beads in 3D that repeats along and across
  bool closed_box = false;      ///< a domain that repeats in all directions
  bool space = false;           ///< three dimensions
  bool same_grains = false;     ///< that are there from the beginning to the end: it keeps something of each
};

/// What is long, fast and slow in a scene: defaults of outputs follow from it.
struct Scales {
  double duration;
  double length;           ///< a bed grain's diameter
  double velocity;         ///< √(g d), or 1
  double between_samples;  ///< 0.02 √(d/g)
};

/// What a scene's [output] says of one kind of observer. It describes its keys at the level of [output]: a table of its
/// own, or a single key.
class Output : public Keys {
 public:
  using Thing = Output;
  virtual std::unique_ptr<Output> clone() const = 0;
  virtual bool wanted() const = 0;
  /// Nothing of it, from now on.
  virtual void drop() = 0;
  virtual Needs needs() const { return {}; }
  /// Fills in what was not given. Called before the keys are read and after.
  virtual void before_reading(const Scales&) {}
  virtual void fill(const Scales&) {}
  /// Shortest time between its looks that steps should divide; infinite if it does not matter.
  virtual double rhythm() const { return std::numeric_limits<double>::infinity(); }
  /// Keys that a run may change when it goes on, while what was collected stays. Where others change it begins anew.
  virtual std::vector<std::string> may_change() const { return {}; }
  /// Names in the run directory that it writes, files and folders.
  virtual std::vector<std::string> files() const = 0;
  /// The observers; `wanted` holds.
  virtual std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const = 0;
};

/// All kinds of observers, in the order of [output].
Catalogue<Output>& list();

/// The files and folders that any of them writes.
std::vector<std::string> all_files();

/// When one kind of output is written, in the scene's time.
struct Every {
  double every = 0, from = 0;
};
template <class Archive>
void describe(Archive& a, Every& every) {
  a.required("every", every.every, positive, "time from one to the next");
  a.value("from", every.from, non_negative, "time of the first");
}

/// An output with a table of its own, [output.WORD], that may be absent.
template <class Self, class Spec>
class TableOutput : public Described<Output, Self> {
 public:
  std::optional<Spec> spec;

  template <class Archive>
  void describe(Archive& a) {
    a.section(Self::word, spec);
  }
  bool wanted() const override { return spec.has_value(); }
  void drop() override { spec.reset(); }
};

/// The columns of a table with one line per Row.
template <class Row>
class Columns {
 public:
  using Cell = io::Csv::Cell;
  Columns& add(std::string name, std::function<Cell(const Row&)> value) {
    names_.push_back(std::move(name));
    values_.push_back(std::move(value));
    return *this;
  }
  Columns& add(std::string name, double Row::*member) {
    return add(std::move(name), [member](const Row& row) { return row.*member; });
  }
  /// A mean and its error: the columns `name` and `name_err`.
  Columns& add_estimate(const std::string& name, std::function<const Estimate&(const Row&)> of) {
    add(name, [of](const Row& row) { return of(row).mean; });
    return add(name + "_err", [of](const Row& row) { return of(row).error; });
  }
  Columns& add(const std::string& name, Estimate Row::*member) {
    return add_estimate(name, [member](const Row& row) -> const Estimate& { return row.*member; });
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

}  // namespace chute::measure
