#include "view/render_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/fields.hpp"
#include "common/hash.hpp"
#include "image/png.hpp"
#include "plot/draw.hpp"
#include "plot/placed.hpp"
#include "read/run_frames.hpp"
#include "read/surroundings.hpp"
#include "view/between.hpp"
#include "view/crew.hpp"
#include "view/frame_renderer.hpp"
#include "view/idle_options.hpp"
#include "view/movie.hpp"
#include "view/render_cells.hpp"
#include "view/walls.hpp"

namespace chute::view {
namespace fs = std::filesystem;
namespace {

// Raised whenever the same data are drawn otherwise than before: old pictures are then drawn again.
constexpr int drawing_version = 7;
constexpr const char* drawn_from = "Drawn-From";

/// Adds a part such that where it ends matters.
void add_part(Hash& hash, std::string_view part) {
  hash.add(fmt::format("{} ", part.size()));
  hash.add(part);
}

bool is_drawn(const fs::path& picture, const std::string& hash) {
  std::error_code error;
  if (!fs::exists(picture, error)) return false;
  try {
    const auto text = image::read_png_text(picture);
    const auto found = text.find(drawn_from);
    return found != text.end() && found->second == hash;
  } catch (const InputError&) {
    return false;  // damaged, or something else: it is replaced
  }
}

/// What a run keeps beside its frames.
struct Beside {
  std::vector<read::WallPiece> walls;
  std::vector<read::Impact> impacts;
  std::string hash;  ///< of both files

  Beside(const RenderJob& job, const std::vector<read::FrameFile>& frames) {
    Hash found;
    const auto take = [&](const char* name) {
      auto path = read::find_beside(frames.front(), name);
      if (!path.empty()) add_part(found, read_file(path));
      return path;
    };
    if (const auto path = take("walls.vtp"); !path.empty()) walls = read::read_walls(path);
    if (job.style.impacts) {
      const auto path = take("impacts.vtp");
      if (path.empty())
        throw InputError(job.source.string() + ": the run kept no impacts.vtp, which marks of impacts need");
      impacts = read::read_impacts(path);
    }
    hash = found.hex();
  }
  /// How many impacts there were until then.
  std::size_t until(double time) const {
    const auto end = std::upper_bound(impacts.begin(), impacts.end(), time,
                                      [](double t, const read::Impact& impact) { return t < impact.time; });
    return static_cast<std::size_t>(end - impacts.begin());
  }
};

/// The arrays that a frame is drawn from, beside radius and type; `between`: and what lies between two.
std::vector<std::string> wanted_arrays(const FrameStyle& style, bool between) {
  std::vector<std::string> names{color_array(style.color), std::string(fields::body.name)};
  if (style.color.empty() || style.arrows || between) names.emplace_back(fields::velocity.name);
  if (style.spin) names.emplace_back(fields::angle.name), names.emplace_back(fields::orientation.name);
  if (style.trail || style.impacts || style.chains || between) names.emplace_back(fields::id.name);
  return names;
}

/// What one picture shows: a frame, or what lies `part` of the way from it to the next one.
struct Moment {
  std::size_t frame;
  double part = 0;
};

/// The moments of a film that shows `speed` of simulated time a second, from the first of these frames to the last.
std::vector<Moment> moments_of(const std::vector<std::size_t>& numbers, const Survey& survey,
                               const RenderJob& job) {
  std::vector<Moment> moments;
  if (job.speed == 0) {
    for (const auto number : numbers) moments.push_back({number});
    return moments;
  }
  const double begin = survey.times[numbers.front()], end = survey.times[numbers.back()];
  const double between = job.speed / job.frames_per_second;
  constexpr double most = 1e6;
  const double count = std::floor((end - begin) / between * (1 + 1e-12)) + 1;
  if (!(count <= most))
    throw InputError(
        fmt::format("speed {}: makes {:.2g} pictures, more than {:.0e}", job.speed, count, most));
  std::size_t frame = numbers.front();
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    const double time = std::min(end, begin + static_cast<double>(k) * between);
    while (frame + 1 < survey.times.size() && survey.times[frame + 1] <= time) ++frame;
    if (frame >= numbers.back()) {
      moments.push_back({numbers.back()});
      continue;
    }
    const double length = survey.times[frame + 1] - survey.times[frame];
    moments.push_back({frame, length > 0 ? (time - survey.times[frame]) / length : 0});
  }
  return moments;
}

/// Pictures between frames need more digits of the time than frames do: as many as tell two of them apart, up to four.
int decimals_between(const Survey& survey, double step) {
  constexpr int most = 4;
  const int needed = static_cast<int>(std::ceil(-std::log10(step) - 1e-9));
  return std::max(survey.time_decimals, std::clamp(needed, 0, most));
}

fs::path picture_path(const RenderJob& job, std::size_t number) {
  constexpr const char* extensions[] = {"png", "pdf", "svg"};
  return job.output / fmt::format("{:06}.{}", number, extensions[static_cast<int>(job.format)]);
}

/// A page whose unit is a pixel as a file in which that is what `dpi` says.
void write_page(const plot::DisplayList& page, const RenderJob& job, const fs::path& path,
                const std::string& source) {
  const double scale = 72 / (job.dpi > 0 ? job.dpi : usual_dpi);
  plot::DisplayList list;
  list.width = scale * page.width, list.height = scale * page.height, list.background = page.background;
  plot::place(list, page, scale, {0, 0});
  const plot::Metadata metadata{{"Title", job.style.title}, {"Creator", "chute"}, {"Subject", source}};
  job.format == StillFormat::pdf ? plot::draw_pdf(list, path, metadata)
                                 : plot::draw_svg(list, path, metadata);
}

/// The only frame of a job, for which reading takes longer than drawing: it is read once, for the survey and the picture.
std::optional<ReadFrame> only_frame(const RenderJob& job, const std::vector<read::FrameFile>& frames) {
  if (frames.size() != 1 || job.style.chains) return {};
  auto wanted = surveyed_arrays(job.style);
  for (auto& name : wanted_arrays(job.style, false)) wanted.push_back(std::move(name));
  ReadFrame only{read::read_files(frames[0]), {}};
  only.frame = read::parse_frame(only.files, job.meanings, wanted);
  return only;
}

/// Draws single frames of a run; one per process. `only` is the frame of a job that has but one, if it was read already.
class FrameDrawer {
 public:
  FrameDrawer(const RenderJob& job, const std::vector<read::FrameFile>& frames, const Survey& survey,
              const Beside& beside, const ReadFrame* only)
      : job_(job),
        frames_(frames),
        survey_(survey),
        beside_(beside),
        only_(only),
        wanted_(wanted_arrays(job.style, job.speed > 0)) {
    Hash common;
    add_part(common, beside.hash);
    add_part(common, fmt::format("drawing {} {} {} {}", drawing_version, job.style.describe(),
                                 survey.describe(), job.meanings.describe()));
    const auto add = [&](const std::vector<double>& values) {
      add_part(common, {reinterpret_cast<const char*>(values.data()), sizeof(double) * values.size()});
    };
    if (!survey.series.empty()) add(survey.series.times);
    for (const auto& column : survey.series.columns) add_part(common, column.name), add(column.values);
    common_ = common.hex();
  }

