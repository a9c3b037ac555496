#include "sweep/sweep.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "common/atomic_file.hpp"
#include "common/column_texts.hpp"
#include "common/error.hpp"
#include "common/file_lock.hpp"
#include "io/csv.hpp"
#include "run/flow.hpp"
#include "run/growth.hpp"
#include "run/run.hpp"
#include "run/version.hpp"
#include "sweep/sweep_file.hpp"

namespace chute::sweep {
namespace {

namespace fs = std::filesystem;
using measure::Verdict;

/// One sweep in its folder.
class Sweep {
 public:
  Sweep(const Base& base, const SweepOptions& options)
      : base_(as_kept(base, options)),
        options_(options),
        spec_(read_sweep(base)),
        places_(grid(spec_.axes)),
        first_(
            base.scene(places_.front().set)) {  // and so a wrong scene is refused before anything is written
    for (const auto& place : places_) base_.scene(place.set);
    claim_folder();
    store_.emplace(options.directory / "points");
  }

  bool go() {
    const std::size_t pieces = spec_.boundary ? places_.size() : places_.size() * seeds();
    std::vector<std::size_t> mine;
    for (std::size_t k = static_cast<std::size_t>(options_.shard - 1); k < pieces;
         k += static_cast<std::size_t>(options_.shards))
      mine.push_back(k);
    side_by_side(mine.size(), options_.jobs, options_.progress, [&](std::size_t k, const Report& report) {
      if (spec_.boundary)
        boundaries_at(places_[mine[k]], *store_, report);
      else
        simulate(mine[k] / seeds(), mine[k] % seeds(), report);
    });
    return spec_.boundary ? write_boundaries() : write_tables();
  }

 private:
  Base base_;
  const SweepOptions& options_;
  SweepSpec spec_;
  std::vector<Place> places_;
  scene::Scene first_;
  std::vector<FolderLock> locks_;
  std::optional<PointStore> store_;

  std::size_t seeds() const { return static_cast<std::size_t>(spec_.seeds); }
  scene::Scene scene_at(std::size_t place, std::size_t seed) const {
    return base_.with(places_[place].set).scene({fmt::format("seed={}", seed + 1)});
  }
  static Base as_kept(Base base, const SweepOptions& options) {
    base.outputs = options.keep_runs;
    return base;
  }
  /// runs/incline.sin=0.06_grains.size_ratio=3_seed=1
  std::string run_name(std::size_t place, std::size_t seed) const {
    std::string name = "runs/";
    for (std::size_t k = 0; k < spec_.axes.size(); ++k)
      name += fmt::format("{}={}_", spec_.axes[k].key, places_[place].values[k]);
    return name + fmt::format("seed={}", seed + 1);
  }
  /// The file or folder of one run.
  std::string where(std::size_t place, std::size_t seed) const {
    return options_.keep_runs ? run_name(place, seed) : "points/" + store_->name_of(scene_at(place, seed));
  }
  void simulate(std::size_t place, std::size_t seed, const Report& report) const {
    const auto scene = scene_at(place, seed);
    if (!options_.keep_runs) {
      store_->get(scene, report);
      return;
    }
    const auto folder = options_.directory / run_name(place, seed);
    if (store_->find(scene) && run::is_finished_run_of(folder, scene)) return;
    run::RunOptions options;
    options.directory = folder;
    options.existing = run::Existing::resume;
    options.command_line = options_.command_line;
    options.progress = report;
    Followed followed;
    try {
      const auto result = run::run_scene(scene, options);
      if (!result.finished) throw WorkError("stopped");
      followed.starts = result.starts;
    } catch (const WorkError& error) {
      if (!left_physics(folder)) throw;
      followed.left_physics = error.what();
      followed.starts = {run::read_flow(folder)};
    }
    store_->put(scene, followed);
  }
  static bool left_physics(const fs::path& run) {
    try {
      return nlohmann::json::parse(read_file(run / "run.json")).value("end", "") == "left physics";
    } catch (const std::exception&) {
      return false;
    }
  }
  Boundaries boundaries_at(const Place& place, const PointStore& store, const Report& progress) const {
    return boundaries_of(base_.with(place.set), *spec_.boundary, Wanted::both, spec_.seeds, store, progress);
  }
  fs::path file(const char* name) const { return options_.directory / name; }

  std::string shard() const { return fmt::format("shard-{}-of-{}", options_.shard, options_.shards); }

