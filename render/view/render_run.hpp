#pragma once
#include <Eigen/Geometry>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "read/meanings.hpp"
#include "view/frame_style.hpp"

namespace chute::view {

/// The frames first, first + step … below `end` of a run.
struct FrameRange {
  std::size_t first = 0;
  std::optional<std::size_t> end;
  std::size_t step = 1;
};

/// What files pictures become. In PDF and SVG texts are texts, and grains in the plane are curves.
enum class StillFormat { png, pdf, svg };

/// What is to be drawn of a run.
struct RenderJob {
  std::filesystem::path source;  ///< see read::find_frames
  FrameStyle style;
  std::filesystem::path output;  ///< folder for NNNNNN.png; empty: no pictures are kept
  StillFormat format = StillFormat::png;
  double dpi = 0;  ///< pixels of an inch in print; 0: PNG files do not say it, pages have usual_dpi
  std::filesystem::path movie;  ///< .mp4, .webm, .mov, .gif or .png; empty: none
  double frames_per_second = 25;
  double speed =
      0;  ///< of a movie: simulated time in a second of it, drawn between frames where needed; 0: a frame a picture
  FrameRange frames;
  int jobs = 1;  ///< processes that draw at once
  std::filesystem::path
      contacts;             ///< networks of another program (read::attach_networks); empty: the run's own
  read::Meanings meanings;  ///< what arrays of other programs' files are
  std::vector<std::string> plot;  ///< columns of `series` that are plotted against time beside the grains
  std::filesystem::path series;   ///< empty: the run's series.csv
  /// To be seen, too, so that several runs are seen alike: as Survey::bounds and Survey::turned.
  Eigen::AlignedBox3d also;
  Eigen::AlignedBox2d also_turned;
  /// Hears what is being done ("reading", "drawing"), how much of it is done and how much there is.
  std::function<void(const char*, std::size_t, std::size_t)> progress;
};

/// Of a page: a pixel of the web.
inline constexpr double usual_dpi = 96;

struct RenderReport {
  std::size_t drawn = 0;
  std::size_t kept = 0;            ///< pictures that were there already, drawn from the same
  std::size_t skipped = 0;         ///< frames that a GIF of more than 50 a second leaves out
  std::size_t left_out = 0;        ///< grains of all frames together that have no place or no size
  std::size_t outside = 0;         ///< grains of all frames together that the view does not show
  bool about = false;              ///< that number was estimated
  std::vector<std::string> notes;  ///< one line each: what was not read, how fast the movie is
};

/// Draws a run: looks at all frames once for what must not change (colour range, camera), then draws those
/// asked for. Pictures that exist and were drawn from the same files in the same style are kept. The same
/// bytes whatever `jobs` says. InputError for a wrong file, style or range; WorkError if something fails; no
/// half-written file is left.
RenderReport render_run(const RenderJob& job);

/// The numbers of the frames in `range` of `count`; InputError if there are none.
std::vector<std::size_t> frame_numbers(const FrameRange& range, std::size_t count);

}  // namespace chute::view
