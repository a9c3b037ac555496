#pragma once
#include <filesystem>
#include <memory>

#include "image/image.hpp"
#include "view/color_map.hpp"

namespace chute::view {

/// A film that ffmpeg makes of pictures as they come: H.264 (.mp4), VP9 (.webm), ProRes (.mov), GIF (.gif) or animated PNG (.png). It
/// appears whole when finish() returns; if it is not finished, nothing is left.
class Movie {
 public:
  enum class Kind { h264, vp9, prores, gif, apng };
  /// InputError if the extension says none of them.
  static Kind kind_of(const std::filesystem::path& path);

  /// `ground` shows through where pictures are transparent and the format knows no transparency. A GIF needs
  /// the palette that a PalettePicker made. `transparent`: pictures are, and ProRes keeps that. WorkError if ffmpeg cannot be started.
  Movie(const std::filesystem::path& path, int width, int height, double frames_per_second, Rgb ground,
        const std::filesystem::path& palette = {}, bool transparent = false);
  ~Movie();

  /// WorkError with what ffmpeg says if it has given up or complained, or if the file is not whole.
  void add(const image::Image& picture);
  void finish();

  /// The end of a film that stays a hidden file, which goes with this object.
  void finish_hidden();
  const std::filesystem::path& hidden_file() const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

/// Chooses the 256 colours of a GIF from some of its pictures; keeps them in a file while it lives.
class PalettePicker {
 public:
  /// `gif` is where the film will be.
  PalettePicker(const std::filesystem::path& gif, int width, int height, Rgb ground);
  void add(const image::Image& picture);
  void finish();
  const std::filesystem::path& file() const { return maker_->hidden_file(); }

 private:
  std::unique_ptr<Movie> maker_;
};

}  // namespace chute::view
