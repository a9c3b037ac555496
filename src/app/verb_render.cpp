#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <tuple>

#include "app/file_meanings.hpp"
#include "app/interrupt.hpp"
#include "app/numbers.hpp"
#include "app/progress.hpp"
#include "app/say.hpp"
#include "app/verbs.hpp"
#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/file_lock.hpp"
#include "common/toml_reader.hpp"
#include "view/render_run.hpp"

namespace chute::app {
namespace {

struct RenderArguments {
  std::string run, output, movie, color, range, map, size, frames, camera, background = "white", series, up;
  std::string title, time;
  double time_scale = 1, font_size = 0, opacity = 1, copy_reach = 0.16;
  std::optional<double> dpi;
  std::string format = "png";
  std::vector<std::string> camera_at;
  FileMeanings meanings;
  std::string contacts;
  std::vector<std::string> species, force, ends;
  std::vector<std::string> plot;
  double fps = 25, speed = 0;
  int jobs = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 16u));
  int trails = 0;
  std::vector<std::string> cuts;
  bool tilt = false, arrows = false, chains = false, copies = false, impacts = false, occlusion = false,
       no_spin = false, bare = false, follow = false, quiet = false, fps_given = false;
  std::optional<bool> outlines, floor, box;
};

/// `follow`, `follow:mean`, `follow:ID`; false if it is something else.
bool read_follow(const std::string& text, view::Camera& camera) {
  const std::string word = "follow";
  if (!text.starts_with(word)) return false;
  const std::string whom = text.substr(word.size());
  view::Follow follow;
  if (!whom.empty() && whom != ":mean") {
    long long id = 0;
    const char* const end = whom.data() + whom.size();
    const auto [stop, error] = std::from_chars(whom.data() + 1, end, id);
    require(whom[0] == ':' && error == std::errc() && stop == end, "--camera", text,
            "follow, follow:mean or follow:ID with the id of a grain");
    follow.id = id;
  }
  camera.follow = follow;
  return true;
}

void read_camera(const std::string& text, view::Camera& camera) {
  if (text == "all") {
    camera.all = true;
    return;
  }
  if (const auto comma = text.find(','); comma != std::string::npos) {
    read_camera(text.substr(0, comma), camera), read_camera(text.substr(comma + 1), camera);
    return;
  }
  if (read_follow(text, camera)) return;
  constexpr const char* expected =
      "X0:X1:Y0:Y1 (the part of a plane that is shown), AZIMUTH:ELEVATION[:ZOOM] (degrees, in space), "
      "all, follow[:ID|mean], or one of the first two and the last with a comma between";
  const auto values = numbers("--camera", text, ':', expected);
  require(values.size() >= 2 && values.size() <= 4 && all_given(values), "--camera", text, expected);
  if (values.size() == 4) {
    camera.window = {values[0], values[1], values[2], values[3]};
  } else {
    camera.azimuth = values[0], camera.elevation = values[1];
    if (values.size() == 3) camera.zoom = values[2];
  }
}

/// `12.5=30:20:1.5`: where the camera is at that time.
view::CameraKey read_camera_key(const std::string& text) {
  constexpr const char* expected = "TIME=X0:X1:Y0:Y1 in the plane, TIME=AZIMUTH:ELEVATION[:ZOOM] in space";
  const auto equals = text.find('=');
  require(equals != std::string::npos, "--camera-at", text, expected);
  const auto time = numbers("--camera-at", text.substr(0, equals), ':', expected);
  view::CameraKey key;
  require(time.size() == 1 && all_given(time), "--camera-at", text, expected);
  key.time = time[0];
  read_camera(text.substr(equals + 1), key.camera);
  require(!key.camera.follow && !key.camera.all, "--camera-at", text, expected);
  return key;
}