  /// True if it had to be drawn.
  bool operator()(const Moment& moment, bool wanted, image::Image& into) {
    const std::size_t number = moment.frame;
    const auto& file = frames_[number];
    const std::size_t oldest = number - std::min(number, static_cast<std::size_t>(job_.style.trail));
    for (std::size_t i = oldest; i < number; ++i) load(i);
    std::vector<read::FileBytes> from_disk;
    if (!only_) from_disk = read::read_files(file);
    const auto& files = only_ ? only_->files : from_disk;
    const bool has_network = job_.style.chains && !file.contacts.empty();
    std::vector<read::FileBytes> network;
    if (has_network) network = read::network_bytes(file);

    const fs::path picture = job_.output.empty() ? fs::path() : picture_path(job_, number);
    Hash hash;
    add_part(hash, common_);
    add_part(hash, fmt::format("{} {}", survey_.times[number], job_.dpi));
    for (const auto& part : files) add_part(hash, part.bytes), add_part(hash, part.named);
    add_part(hash, fmt::format("contacts in {} parts", network.size()));
    for (const auto& part : network) add_part(hash, part.bytes), add_part(hash, part.named);
    for (std::size_t i = oldest; i < number; ++i) add_part(hash, earlier_[i - first_earlier_].hash);
    const std::size_t impacts = beside_.until(survey_.times[number]);
    add_part(hash, fmt::format("impacts {}", impacts));
    if (!survey_.path.empty())
      add_part(hash,
               fmt::format("{}", fmt::join(survey_.path[number].begin(), survey_.path[number].end(), " ")));
    const auto drawn_hash = hash.hex();
    const bool is_page = job_.format != StillFormat::png;
    if (!picture.empty() && !is_page && is_drawn(picture, drawn_hash)) {
      if (wanted) into = image::read_png(picture);
      return false;
    }

    if (!renderer_) renderer_ = std::make_unique<FrameRenderer>(job_.style, survey_);
    read::GrainFrame parsed;
    if (!only_) parsed = read::parse_frame(std::move(from_disk), job_.meanings, wanted_);
    const auto& frame = only_ ? only_->frame : parsed;
    double time = survey_.times[number];
    std::vector<read::ForceLink> links;
    if (has_network) links = read::parse_network(std::move(network), job_.meanings, &frame);
    if (moment.part > 0) {
      const auto& next = frames_[number + 1];
      const auto before = std::move(parsed),
                 after = read::parse_frame(read::read_files(next), job_.meanings, wanted_);
      parsed = between(before, after, moment.part);
      Network later{after, {}};
      if (job_.style.chains && !next.contacts.empty())
        later.links = read::parse_network(read::network_bytes(next), job_.meanings, &after);
      links = between({before, std::move(links)}, later, frame, moment.part);
      time += moment.part * (survey_.times[number + 1] - time);
    }
    std::vector<const read::GrainFrame*> trail;
    for (std::size_t i = oldest; i < number; ++i) trail.push_back(&earlier_[i - first_earlier_].frame);
    FrameData data{.frame = frame, .time = time, .links = links, .earlier = trail, .walls = beside_.walls};
    data.impacts = std::span(beside_.impacts).first(moment.part > 0 ? beside_.until(time) : impacts);
    if (!survey_.path.empty()) {
      data.focus = survey_.path[number];
      if (moment.part > 0) data.focus += moment.part * (survey_.path[number + 1] - survey_.path[number]);
    }
    if (is_page) {
      write_page(renderer_->page(data), job_, picture, file.path.filename().string());
      return true;
    }
    const auto& drawn = renderer_->draw(data);
    if (!picture.empty()) {
      const image::Text text{
          {"Software", "chute"}, {"Source", file.path.filename().string()}, {drawn_from, drawn_hash}};
      write_atomically(picture, image::encode_png(drawn, text, image::fast_level, job_.dpi), Flush::later);
    }
    if (wanted) into = drawn;
    return true;
  }