  /// Shards share the folder, and may all start at the same moment: whoever comes first writes what the sweep is.
  void claim_folder() {
    const auto refuse = [&](const char* what) {
      throw InputError(fmt::format("{}: {}", options_.directory.string(), what));
    };
    const auto text = to_toml(base_, spec_);
    const auto mark = file("sweep.toml");
    if (holds_other_things() && !fs::exists(mark)) refuse("holds other things; choose another folder");
    std::error_code error;
    fs::create_directories(options_.directory, error);
    if (error) throw WorkError(options_.directory.string() + ": cannot be made: " + error.message());
    locks_.emplace_back(options_.directory, options_.shards > 1 ? LockKind::together : LockKind::alone);
    if (options_.shards > 1) locks_.emplace_back(options_.directory, LockKind::alone, shard());
    remove_leftovers(options_.directory);
    remove_leftovers(file("points"));
    const bool first = write_if_absent(mark, text);
    if (const auto there = read_file(mark); there != text) {
      if (const auto other = other_scene(there, text))
        refuse(fmt::format("holds another sweep: {}; what may grow is [sweep]", *other).c_str());
      if (!options_.resume)
        refuse("holds this sweep with another [sweep]; --resume keeps what is done of it");
      write_atomically(mark, text);
    }
    if (!first && !options_.resume && options_.shards == 1)
      refuse("holds this sweep already; --resume goes on with it");
  }
  /// What two sweeps have different besides [sweep] and the keys that it changes.
  static std::optional<std::string> other_scene(const std::string& there, const std::string& here) {
    std::set<std::string> swept{"seed", "grains.start.velocity"};
    for (const auto& text : {there, here}) {
      const auto spec = read_sweep(Base("sweep.toml", {}, text));
      for (const auto& axis : spec.axes) swept.insert(axis.key);
      if (spec.boundary) swept.insert(spec.boundary->axis.key);
    }
    return run::difference_that_matters(there, here, [&](const std::string& key) {
      return key.starts_with("sweep.") || swept.count(key) > 0;
    });
  }
  bool holds_other_things() const {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(options_.directory, error))
      if (!is_temporary(entry.path()) && !FolderLock::is_name(entry.path())) return true;
    return false;
  }

  std::vector<std::string> comments(std::string what) const {
    return {std::move(what), fmt::format("{}; units: {}; seeds 1 to {}; chute {} ({})", first_.title,
                                         first_.units == scene::Units::si ? "SI" : "reduced", spec_.seeds,
                                         run::version, run::commit)};
  }
  std::vector<std::string_view> columns(std::initializer_list<std::string_view> measured) const {
    std::vector<std::string_view> all;
    for (const auto& axis : spec_.axes) all.push_back(axis.key);
    all.insert(all.end(), measured.begin(), measured.end());
    return all;
  }
  static std::vector<io::Csv::Cell> cells(const Place& place, std::initializer_list<io::Csv::Cell> measured) {
    std::vector<io::Csv::Cell> all(place.values.begin(), place.values.end());
    all.insert(all.end(), measured.begin(), measured.end());
    return all;
  }

  void write_table(const char* name, const io::Csv& table) const {
    write_atomically(file(name), with_column_comments(name, table.text(), first_.si()));
  }

  /// False if some point is not there yet: another shard's.
  bool write_tables() const {
    auto place_columns =
        columns({"starts", "stopped", "steady", "accelerating", "runaway", "unsettled", "v_x", "v_x_err",
                 "v_x_median", "v_x_median_err", "omega", "omega_err", "kinetic", "kinetic_err"});
    place_columns.insert(place_columns.begin(), {"verdict", "runs"});
    io::Csv table(
        comments(
            "one row per place of the grid: the verdict that most starts have, where their runs are, starts by "
            "verdict, and means over the steady ones with their standard errors; v_x_median is over all that "
            "still move"),
        place_columns);
    auto each_columns =
        columns({"seed", "start", "from", "v_x", "v_x_err", "omega", "omega_err", "kinetic", "kinetic_err"});
    each_columns.insert(each_columns.begin(), {"verdict", "run"});
    io::Csv each(comments("one row per start: what became of it, and means from then on"), each_columns);
    for (std::size_t p = 0; p < places_.size(); ++p) {
      std::vector<measure::Flow> starts;
      std::string runs;
      for (std::size_t s = 0; s < seeds(); ++s) {
        runs += (s ? " " : "") + where(p, s);
        const auto followed = store_->find(scene_at(p, s));
        if (!followed) return false;
        for (std::size_t k = 0; k < followed->starts.size(); ++k) {
          const auto& f = followed->starts[k];
          starts.push_back(f);
          each.row({measure::name(f.verdict), where(p, s)},
                   cells(places_[p], {double(s + 1), double(k), f.from, f.v_x.mean, f.v_x.error, f.omega.mean,
                                      f.omega.error, f.kinetic.mean, f.kinetic.error}));
        }
      }
      const auto t = tally(starts);
      const auto n = [&](Verdict v) { return static_cast<double>(t.count(v)); };
      table.row({measure::name(measure::joined(starts).verdict), runs},
                cells(places_[p],
                      {double(t.starts), n(Verdict::stopped), n(Verdict::steady), n(Verdict::accelerating),
                       n(Verdict::runaway), n(Verdict::unsettled), t.v_x.mean, t.v_x.error, t.median.mean,
                       t.median.error, t.omega.mean, t.omega.error, t.kinetic.mean, t.kinetic.error}));
    }
    write_table("starts.csv", each);
    write_table("sweep.csv", table);
    return true;
  }

