#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "report/run_files.hpp"

namespace chute::report {

struct FilmOptions {
  int width = 960, height = 540;  ///< pixels
  std::size_t frames = 200;       ///< at most; of a longer run every n-th is taken
  int jobs = 1;
  std::string color;  ///< as `chute render --color`
  /// Hears how much of all films is done, 0 to 1.
  std::function<void(double)> progress;
};

/// What a page shows of the grains: a movie for light and one for dark pages; or single pictures where no ffmpeg is there.
struct Film {
  std::string why_none;               ///< if it is not empty, there is nothing to show, and this says why
  std::string light, dark;            ///< MP4 files
  std::vector<std::string> pictures;  ///< PNG files, in place of the movies
  std::vector<double> times;          ///< of each frame of the movie, or picture
  double frames_per_second = 25;
  struct Still {
    std::size_t frame;  ///< of the film
    std::string png;    ///< on transparent ground
  };
  std::vector<Still> stills;
};

/// A film a run, all with the same colour range where they show the same field. InputError if frames are damaged.
std::vector<Film> make_films(std::span<const RunFiles> runs, const FilmOptions& options);

}  // namespace chute::report