 private:
  struct Earlier {
    read::GrainFrame frame;
    std::string hash;
  };
  const RenderJob& job_;
  const std::vector<read::FrameFile>& frames_;
  const Survey& survey_;
  const Beside& beside_;
  const ReadFrame* only_;
  std::vector<std::string> wanted_;
  std::string common_;  ///< hash of what all frames have in common
  std::unique_ptr<FrameRenderer> renderer_;
  std::deque<Earlier> earlier_;  ///< frames first_earlier_, first_earlier_ + 1 …: trails share most of them
  std::size_t first_earlier_ = 0;

  /// Keeps frame `i`; those too old for its trail go.
  void load(std::size_t i) {
    if (i < first_earlier_ || i > first_earlier_ + earlier_.size()) earlier_.clear();
    if (earlier_.empty()) first_earlier_ = i;
    if (i < first_earlier_ + earlier_.size()) return;
    auto files = read::read_files(frames_[i]);
    Hash hash;
    for (const auto& part : files) add_part(hash, part.bytes), add_part(hash, part.named);
    earlier_.push_back(
        {read::parse_frame(std::move(files), job_.meanings, {std::string(fields::id.name)}), hash.hex()});
    while (earlier_.size() > 2 * static_cast<std::size_t>(job_.style.trail) + 64)
      earlier_.pop_front(), ++first_earlier_;
  }
};

/// How time in the movie goes against the time of the frames: "a second of the movie is 0.2 s: 5 times slower than true".
std::string movie_clock(const Survey& survey, const std::vector<std::size_t>& numbers, double rate,
                        double speed) {
  if (!survey.has_times || numbers.size() < 2) return "";
  const auto step = [&](std::size_t i) { return survey.times[numbers[i + 1]] - survey.times[numbers[i]]; };
  double least = step(0), most = step(0);
  for (std::size_t i = 1; i + 1 < numbers.size(); ++i)
    least = std::min(least, step(i)), most = std::max(most, step(i));
  const double mean = (survey.times[numbers.back()] - survey.times[numbers.front()]) /
                      static_cast<double>(numbers.size() - 1);
  const double second = speed > 0 ? speed : mean * rate;
  if (!(second > 0) || !std::isfinite(second)) return "";
  std::string text = fmt::format("a second of the movie is {:.3g}", second);
  if (!survey.clock.empty()) {
    text += " " + survey.clock;
  } else if (survey.units == "SI") {
    constexpr double same = 0.005;  // relative: told as true
    text += std::abs(second - 1) < same ? " s: as fast as true"
            : second < 1                ? fmt::format(" s: {:.3g} times slower than true", 1 / second)
                                        : fmt::format(" s: {:.3g} times faster than true", second);
  } else {
    text += survey.units == "reduced" ? " sqrt(d/g)" : " in the files' unit of time";
  }
  constexpr double even = 0.01;  // of the mean: what rounded times differ by
  if (speed == 0 && most - least > even * mean)
    text += fmt::format("; frames are {:.3g} to {:.3g} apart and shown equally long", least, most);
  return text;
}

}  // namespace