  /// Boundaries that are all in the store are found again from it without simulating.
  bool write_boundaries() const {
    io::Csv table(
        comments(fmt::format("phase boundaries along {}: A stops, B is steady, C is neither; errors are half "
                             "of the bracket; empty: not within the range",
                             spec_.boundary->axis.key)),
        columns({"AB", "AB_err", "BC", "BC_err"}));
    const auto cell = [](const std::optional<Estimate>& e, bool error) -> io::Csv::Cell {
      if (!e) return {};
      return error ? *e->error : e->mean;
    };
    try {
      for (const auto& place : places_) {
        const auto b = boundaries_at(place, store_->only_known(), [](double) { return true; });
        table.row(cells(place, {cell(b.AB, false), cell(b.AB, true), cell(b.BC, false), cell(b.BC, true)}));
      }
    } catch (const PointStore::PointIsMissing&) {
      return false;  // another shard's
    }
    write_table("boundaries.csv", table);
    return true;
  }
};

}  // namespace

bool run_sweep(const Base& base, const SweepOptions& options) { return Sweep(base, options).go(); }

SweepState sweep_state(const fs::path& directory) {
  const auto mark = directory / "sweep.toml";
  if (!fs::exists(mark)) throw InputError(directory.string() + ": not a sweep (no sweep.toml)");
  Base base(mark);
  SweepState state;
  state.spec = read_sweep(base);
  const auto places = grid(state.spec.axes);
  state.title = base.scene(places.front().set).title;
  state.table = fs::exists(directory / (state.spec.boundary ? "boundaries.csv" : "sweep.csv"));
  base.outputs = fs::exists(directory / "runs");
  const PointStore store(directory / "points");
  for (const auto& entry : fs::directory_iterator(directory / "points"))
    state.files += entry.path().extension() == ".json";
  if (state.spec.boundary) return state;
  for (const auto& place : places)
    for (std::int64_t seed = 1; seed <= state.spec.seeds; ++seed) {
      ++state.points;
      const auto followed = store.find(base.with(place.set).scene({fmt::format("seed={}", seed)}));
      if (!followed) continue;
      ++state.found;
      for (const auto& start : followed->starts) ++state.starts[static_cast<std::size_t>(start.verdict)];
    }
  return state;
}

std::string with_more_values(const Base& base, const std::vector<std::string>& more) {
  auto spec = read_sweep(base);
  for (const auto& text : more) {
    const auto wrong = [&] {
      return InputError(fmt::format("--add {}: expected KEY=VALUE,VALUE with numbers", text));
    };
    const auto equals = text.find('=');
    if (equals == 0 || equals == text.npos) throw wrong();
    const auto key = text.substr(0, equals);
    auto axis = std::ranges::find(spec.axes, key, &Axis::key);
    if (axis == spec.axes.end()) axis = spec.axes.insert(axis, Axis{key, {}, 0, 0, 0, {}, {}});
    auto values = axis->values.empty() && axis->count < 2 ? std::vector<double>{} : axis->points();
    std::istringstream list(text.substr(equals + 1));
    for (std::string word; std::getline(list, word, ',');) {
      double value = 0;
      const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc{} || stop != word.data() + word.size() || !std::isfinite(value)) throw wrong();
      values.push_back(value);
    }
    if (values.empty()) throw wrong();
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    axis->values = std::move(values);
  }
  std::string list;
  for (const auto& axis : spec.axes)
    list += fmt::format("{}{{key=\"{}\",values=[{}],unit=\"{}\"}}", list.empty() ? "" : ",", axis.key,
                        fmt::join(axis.points(), ","), axis.unit);
  return "sweep.axis=[" + list + "]";
}

}  // namespace chute::sweep
