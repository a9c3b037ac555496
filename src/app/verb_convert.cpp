#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "app/file_meanings.hpp"
#include "app/interrupt.hpp"
#include "app/numbers.hpp"
#include "app/progress.hpp"
#include "app/say.hpp"
#include "app/verbs.hpp"
#include "common/error.hpp"
#include "write/convert.hpp"

namespace chute::app {
namespace {

struct ConvertArguments {
  std::vector<std::string> sources;
  std::string folder, format;
  FileMeanings meanings;
  int jobs = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 16u));
  bool one_file = false, from_one = false, quiet = false;
};

void convert(const ConvertArguments& a) {
  write::ConvertJob job;
  job.sources.assign(a.sources.begin(), a.sources.end());
  job.folder = a.folder;
  job.format = static_cast<write::Format>(
      choice("--to", a.format, {write::format_words.begin(), write::format_words.end()}));
  job.meanings = a.meanings.read();
  job.jobs = a.jobs;
  job.one_file = a.one_file, job.from_one = a.from_one;
  watch_for_interrupt();
  Progress progress("convert", a.quiet);
  job.progress = [&](std::size_t done, std::size_t all) {
    progress.show(static_cast<double>(done) / static_cast<double>(all), fmt::format("{} of {}", done, all));
    return !interrupted();
  };
  const auto report = write::convert(job);
  if (a.quiet) return;
  if (report.left_out > 0)
    tell("convert: left out {} grain{} (of all frames) without a place or a radius > 0\n", report.left_out,
         report.left_out == 1 ? "" : "s");
  if (report.tilted) tell("convert: a {} file has no place for a tilted box: it is left out\n", a.format);
  tell("convert: {} frame{} in {}\n", report.frames, report.frames == 1 ? "" : "s", a.folder);
}

}  // namespace

void add_convert(CLI::App& app) {
  auto* verb = app.add_subcommand("convert", "Write frames as files of other programs");
  auto a = std::make_shared<ConvertArguments>();
  verb->add_option(
          "sources", a->sources,
          "run directory; or VTK files of grains, dumps of LAMMPS or XYZ files, as chute render takes them")
      ->required();
  verb->add_option("--to", a->format,
                   "lammps-dump, xyz (extended), csv, or vtp (VTK, with an index of times)")
      ->required();
  verb->add_option("-o,--output", a->folder,
                   "folder for NNNNNN.dump, .xyz, .csv or frames/NNNNNN.vtp; new or empty")
      ->required();
  verb->add_flag("--one-file", a->one_file, "all frames in one file, frames.dump, .xyz or .csv");
  verb->add_flag("--from-one", a->from_one,
                 "dumps: ids and types begin with 1, as LAMMPS wants of what it reads; default as they are");
  a->meanings.add_options(*verb);
  verb->add_option("-j,--jobs", a->jobs, "frames that are worked on at once; the files are the same")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  verb->add_flag("--quiet", a->quiet, "no progress");
  verb->footer("Example: chute convert out/demo --to lammps-dump -o out/dumps");
  verb->callback([a] { convert(*a); });
}

}  // namespace chute::app