std::vector<std::size_t> frame_numbers(const FrameRange& range, std::size_t count) {
  if (range.step == 0) throw InputError("frames: the step must be at least 1");
  std::vector<std::size_t> numbers;
  for (std::size_t i = range.first; i < std::min(count, range.end.value_or(count)); i += range.step)
    numbers.push_back(i);
  if (numbers.empty())
    throw InputError(fmt::format("frames: none in that range, the run has {} (from 0)", count));
  return numbers;
}

RenderReport render_run(const RenderJob& asked) {
  RenderJob job = asked;
  job.style.check();
  if (job.output.empty() && job.movie.empty())
    throw InputError("neither a folder for pictures nor a movie is asked for");
  if (!(job.frames_per_second > 0 && job.frames_per_second <= 1000))
    throw InputError(fmt::format("{} frames per second: must be in (0, 1000]", job.frames_per_second));
  if (job.format != StillFormat::png && !job.movie.empty())
    throw InputError("pictures that are kept beside a movie are its frames, as PNG");
  if (job.dpi != 0 && !(job.dpi >= 10 && job.dpi <= 10000))
    throw InputError(fmt::format("{} dpi: must be in [10, 10000]", job.dpi));
  if (job.speed != 0 && !(job.speed > 0 && std::isfinite(job.speed)))
    throw InputError(fmt::format("speed {}: must be > 0", job.speed));
  if (job.speed != 0 && (job.movie.empty() || !job.output.empty()))
    throw InputError("--speed is of a movie; pictures are those of the frames");
  if (job.jobs < 1 || job.jobs > 1024)
    throw InputError(fmt::format("{} jobs: must be in [1, 1024]", job.jobs));
  if (const auto& r = job.meanings.radius; r && !(*r > 0))
    throw InputError(fmt::format("radius {}: must be > 0", *r));
  const bool is_gif = !job.movie.empty() && Movie::kind_of(job.movie) == Movie::Kind::gif;

  auto frames = read::find_frames(job.source);
  if (!job.contacts.empty()) read::attach_networks(frames, job.contacts);
  const auto numbers = frame_numbers(job.frames, frames.size());
  if (are_cells(frames) && job.speed > 0)
    throw InputError("--speed does nothing here: maps are not drawn between their times");
  if (are_cells(frames)) {
    check_map_options(job.style, !job.plot.empty());
    return render_cells(job, frames, numbers);
  }
  if (job.style.chains &&
      std::all_of(frames.begin(), frames.end(), [](const auto& f) { return f.contacts.empty(); }))
    throw InputError(
        job.source.string() +
        ": no contact networks are there, which force chains are drawn from; --contacts names files of them");
  const auto tell = [&](const char* what, std::size_t done, std::size_t all) {
    if (job.progress) job.progress(what, done, all);
  };
  TimeSeries series;
  if (!job.plot.empty())
    series = read_time_series(job.series.empty() ? job.source / "series.csv" : job.series, job.plot);
  const auto only = only_frame(job, frames);
  const auto is_read = [&](std::size_t done) { tell("reading", done, frames.size()); };
  Survey found = only ? survey(*only, frames[0].time, job.style)
                      : survey(frames, job.style, job.meanings, job.jobs, is_read);
  if (!job.style.camera_keys.empty() && !found.has_times)
    throw InputError(job.source.string() + ": the frames have no times, which --camera-at needs");
  if (job.speed > 0 && !found.has_times)
    throw InputError(job.source.string() + ": the frames have no times, which --speed needs");
  const auto moments = moments_of(numbers, found, job);
  if (job.speed > 0) found.time_decimals = decimals_between(found, job.speed / job.frames_per_second);
  if (!series.empty() && !found.has_times)
    throw InputError(job.source.string() + ": the frames have no times, which a plot beside them needs");
  found.series = std::move(series);
  const Beside beside(job, frames);
  if (!job.style.camera.all && !job.style.copies) include_walls(found, beside.walls);
  found.bounds.extend(job.also), found.turned.extend(job.also_turned);
  check_options(job.style, found);
  if (has_round_wall(beside.walls) && !job.style.floor) job.style.floor = false;
  if (!job.style.box && stand_around(beside.walls, found.bounds)) job.style.box = false;
  if (found.dimensions == 3) furnish_space(job.style, found);
  if (!job.output.empty()) {
    std::error_code error;
    fs::create_directories(job.output, error);
    if (error) throw WorkError(fmt::format("{}: cannot be made: {}", job.output.string(), error.message()));
    remove_leftovers(job.output);
  }
  // Pictures are flushed to the disk at the end, all at once: one that a power cut spoilt would be drawn again.
  const auto flush = [&] {
    if (job.output.empty()) return;
    for (const auto number : numbers) flush_file(picture_path(job, number));
    flush_folder(job.output);
  };

  RenderReport report;
  report.left_out = found.left_out;
  report.notes = idle_options(job.style, found);
  if (!job.style.camera.window && !job.style.camera.follow && job.style.camera_keys.empty())
    report.outside = found.outside, report.about = found.about;
  for (const auto& frame : frames)
    if (frame.piece && !frame.piece->cut_after.empty())
      report.notes.push_back(frame.piece->cut_after + "; that frame is left out");
  if (!job.movie.empty())
    if (auto note = movie_clock(found, numbers, job.frames_per_second, job.speed); !note.empty())
      report.notes.push_back(std::move(note));
  const auto& style = job.style;
  const auto draw = [&](const std::vector<Moment>& which, bool wanted, const Take& take) {
    draw_all(
        which.size(), job.jobs, style.width, style.height, wanted,
        [&]() -> Draw {
          auto drawer = std::make_shared<FrameDrawer>(job, frames, found, beside, only ? &*only : nullptr);
          return [drawer, &which](std::size_t i, bool pixels, image::Image& into) {
            return (*drawer)(which[i], pixels, into);
          };
        },
        take);
  };
  const auto count = [&](std::size_t i, bool drawn) {
    ++(drawn ? report.drawn : report.kept);
    tell("drawing", i + 1, moments.size());
  };
  if (job.movie.empty()) {
    draw(moments, false, [&](std::size_t i, bool drawn, const image::Image&) { count(i, drawn); });
    flush();
    return report;
  }

  const Rgb ground = palette_of(style.background).ground;
  std::unique_ptr<PalettePicker> palette;
  if (is_gif) {  // its colours come from up to a dozen frames, evenly spread
    palette = std::make_unique<PalettePicker>(job.movie, style.width, style.height, ground);
    std::vector<Moment> some;
    const std::size_t all = moments.size(), samples = std::min<std::size_t>(all, 12);
    for (std::size_t k = 0; k < samples; ++k)
      some.push_back(moments[samples > 1 ? k * (all - 1) / (samples - 1) : 0]);
    draw(some, true, [&](std::size_t, bool, const image::Image& picture) { palette->add(picture); });
    palette->finish();
  }
  // Delays in a GIF count hundredths of a second, and browsers play one below 2 as 10: of more frames a second some are
  // left out, so that the whole lasts as long.
  constexpr double fastest_gif = 50;
  const auto stride = is_gif ? static_cast<std::size_t>(std::ceil(job.frames_per_second / fastest_gif - 1e-9))
                             : std::size_t{1};
  Movie movie(job.movie, style.width, style.height, job.frames_per_second / static_cast<double>(stride),
              ground, palette ? palette->file() : fs::path(), style.background == Background::transparent);
  draw(moments, true, [&](std::size_t i, bool drawn, const image::Image& picture) {
    if (i % stride == 0)
      movie.add(picture);
    else
      ++report.skipped;
    count(i, drawn);
  });
  flush();
  movie.finish();
  return report;
}

}  // namespace chute::view
