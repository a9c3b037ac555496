#pragma once
#include <filesystem>
#include <memory>

#include "image/image.hpp"
#include "view/color_map.hpp"

namespace chute::view {

/// A film that ffmpeg makes of pictures as they come: H.264 (.mp4), GIF (.gif) or animated PNG (.png). It
/// appears whole when finish() returns; if it is not finished, nothing is left.
class Movie {
 public:
  enum class Kind { h264, gif, apng };
  /// InputError if the extension says none of them.
  static Kind kind_of(const std::filesystem::path& path);

  /// `ground` shows through where pictures are transparent and the format knows no transparency. A GIF needs
  /// the palette that a PalettePicker made. WorkError if ffmpeg cannot be started.
  Movie(const std::filesystem::path& path, int width, int height, double frames_per_second, Rgb ground,
        const std::filesystem::path& palette = {});
  ~Movie();

  /// WorkError with what ffmpeg says if it has given up.
  void add(const image::Image& picture);
  void finish();

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

/// Chooses the 256 colours of a GIF from some of its pictures; keeps them in a file while it lives.
class PalettePicker {
 public:
  /// `beside` is where the GIF will be.
  PalettePicker(const std::filesystem::path& beside, int width, int height, Rgb ground);
  ~PalettePicker();
  void add(const image::Image& picture);
  void finish();
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  std::unique_ptr<Movie> maker_;
};

}  // namespace chute::view