/// `z`, `-y`, `0.2:0:1`.
Eigen::Vector3d read_up(const std::string& text) {
  constexpr const char* expected = "x, y, z, -x, -y, -z or X:Y:Z";
  const std::string_view axis = std::string_view(text).substr(text.starts_with('-') ? 1 : 0);
  if (const auto k = std::string_view("xyz").find(axis); axis.size() == 1 && k != std::string_view::npos)
    return (text.starts_with('-') ? -1.0 : 1.0) * Eigen::Vector3d::Unit(static_cast<int>(k));
  const auto values = numbers("--up", text, ':', expected);
  require(values.size() == 3 && all_given(values), "--up", text, expected);
  return {values[0], values[1], values[2]};
}

/// `x>3`, `z<0.5`: what lies there is cut away.
view::Cut read_cut(const std::string& text) {
  constexpr const char* expected = "x, y or z, then > or <, then a number, such as x>3";
  const auto axis = std::string_view("xyz").find(text.empty() ? ' ' : text[0]);
  require(text.size() > 2 && axis != std::string_view::npos && (text[1] == '>' || text[1] == '<'), "--cut",
          text, expected);
  const auto values = numbers("--cut", text.substr(2), ',', expected);
  require(values.size() == 1 && std::isfinite(values[0]), "--cut", text, expected);
  return {static_cast<int>(axis), text[1] == '>', values[0]};
}

view::FrameRange read_frames(const std::string& text) {
  constexpr const char* expected =
      "FIRST:END:STEP, whole numbers, END not included; any may be left out, such as 100: or ::10";
  const auto values = numbers("--frames", text, ':', expected);
  for (const double x : values)
    require(std::isnan(x) || (x >= 0 && x == std::floor(x) && x < 1e9), "--frames", text, expected);
  require(values.size() <= 3, "--frames", text, expected);
  view::FrameRange range;
  if (!std::isnan(values[0])) range.first = static_cast<std::size_t>(values[0]);
  if (values.size() == 1) range.end = range.first + 1;  // one frame
  if (values.size() > 1 && !std::isnan(values[1])) range.end = static_cast<std::size_t>(values[1]);
  if (values.size() > 2 && !std::isnan(values[2])) range.step = static_cast<std::size_t>(values[2]);
  return range;
}

