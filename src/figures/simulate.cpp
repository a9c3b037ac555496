#include "figures/simulate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/column_texts.hpp"
#include "common/error.hpp"
#include "common/file_lock.hpp"
#include "common/hash.hpp"
#include "common/side_by_side.hpp"
#include "figures/extract.hpp"
#include "figures/extract_hard.hpp"
#include "figures/held_fixed.hpp"
#include "figures/table_source.hpp"
#include "measure/diffusion.hpp"
#include "read/table.hpp"
#include "run/facts.hpp"
#include "run/flow.hpp"
#include "run/run.hpp"
#include "run/version.hpp"

namespace chute::figures {
namespace fs = std::filesystem;
namespace {

/// A run that some curves need.
struct Job {
  scene::Scene scene;
  fs::path directory;
  int threads = 1;
};

/// The runs of a recipe, each once, and which of them each curve needs.
struct Plan {
  std::vector<Job> jobs;
  std::vector<std::vector<std::size_t>> of_curve;
};

/// The runs of one recipe as its curves ask for them.
class Planner {
 public:
  Planner(const DataRecipe& recipe, const fs::path& recipe_file, const fs::path& work, bool quick)
      : recipe_(recipe), scene_file_(recipe_file.parent_path() / *recipe.scene), work_(work), quick_(quick) {}

  /// The runs that others begin with. They must be there before those others are planned.
  std::vector<Job> before() const {
    std::vector<Job> jobs;
    std::map<std::string, std::size_t> known;
    for_runs([&](std::size_t c, std::int64_t seed) {
      if (recipe_.curves[c].after.empty()) return;
      auto job = job_before(recipe_.curves[c], seed);
      if (known.try_emplace(job.directory.string(), jobs.size()).second) jobs.push_back(std::move(job));
    });
    return jobs;
  }
  Plan plan() const {
    Plan plan;
    plan.of_curve.resize(recipe_.curves.size());
    std::map<std::string, std::size_t> known;
    for_runs([&](std::size_t c, std::int64_t seed) {
      const Curve& curve = recipe_.curves[c];
      auto settings = settings_of(curve, seed);
      if (!curve.after.empty()) {
        for (const char* brought : {"grains.count=", "grains.diameter=", "grains.size_ratio="})
          settings.emplace_back(brought);
        settings.push_back(fmt::format("grains.start={{from='{}'}}",
                                       fs::absolute(job_before(curve, seed).directory).string()));
        settings.insert(settings.end(), curve.go_on.begin(), curve.go_on.end());
      }
      auto job = job_of(curve, settings);
      const auto [at, is_new] = known.try_emplace(job.directory.string(), plan.jobs.size());
      if (is_new) plan.jobs.push_back(std::move(job));
      plan.of_curve[c].push_back(at->second);
    });
    return plan;
  }

 private:
  const DataRecipe& recipe_;
  fs::path scene_file_;
  const fs::path& work_;
  bool quick_;

