#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "app/file_meanings.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/say.hpp"
#include "app/settings.hpp"
#include "app/snapshots.hpp"
#include "app/verbs.hpp"
#include "common/error.hpp"
#include "common/new_folder.hpp"
#include "replay/frame_outputs.hpp"
#include "replay/measure_frames.hpp"
#include "run/version.hpp"

namespace chute::app {
namespace {

struct MeasureArguments {
  std::vector<std::string> sources, only, settings, bed;
  std::string folder;
  FileMeanings meanings;
  double from = 0, until = std::numeric_limits<double>::infinity(), gap = 0;
  bool quiet = false;
};

void measure(const MeasureArguments& a) {
  const NewFolder free(a.folder, replay::is_measured);  // before much is read
  const FileSays says{a.meanings.read(), a.bed};
  const auto [frames, times] = timed_frames(a.sources, says.meanings);
  watch_for_interrupt();
  Progress progress("measure", a.quiet);
  replay::MeasureJob job;
  job.times = times;
  job.read = [&says, &all = frames](std::size_t k) { return snapshot_of(all[k], says); };
  job.folder = a.folder;
  job.from = a.from, job.until = a.until, job.gap = a.gap;
  job.only = a.only, job.settings = a.settings;
  job.title = fmt::format("frames of {}", fmt::join(a.sources, ", "));
  job.made_by = fmt::format("chute {} ({})", run::version, run::commit);
  job.progress = [&](std::size_t done, std::size_t all) {
    progress.show(static_cast<double>(done) / static_cast<double>(all), fmt::format("{} of {}", done, all));
    return !interrupted();
  };
  const auto report = replay::measure_frames(job);
  if (a.quiet) return;
  for (const auto& note : report.notes) tell("measure: {}\n", note);
  tell("measure: {} frame{}; in {}: {}\n", report.frames, report.frames == 1 ? "" : "s", a.folder,
       fmt::join(report.written, ", "));
}

}  // namespace

void add_measure(CLI::App& app) {
  auto* verb = app.add_subcommand("measure", "Measure frames of any program as a run measures its own");
  auto a = std::make_shared<MeasureArguments>();
  verb->add_option(
          "sources", a->sources,
          "run directory; or VTK files of grains, dumps of LAMMPS or XYZ files, as chute render takes them")
      ->required();
  verb->add_option("-o,--output", a->folder,
                   "folder for the tables, and contacts/ where they had to be found; new or empty")
      ->required();
  verb->add_option("--only", a->only,
                   fmt::format("of {}; default those that the frames have something for",
                               fmt::join(replay::measurable(), ", ")))
      ->delimiter(',');
  add_settings(*verb, "--set", "KEY=VALUE", a->settings,
               "a key of [output]: profiles.bin=0.5, profiles.from=steady");
  verb->add_option("--from", a->from, "time of the first frame that counts")->capture_default_str();
  verb->add_option("--until", a->until, "time of the last one; default the last");
  verb->add_option("--gap", a->gap, "surfaces less than this apart touch, where a file has no contacts")
      ->capture_default_str();
  verb->add_option("--bed", a->bed,
                   "types of grains that do not move, of other programs' files: --bed 1,wall")
      ->delimiter(',');
  a->meanings.add_options(*verb);
  verb->add_flag("--quiet", a->quiet, "no progress, and no word on what files lack");
  verb->footer("Example: chute measure post/dump.* -o out/measured --set profiles.bin=0.01");
  verb->callback([a] { measure(*a); });
}

}  // namespace chute::app
