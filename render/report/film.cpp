#include "report/film.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/programs.hpp"
#include "common/scratch_folder.hpp"
#include "read/run_frames.hpp"
#include "view/render_cells.hpp"
#include "view/render_run.hpp"
#include "view/survey.hpp"

namespace chute::report {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t still_count = 5;
constexpr int still_width = 400;
/// Without a movie every picture stands in the page by itself.
constexpr std::size_t most_pictures = 24;

bool has_ffmpeg() { return !find_program("ffmpeg").empty(); }

/// The index of what can be filmed: grains, else fields by cell.
std::optional<fs::path> source_of(const RunFiles& run) {
  for (const char* index : {"frames.pvd", "cells.pvd"})
    if (run.has(index) && !read::read_pvd(run.path / index).empty()) return run.path / index;
  return {};
}

struct Shot {
  fs::path source;
  std::vector<read::FrameFile> frames;
  std::size_t step = 1;
  std::size_t count() const { return (frames.size() + step - 1) / step; }
};

/// What films of several runs have in common, so that they can be compared.
struct Common {
  std::optional<std::pair<double, double>> range;  ///< of colours, if all show the same numbers
  Eigen::AlignedBox3d bounds;  ///< what is seen of each, if they are about as large; else nothing
  Eigen::AlignedBox2d turned;
};

/// One view for all runs of one kind. One that is much larger would make the others small.
void share_view(const std::vector<view::Survey>& found, Common& common) {
  constexpr double about_as_large = 2;
  Eigen::AlignedBox3d bounds;
  Eigen::AlignedBox2d turned;
  for (const auto& one : found) {
    if (one.dimensions != found[0].dimensions || one.units != found[0].units || one.turn != found[0].turn)
      return;
    bounds.extend(one.bounds), turned.extend(one.turned);
  }
  for (const auto& one : found)
    if ((bounds.sizes().array() > about_as_large * one.bounds.sizes().array()).any()) return;
  common.bounds = bounds;
  if (found[0].dimensions == 2) common.turned = turned;
}

void share_range(const std::vector<view::Survey>& found, Common& common) {
  double low = found[0].low, high = found[0].high;
  for (const auto& one : found) {
    const auto &field = one.field, &first = found[0].field;
    if (field.is_none() || !one.categories.empty() || field.array != first.array || field.part != first.part)
      return;
    low = std::min(low, one.low), high = std::max(high, one.high);
  }
  if (low < high) common.range = {low, high};
}

Common common_to(const std::vector<std::optional<Shot>>& shots, const view::FrameStyle& style, int jobs) {
  std::vector<view::Survey> found;
  Common common;
  for (const auto& shot : shots) {
    if (!shot) continue;
    if (view::are_cells(shot->frames)) return {};
    found.push_back(view::survey(shot->frames, style, {}, jobs));
  }
  if (found.size() < 2) return {};
  share_range(found, common);
  share_view(found, common);
  return common;
}

class Filmer {
 public:
  Filmer(const FilmOptions& options, view::FrameStyle style, const Common& common, std::size_t runs)
      : options_(options),
        style_(std::move(style)),
        common_(common),
        movies_(has_ffmpeg()),
        parts_(static_cast<double>(runs)) {}

  Film film(const Shot& shot) {
    Film made;
    for (std::size_t i = 0; i < shot.frames.size(); i += shot.step)
      made.times.push_back(shot.frames[i].time.value_or(static_cast<double>(i)));
    if (movies_) {
      made.light = movie(shot, view::Background::white, 0.0);
      made.dark = movie(shot, view::Background::dark, 0.45);
    } else {
      made.pictures = pictures(shot, style_, shot.step, 0.0);
    }
    auto style = style_;
    style.background = view::Background::transparent, style.furniture = false;
    style.height = std::max(64, still_width * style.height / style.width), style.width = still_width;
    // The last still is the film's last frame, or nearly: of a short film some are left out rather than its end.
    const std::size_t gaps = shot.count() - 1;
    const std::size_t stride = std::max<std::size_t>(
        1, gaps < 4 * still_count ? (gaps + still_count - 2) / (still_count - 1) : gaps / (still_count - 1));
    auto stills = pictures(shot, style, shot.step * stride, 0.9);
    for (std::size_t k = 0; k < stills.size() && k < still_count; ++k)
      made.stills.push_back({k * stride, std::move(stills[k])});
    done_ += 1;
    return made;
  }
  bool makes_movies() const { return movies_; }

 private:
  const FilmOptions& options_;
  view::FrameStyle style_;
  const Common& common_;
  bool movies_;
  double parts_, done_ = 0;
  ScratchFolder workshop_{"report"};

  view::RenderJob job(const Shot& shot, std::size_t step, double begin, double share) const {
    view::RenderJob job;
    job.source = shot.source, job.style = style_, job.jobs = options_.jobs;
    job.frames.step = step;
    job.also = common_.bounds, job.also_turned = common_.turned;
    job.progress = [this, begin, share](const char*, std::size_t done, std::size_t all) {
      if (options_.progress)
        options_.progress(
            (done_ + begin +
             share * static_cast<double>(done) / static_cast<double>(std::max<std::size_t>(1, all))) /
            parts_);
    };
    return job;
  }

  std::string movie(const Shot& shot, view::Background background, double begin) {
    auto work = job(shot, shot.step, begin, 0.45);
    work.style.background = background;
    work.movie = workshop_.path() / "film.mp4";
    view::render_run(work);
    return read_file(work.movie);
  }

  std::vector<std::string> pictures(const Shot& shot, const view::FrameStyle& style, std::size_t step,
                                    double begin) {
    auto work = job(shot, step, begin, begin > 0 ? 0.1 : 0.9);
    work.style = style;
    work.output = workshop_.path() / "pictures";
    fs::remove_all(work.output);
    view::render_run(work);
    std::vector<std::string> made;
    for (std::size_t i = 0; i < shot.frames.size(); i += step)
      made.push_back(read_file(work.output / fmt::format("{:06}.png", i)));
    return made;
  }
};

}  // namespace

std::vector<Film> make_films(std::span<const RunFiles> runs, const FilmOptions& options) {
  view::FrameStyle style;
  style.width = options.width, style.height = options.height, style.color = options.color;
  const std::size_t most = has_ffmpeg() ? options.frames : std::min(options.frames, most_pictures);
  std::vector<std::optional<Shot>> shots;
  for (const auto& run : runs) {
    const auto source = source_of(run);
    shots.emplace_back();
    if (!source) continue;
    shots.back() = Shot{*source, read::find_frames(*source)};
    shots.back()->step = std::max<std::size_t>(1, (shots.back()->frames.size() + most - 1) / most);
  }
  const auto common = common_to(shots, style, options.jobs);
  style.range = common.range;
  Filmer filmer(options, style, common, runs.size());
  std::vector<Film> films;
  for (const auto& shot : shots) {
    if (shot)
      films.push_back(filmer.film(*shot));
    else
      films.emplace_back().why_none =
          "This run kept no frames; a scene keeps them with output.frames = { every = … }.";
  }
  return films;
}

}  // namespace chute::report