  template <class Visit>
  void for_runs(const Visit& visit) const {
    for (std::size_t c = 0; c < recipe_.curves.size(); ++c) {
      if (quick_ && recipe_.curves[c].full_only) continue;
      for (std::int64_t seed = 1; seed <= (quick_ ? recipe_.quick_seeds : recipe_.seeds); ++seed)
        visit(c, seed);
    }
  }
  std::vector<std::string> settings_of(const Curve& curve, std::int64_t seed) const {
    auto settings = recipe_.set;
    settings.insert(settings.end(), curve.set.begin(), curve.set.end());
    if (quick_)
      for (const auto* cheaper : {&recipe_.quick, &curve.quick})
        settings.insert(settings.end(), cheaper->begin(), cheaper->end());
    settings.push_back(fmt::format("seed={}", seed));
    return settings;
  }
  Job job_of(const Curve& curve, const std::vector<std::string>& settings) const {
    auto scene = scene::read_scene(scene_file_, settings);
    if (curve.extract != Extract::network) scene.drop_output("frames");  // other figures need none
    const auto text = scene::to_toml(scene);
    auto name = fmt::format("{}-{}", scene_file_.stem().string(), hash_of(text).substr(0, 32));
    if (curve.threads > 1) name += fmt::format("-{}", curve.threads);  // the same numbers in another time
    return {std::move(scene), work_ / name, static_cast<int>(curve.threads)};
  }
  Job job_before(const Curve& curve, std::int64_t seed) const {
    auto settings = settings_of(curve, seed);
    settings.insert(settings.end(), curve.after.begin(), curve.after.end());
    return job_of(curve, settings);
  }
};

/// Does the runs that are not there yet, up to `count` side by side. The first error stops all.
void run_all(const std::vector<Job>& jobs, int count, const std::string& command_line,
             const Report& progress) {
  side_by_side(jobs.size(), count, progress, [&](std::size_t k, const Report& report) {
    if (run::is_finished_run_of(jobs[k].directory, jobs[k].scene))
      return FolderLock::remove_leftover(jobs[k].directory);
    run::RunOptions options;
    options.directory = jobs[k].directory;
    options.existing = run::Existing::replace;
    options.threads = jobs[k].threads;
    options.command_line = command_line;
    options.progress = report;
    if (!run::run_scene(jobs[k].scene, options).finished) throw WorkError("stopped");
  });
}

}  // namespace

namespace {

/// Is it about the time that runs take? Then each has the machine for itself.
bool is_timed(const DataRecipe& recipe) {
  return std::ranges::any_of(recipe.curves, [](const Curve& curve) {
    return curve.extract == Extract::state && curve.column == "seconds";
  });
}

/// What the columns of the runs' tables mean that a curve draws, as comments.
std::vector<std::string> meanings_of(const Curve& curve) {
  const auto file = curve.file                          ? fs::path(*curve.file).filename().string()
                    : curve.extract == Extract::profile ? std::string("profiles.csv")
                    : curve.extract == Extract::series  ? std::string("series.csv")
                                                        : std::string();
  return column_lines(file, {curve.against, curve.column});
}

/// The table of a recipe whose curves name runs that are there.
/// A profile of a flow that did not settle says so in its file.
std::vector<std::string> doubts_of(const Curve& curve, const std::vector<fs::path>& runs) {
  if (curve.extract != Extract::profile) return {};
  for (const auto& run : runs)
    if (auto lines =
            doubts(read::read_table(run / (curve.fine ? "profiles_fine.csv" : "profiles.csv")).comments,
                   curve.panel, {curve.series});
        !lines.empty())
      return lines;
  return {};
}

FigureTable from_runs(const DataRecipe& recipe, const fs::path& recipe_file) {
  FigureTable table;
  table.comments = {fmt::format("x: {}", recipe.x), fmt::format("y: {}", recipe.y)};
  for (const auto& note : recipe.notes) table.comments.push_back(note);
  for (const auto& curve : recipe.curves) {
    std::vector<fs::path> runs;
    for (const auto& run : curve.runs) runs.push_back(recipe_file.parent_path() / run);
    table.comments.push_back(fmt::format("{}{}: from {}", curve.panel.empty() ? "" : curve.panel + " ",
                                         curve.series, fmt::join(curve.runs, ", ")));
    for (auto& line : meanings_of(curve)) table.comments.push_back(std::move(line));
    for (auto& line : doubts_of(curve, runs)) table.comments.push_back(std::move(line));
    const auto rows = extract(curve, runs);
    table.rows.insert(table.rows.end(), rows.begin(), rows.end());
  }
  return table;
}

/// How often a scene is run for a point of the curve: once a launch, and for a boundary at half of the values that may be looked
/// at first, then at each bisection.
double looks_of(const SweepCurve& curve, bool quick) {
  const auto launches = [](const std::vector<double>& velocities) {
    return static_cast<double>(std::max<std::size_t>(1, velocities.size()));
  };
  if (!curve.boundary) return launches(curve.velocities);
  const auto& spec = *curve.boundary;
  const auto values = spec.axis.points(quick);
  const double step = values.size() > 1 ? values[1] - values[0] : spec.tolerance;
  const double tolerance = quick ? curve.quick_tolerance.value_or(spec.tolerance) : spec.tolerance;
  const double bisections = std::max(0.0, std::ceil(std::log2(step / tolerance)));
  return launches(spec.velocities) * (static_cast<double>(values.size() + 1) / 2 + bisections);
}

}  // namespace

Work work_of(const DataRecipe& recipe, const fs::path& recipe_file, const fs::path& work, bool quick) {
  Work found;
  const auto add = [&found](const Job& job) {
    ++found.runs;
    if (run::is_finished_run_of(job.directory, job.scene))
      ++found.there;
    else
      found.seconds += run::cost_of(job.scene);
  };
  const Planner planner(recipe, recipe_file, work, quick);
  const auto before = planner.before();
  std::ranges::for_each(before, add);
  // What begins with the end of a run that is not there yet cannot be read; it is about as long as without.
  const bool begun = std::ranges::all_of(
      before, [](const Job& job) { return run::is_finished_run_of(job.directory, job.scene); });
  auto alone = recipe;
  for (auto& curve : alone.curves)
    if (!begun) curve.after.clear(), curve.go_on.clear();
  std::ranges::for_each(Planner(alone, recipe_file, work, quick).plan().jobs, add);
  auto set = recipe.set;
  if (quick) set.insert(set.end(), recipe.quick.begin(), recipe.quick.end());
  const auto seeds = quick ? recipe.quick_seeds : recipe.seeds;
  for (const auto& curve : recipe.sweeps) {
    const sweep::Base base(recipe_file.parent_path() / *recipe.scene, set);
    for (const double x : curve.x.points(quick)) {
      const auto scene = base.with(curve.set).with({curve.x.setting(x)}).scene({});
      found.runs += static_cast<std::size_t>(seeds);
      found.seconds += run::cost_of(scene) * static_cast<double>(seeds) * looks_of(curve, quick);
    }
  }
  return found;
}

/// "5 runs steady, 3 unsettled": what became of the flows that a curve is averaged over.
static std::string verdicts_of(const std::vector<fs::path>& runs) {
  std::map<std::string, int> count;
  for (const auto& run : runs) ++count[std::string(measure::name(run::read_flow(run).verdict))];
  std::vector<std::string> texts;
  for (const auto& [verdict, runs_so] : count)
    texts.push_back(fmt::format("{} run{} {}", runs_so, runs_so > 1 ? "s" : "", verdict));
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// A mean over the runs that settled; what the others have stands apart as "NAME unsettled". Where none settled the curve is
/// theirs, and the table says that it is to be drawn hollow.
static std::vector<FigureRow> settled_and_not(const Curve& curve, const std::vector<fs::path>& runs,
                                              FigureTable& table) {
  std::vector<fs::path> settled, others;
  for (const auto& run : runs)
    (run::read_flow(run).verdict == measure::Verdict::steady ? settled : others).push_back(run);
  if (settled.empty()) {
    table.comments.push_back(
        fmt::format("hollow{}: {}", curve.panel.empty() ? "" : " " + curve.panel, curve.series));
    return extract(curve, others);
  }
  auto rows = extract(curve, settled);
  if (others.empty()) return rows;
  Curve part = curve;
  part.series += " unsettled";
  const auto apart = extract(part, others);
  rows.insert(rows.end(), apart.begin(), apart.end());
  return rows;
}

/// How far balls wander is known of those that go on: runs that end with most of their balls at rest tell of the way there.
/// They are left out, and the table says so.
static std::vector<fs::path> going_on(const Curve& curve, std::vector<fs::path> runs, FigureTable& table) {
  if (curve.file != measure::diffusion_coefficients_file) return runs;
  const auto stopped = std::erase_if(
      runs, [](const fs::path& run) { return run::read_flow(run).verdict == measure::Verdict::stopped; });
  if (stopped > 0)
    table.comments.push_back(fmt::format("{}{}{} at {}: the balls of {} run{} stopped; {}", curve.panel,
                                         curve.panel.empty() ? "" : " ", curve.series, curve.x(), stopped,
                                         stopped > 1 ? "s" : "", runs.empty() ? "no row" : "left out"));
  return runs;
}

FigureTable simulate(const DataRecipe& recipe, const fs::path& recipe_file, const fs::path& work,
                     const FigureContext& context, const std::string& command_line,
                     const std::function<bool(double)>& progress) {
  if (recipe.runs) return from_runs(recipe, recipe_file);
  const Planner planner(recipe, recipe_file, work, context.quick);
  run_all(planner.before(), context.jobs, command_line, progress);
  const Plan plan = planner.plan();
  run_all(plan.jobs, is_timed(recipe) ? 1 : context.jobs, command_line, progress);
  FigureTable table;
  const auto seeds = context.quick ? recipe.quick_seeds : recipe.seeds;
  table.comments = {fmt::format("x: {}", recipe.x), fmt::format("y: {}", recipe.y)};
  for (const auto& note : recipe.notes) table.comments.push_back(note);
  for (auto& comment : held_fixed(recipe, recipe_file)) table.comments.push_back(std::move(comment));
  table.comments.push_back(fmt::format(
      "made by chute {} ({}) from scene {}{}{}; {} run{} per series, seed{} 1{}", run::version, run::commit,
      *recipe.scene, recipe.set.empty() ? "" : " with ", fmt::join(recipe.set, " "), seeds,
      seeds > 1 ? "s" : "", seeds > 1 ? "s" : "", seeds > 1 ? fmt::format(" to {}", seeds) : ""));
  if (context.quick)
    table.comments.push_back(
        fmt::format("quick: a cheaper simulation than the full figure's ({})", fmt::join(recipe.quick, " ")));
  for (std::size_t c = 0; c < recipe.curves.size(); ++c) {
    std::vector<fs::path> runs;
    for (const auto k : plan.of_curve[c]) runs.push_back(plan.jobs[k].directory);
    if (recipe.curves[c].extract == Extract::profile && (c == 0 || plan.of_curve[c] != plan.of_curve[c - 1]))
      table.comments.push_back(recipe.curves[c].series + ": " + verdicts_of(runs));
    if (context.quick && recipe.curves[c].full_only) continue;
    for (auto& line : meanings_of(recipe.curves[c])) table.comments.push_back(std::move(line));
    const auto rows = recipe.curves[c].extract == Extract::profile
                          ? settled_and_not(recipe.curves[c], runs, table)
                          : extract(recipe.curves[c], going_on(recipe.curves[c], runs, table));
    if (const auto part = left_out(recipe.curves[c], runs);
        part && recipe.curves[c].extract == Extract::scatter)
      table.comments.push_back(fmt::format("{} {}: {:.1f} % of the rows are left out", recipe.curves[c].panel,
                                           recipe.curves[c].series, 100 * *part));
    if (recipe.curves[c].extract == Extract::janssen)
      table.comments.push_back(janssen_note(recipe.curves[c], runs));
    table.rows.insert(table.rows.end(), rows.begin(), rows.end());
  }
  if (!recipe.sweeps.empty()) {
    auto set = recipe.set;
    if (context.quick) set.insert(set.end(), recipe.quick.begin(), recipe.quick.end());
    const auto made = sweep_curves(recipe.sweeps,
                                   {sweep::Base(recipe_file.parent_path() / *recipe.scene, set), seeds,
                                    context.quick, context.jobs, work / "points"},
                                   progress);
    table.comments.insert(table.comments.end(), made.comments.begin(), made.comments.end());
    table.rows.insert(table.rows.end(), made.rows.begin(), made.rows.end());
  }
  return table;
}

}  // namespace chute::figures