view::RenderJob job_of(const RenderArguments& a) {
  view::RenderJob job;
  job.source = a.run;
  auto& style = job.style;
  if (!a.size.empty()) std::tie(style.width, style.height) = read_size(a.size, a.dpi.value_or(0));
  style.color = a.color, style.map = a.map;
  if (!a.range.empty()) {
    const auto values = numbers("--range", a.range, ':', "LOW:HIGH");
    require(values.size() == 2 && all_given(values), "--range", a.range, "LOW:HIGH");
    style.range = {values[0], values[1]};
  }
  if (!a.camera.empty()) read_camera(a.camera, style.camera);
  for (const auto& key : a.camera_at) style.camera_keys.push_back(read_camera_key(key));
  std::sort(style.camera_keys.begin(), style.camera_keys.end(),
            [](const auto& one, const auto& other) { return one.time < other.time; });
  if (!a.frames.empty()) job.frames = read_frames(a.frames);
  style.background =
      static_cast<view::Background>(choice("--background", a.background, {"white", "dark", "transparent"}));
  style.tilt = a.tilt, style.arrows = a.arrows, style.chains = a.chains || style.colors_forces();
  style.copies = a.copies || a.copy_reach != style.copy_reach, style.copy_reach = a.copy_reach;
  style.opacity = a.opacity;
  style.impacts = a.impacts, style.outlines = a.outlines, style.floor = a.floor, style.box = a.box;
  for (const auto& cut : a.cuts) style.cuts.push_back(read_cut(cut));
  style.occlusion = a.occlusion, style.spin = !a.no_spin, style.furniture = !a.bare, style.trail = a.trails;
  job.movie = a.movie, job.output = a.output;
  job.format = static_cast<view::StillFormat>(choice("--format", a.format, {"png", "pdf", "svg"}));
  if (a.dpi == 0.0) throw InputError("0 dpi: must be in [10, 10000]");  // to a job that means none is told
  job.dpi = a.dpi.value_or(0);
  job.frames_per_second = a.fps, job.jobs = a.jobs;
  job.meanings = a.meanings.read();
  auto& meanings = job.meanings;
  meanings.force = a.force, meanings.ends = a.ends;
  require(a.ends.empty() || a.ends.size() == 2 || a.ends.size() == 4 || a.ends.size() == 6, "--ends",
          fmt::format("{}", fmt::join(a.ends, ",")),
          "the two columns of ids, or the four or six of places: X1,Y1,Z1,X2,Y2,Z2");
  if (a.contacts.empty() && (!a.force.empty() || !a.ends.empty()))
    throw InputError("--force and --ends say what columns of --contacts are");
  job.contacts = a.contacts, style.chains = style.chains || !a.contacts.empty();
  style.species = a.species;
  style.title = a.title, style.time = a.time, style.time_scale = a.time_scale, style.font_size = a.font_size;
  if (!a.up.empty()) style.up = read_up(a.up);
  job.speed = a.speed;
  if (a.time_scale != 1 && (a.time.empty() || a.time == "none"))
    throw InputError("--time-scale: say with --time what the time is in then, such as --time \"t = {} ms\"");
  if (a.fps_given && a.movie.empty()) throw InputError("--fps is of a movie; name one with --movie");
  if (a.bare && !a.plot.empty())
    throw InputError("--bare draws the grains alone, --plot a curve beside them");
  if (a.bare && (!a.title.empty() || !a.time.empty()))
    throw InputError("--bare draws the grains alone, without --title and --time");
  if (!a.series.empty() && a.plot.empty()) throw InputError("--series: say with --plot which of its columns");
  job.plot = a.plot, job.series = a.series;
  std::error_code error;
  if (a.output.empty() && a.movie.empty())
    job.output = std::filesystem::is_directory(job.source, error) ? job.source / "pictures" : "out/pictures";
  return job;
}

/// Is there a run going on in the folder?
bool is_running(const std::filesystem::path& run) {
  try {
    return nlohmann::json::parse(read_file(run / "run.json")).value("end", "") == "running" &&
           FolderLock::is_held(run);
  } catch (const std::exception&) {
    return false;
  }
}

std::size_t frames_of(const std::filesystem::path& run) {
  const auto index = run / "frames.pvd";
  return std::filesystem::exists(index) ? read_file(index).size() : 0;
}

void draw(const RenderArguments& a) {
  auto job = job_of(a);
  // Stopped between two frames, so that no part of a movie stays behind.
  watch_for_interrupt();
  Progress reading("read", a.quiet), drawing("render", a.quiet);
  job.progress = [&](const char* what, std::size_t done, std::size_t all) {
    const bool reads = std::string_view(what) == "reading";
    (reads ? reading : drawing)
        .show(static_cast<double>(done) / static_cast<double>(all), fmt::format("{} of {}", done, all));
    if (interrupted())
      throw WorkError(job.output.empty() ? "stopped; no movie was made"
                                         : "stopped; the same command goes on from there");
  };
  const auto report = view::render_run(job);
  if (a.quiet) return;
  if (report.left_out > 0)
    tell("render: left out {} grain{} (of all frames) without a place or a radius > 0\n", report.left_out,
         report.left_out == 1 ? "" : "s");
  if (report.outside > 0)
    tell("render: {}{} grain{} (of all frames) out of view; --camera all shows every one\n",
         report.about ? "about " : "", report.outside, report.outside == 1 ? "" : "s");
  for (const auto& note : report.notes) tell("render: {}\n", note);
  if (report.skipped > 0)
    tell("render: the movie leaves out {} frames: a GIF shows 50 a second at most\n", report.skipped);
  const auto kept = report.kept ? fmt::format(", {} were there", report.kept) : "";
  const auto where = job.output.empty() ? job.movie : job.output;
  tell("render: {} frame{} drawn{}; in {}\n", report.drawn, report.drawn == 1 ? "" : "s", kept,
       where.string());
}

