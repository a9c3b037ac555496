#include "sweep/sweep.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/file_lock.hpp"
#include "io/csv.hpp"
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
      : base_(base),
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
        store_->get(scene_at(mine[k] / seeds(), mine[k] % seeds()), report);
    });
    return spec_.boundary ? write_boundaries() : write_tables();
  }

 private:
  const Base& base_;
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
    if (read_file(mark) != text) refuse("holds another sweep; choose another folder");
    if (!first && !options_.resume && options_.shards == 1)
      refuse("holds this sweep already; --resume goes on with it");
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

  /// False if some point is not there yet: another shard's.
  bool write_tables() const {
    io::Csv table(
        comments("one row per place of the grid: starts by verdict, and means over the steady ones with "
                 "their standard errors; v_x_median is over all that still move"),
        columns({"starts", "stopped", "steady", "accelerating", "runaway", "unsettled", "v_x", "v_x_err",
                 "v_x_median", "v_x_median_err", "omega", "omega_err", "kinetic", "kinetic_err"}));
    auto each_columns =
        columns({"seed", "start", "from", "v_x", "v_x_err", "omega", "omega_err", "kinetic", "kinetic_err"});
    each_columns.insert(each_columns.begin(), "verdict");
    io::Csv each(comments("one row per start: what became of it, and means from then on"), each_columns);
    for (std::size_t p = 0; p < places_.size(); ++p) {
      std::vector<measure::Flow> starts;
      for (std::size_t s = 0; s < seeds(); ++s) {
        const auto followed = store_->find(scene_at(p, s));
        if (!followed) return false;
        for (std::size_t k = 0; k < followed->starts.size(); ++k) {
          const auto& f = followed->starts[k];
          starts.push_back(f);
          each.row({measure::name(f.verdict)},
                   cells(places_[p], {double(s + 1), double(k), f.from, f.v_x.mean, f.v_x.error, f.omega.mean,
                                      f.omega.error, f.kinetic.mean, f.kinetic.error}));
        }
      }
      const auto t = tally(starts);
      const auto n = [&](Verdict v) { return static_cast<double>(t.count(v)); };
      table.row(cells(places_[p],
                      {double(t.starts), n(Verdict::stopped), n(Verdict::steady), n(Verdict::accelerating),
                       n(Verdict::runaway), n(Verdict::unsettled), t.v_x.mean, t.v_x.error, t.median.mean,
                       t.median.error, t.omega.mean, t.omega.error, t.kinetic.mean, t.kinetic.error}));
    }
    write_atomically(file("starts.csv"), each.text());
    write_atomically(file("sweep.csv"), table.text());
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
    write_atomically(file("boundaries.csv"), table.text());
    return true;
  }
};

}  // namespace

bool run_sweep(const Base& base, const SweepOptions& options) { return Sweep(base, options).go(); }

}  // namespace chute::sweep
