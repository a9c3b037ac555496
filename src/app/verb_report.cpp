#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <thread>
#include <tuple>

#include "app/interrupt.hpp"
#include "app/numbers.hpp"
#include "app/progress.hpp"
#include "app/say.hpp"
#include "app/verbs.hpp"
#include "common/error.hpp"
#include "report/report.hpp"
#include "run/version.hpp"

namespace chute::app {
namespace {

struct ReportArguments {
  std::vector<std::string> runs;
  std::string output = "report.html", size = "960x540", color;
  int frames = 200;
  int jobs = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 16u));
  bool no_film = false, quiet = false;
};

void report(const ReportArguments& a) {
  report::ReportJob job;
  job.runs = a.runs, job.output = a.output, job.films = !a.no_film;
  std::tie(job.film.width, job.film.height) = read_size(a.size);
  job.film.frames = static_cast<std::size_t>(a.frames), job.film.jobs = a.jobs, job.film.color = a.color;
  job.made_by = fmt::format("chute {} ({})", run::version, run::commit);
  watch_for_interrupt();
  Progress progress("report", a.quiet);
  job.film.progress = [&](double part) {
    progress.show(part);
    if (interrupted()) throw WorkError("stopped; no page was made");
  };
  report::write_report(job);
  if (!a.quiet) tell("report: {}; open it with any browser\n", a.output);
}

}  // namespace

void add_report(CLI::App& app) {
  auto* verb = app.add_subcommand(
      "report", "Tell runs in one self-contained page: scene, verdict, film, figures, numbers");
  auto a = std::make_shared<ReportArguments>();
  verb->add_option("runs", a->runs, "run directories; several are compared side by side")->required();
  verb->add_option("-o,--output", a->output, "the page (HTML), which needs no network and no file beside it")
      ->capture_default_str();
  verb->add_option("--color", a->color,
                   "array that colours the grains, as of chute render; default the speed");
  verb->add_option("--size", a->size, "pixels of the film, WIDTHxHEIGHT")->capture_default_str();
  verb->add_option("--frames", a->frames, "frames of the film at most; of a longer run every n-th is taken")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  verb->add_flag("--no-film", a->no_film, "only what stands in tables");
  verb->add_option("-j,--jobs", a->jobs, "processes that draw at once; the page is the same")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  verb->add_flag("--quiet", a->quiet, "no progress");
  verb->footer("Example: chute report out/flat out/steep -o report.html");
  verb->callback([a] { report(*a); });
}

}  // namespace chute::app