/// Draws what is there, and then what comes, until the run ends. Where the colours' range grows, all is drawn again in it;
/// --range keeps it.
void follow(const RenderArguments& a) {
  if (!a.movie.empty()) throw InputError("--follow draws pictures: make the movie when the run has ended");
  if (!std::filesystem::exists(std::filesystem::path(a.run) / "run.json"))
    throw InputError(fmt::format("{}: --follow needs a run directory", a.run));
  watch_for_interrupt();
  constexpr auto pause = std::chrono::milliseconds(500);
  std::size_t drawn = 0;
  for (;;) {
    const bool last = !is_running(a.run);  // asked first: nothing comes after
    const auto there = frames_of(a.run);
    if (there != drawn || (last && drawn == 0)) draw(a);
    drawn = there;
    if (last && frames_of(a.run) == drawn) return;
    if (interrupted()) throw WorkError("stopped; the same command goes on from there");
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace

void add_render(CLI::App& app) {
  auto* verb = app.add_subcommand("render", "Draw the frames of a run as pictures or a movie");
  auto a = std::make_shared<RenderArguments>();
  verb->add_option(
          "run", a->run,
          "run directory; or VTK files of grains or of cells (.vti, .pvti), dumps of LAMMPS or XYZ files (also .gz, .zst), chute's or "
          "another engine's: a directory, a time index (.pvd), one file, or a pattern in quotes")
      ->required();
  verb->add_option("-o,--output", a->output,
                   "folder for NNNNNN.png; default RUN/pictures, none with --movie");
  verb->add_option(
      "--movie", a->movie,
      "make a movie: .mp4 (H.264), .webm (VP9), .mov (ProRes), .gif or .png (animated); needs ffmpeg");
  auto* fps = verb->add_option("--fps", a->fps, "frames of the movie per second")->capture_default_str();
  verb->add_option(
          "--speed", a->speed,
          "simulated time in a second of the movie: 0.25 is slow motion in reduced units; what lies between frames "
          "is drawn between them; default a frame a picture")
      ->check(positive);
  verb->add_option("--color", a->color,
                   "array that colours the grains, with :x, :y, :z or :magnitude for one component; none; "
                   "chains: forces, which chains tell; default the speed, else the species");
  verb->add_option("--range", a->range, "colour range LOW:HIGH; default from the whole run");
  verb->add_option("--colormap", a->map, "viridis, batlow, cividis, rdbu, or one of them with _r, reversed");
  verb->add_option("--size", a->size,
                   "pixels, WIDTHxHEIGHT, or with --dpi WIDTHxHEIGHTmm; default 1920x1080");
  verb->add_option("--format", a->format,
                   "of pictures: png; pdf or svg, in which texts are texts, and grains in the plane curves")
      ->capture_default_str();
  verb->add_option(
      "--dpi", a->dpi,
      "pixels of an inch in print, which files then say: sizes may be in mm; pages default to 96");
  verb->add_option("--frames", a->frames, "one frame, or FIRST:END:STEP with END not included");
  verb->add_option(
      "--camera", a->camera,
      "X0:X1:Y0:Y1 in the plane, AZIMUTH:ELEVATION[:ZOOM] in space; default shows nearly all grains, all every "
      "one. Also, or after a comma, follow[:ID|mean]: it goes along with a grain or the mean");
  verb->add_option(
      "--camera-at", a->camera_at,
      "TIME=X0:X1:Y0:Y1 or TIME=AZIMUTH:ELEVATION[:ZOOM], several times: the camera goes smoothly "
      "from one to the next");
  verb->add_option(
      "--up", a->up,
      "which way is up, x, y, z, -x …, or X:Y:Z; default against gravity, else across the thinnest spread of grains in space");
  verb->add_option("--title", a->title,
                   "a line above the picture, in the TeX of figures: \"$\\theta = 18\\degree$\"");
  verb->add_option(
      "--time", a->time,
      "the line that tells the time, such as \"t = {:.1f} ms\", in the TeX of figures: {} or {:.1f} "
      "is where it stands; none for no such line");
  verb->add_option("--time-scale", a->time_scale, "what the time is multiplied by there: 1000 for ms");
  verb->add_option("--font-size", a->font_size, "pixels, of all type; default by the size of the picture")
      ->check(CLI::Range(6.0, 200.0));
  verb->add_option("--background", a->background, "white, dark or transparent")->capture_default_str();
  verb->add_flag("--tilt", a->tilt, "turn the picture so that gravity points down");
  verb->add_flag("--arrows", a->arrows, "velocity arrows");
  verb->add_flag("--chains", a->chains,
                 "contact forces as lines, wide where strong (needs the run's contacts)");
  verb->add_flag("--copies", a->copies, "faded copies beyond the periodic ends");
  verb->add_option("--copies-reach", a->copy_reach, "so many periods of them to each side")
      ->capture_default_str();
  verb->add_option("--opacity", a->opacity,
                   "of grains that move: below 1 each covers this share of what lies behind it")
      ->check(CLI::Range(0.01, 1.0));
  verb->add_flag("--impacts", a->impacts, "marks where beads of the bed were hit so far (needs impacts.vtp)");
  verb->add_option("--cut", a->cuts,
                   "leave out grains beyond a place: x>VALUE, z<VALUE; several are possible")
      ->delimiter(',');
  verb->add_flag("--occlusion", a->occlusion, "ambient occlusion (in space)");
  const auto usual_in_space = [verb](const char* names, std::optional<bool>& given, const char* text) {
    verb->add_flag_function(
        names, [&given](std::int64_t n) { given = n > 0; },
        std::string(text) + " (in space, where it is usual but with --bare)");
  };
  usual_in_space("--outlines,!--no-outlines", a->outlines, "a dark rim around every grain");
  usual_in_space("--floor,!--no-floor", a->floor, "shadows on a floor below");
  usual_in_space("--box,!--no-box", a->box, "edges of the periodic box");
  verb->add_option("--trails", a->trails, "draw where each grain was in the N frames before");
  verb->add_option(
          "--plot", a->plot,
          "columns of the run's series.csv, such as v_x or translation,rotation: plotted against time "
          "beside the grains, drawn up to the frame's time")
      ->delimiter(',');
  verb->add_option("--series", a->series, "another table for --plot, with a column time");
  verb->add_flag("--no-spin", a->no_spin, "no marks that turn with the grains");
  verb->add_flag("--bare", a->bare, "the grains alone: no colour bar, time, scale and gravity");
  a->meanings.add_options(*verb);
  verb->add_option(
      "--contacts", a->contacts,
      "files of contacts of another program, whose forces are drawn as chains: VTK, CSV, or a dump "
      "local of LAMMPS; a folder, an index of times, one file, or a pattern in quotes");
  verb->add_option("--force", a->force, "column of their strength, or its components: FX,FY,FZ")
      ->delimiter(',');
  verb->add_option("--ends", a->ends,
                   "columns of the ids of the two grains, A,B, or of their places: X1,Y1,Z1,X2,Y2,Z2")
      ->delimiter(',');
  verb->add_option("--species", a->species,
                   "names of the species, in the order of their numbers: glass,steel")
      ->delimiter(',');
  verb->add_option("-j,--jobs", a->jobs, "processes that draw at once; the pictures are the same")
      ->capture_default_str();
  verb->add_flag("--follow", a->follow,
                 "of a run that is going on: draw its frames as they come, to its end");
  verb->add_flag("--quiet", a->quiet, "no progress");
  verb->footer(
      "Pictures that are there and were drawn from the same data in the same style are kept.\n"
      "Example: chute render out/chute-2d --tilt --plot v_x --movie chute.mp4");
  verb->callback([a, fps] {
    a->fps_given = fps->count() > 0;
    a->follow ? follow(*a) : draw(*a);
  });
}

}  // namespace chute::app
