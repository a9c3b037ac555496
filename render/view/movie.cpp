#include "view/movie.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "view/encoder.hpp"

namespace chute::view {
namespace fs = std::filesystem;
namespace {

using Words = std::vector<std::string>;

Words input_words(int width, int height, double rate) {
  // clang-format off
  return {"ffmpeg",
          "-nostdin",
          "-hide_banner",
          "-loglevel", "error",
          "-y",
          "-f", "rawvideo",
          "-pixel_format", "rgba",
          "-video_size", fmt::format("{}x{}", width, height),
          "-framerate", fmt::format("{}", rate),
          "-i", "pipe:0"};
  // clang-format on
}

std::string hex(Rgb ground) {
  const auto byte = [](double share) { return static_cast<int>(std::lround(255 * share)); };
  return fmt::format("0x{:02x}{:02x}{:02x}", byte(ground.r), byte(ground.g), byte(ground.b));
}

/// Colours are sampled at half the size: sides must be even, and what is added is the ground. BT.709, said in the file, so that players
/// show the colours that were drawn.
std::string filter(Rgb ground, const char* format) {
  return fmt::format(
      "pad=ceil(iw/2)*2:ceil(ih/2)*2:0:0:{},scale=out_color_matrix=bt709:out_range=tv"
      ":flags=accurate_rnd+full_chroma_int+full_chroma_inp,format={}",
      hex(ground), format);
}

/// What all films of full colours say about them. No versions or times in the file.
Words colour_words() {
  // clang-format off
  return {"-colorspace", "bt709",
          "-color_primaries", "bt709",
          "-color_trc", "iec61966-2-1",
          "-color_range", "tv",
          "-fflags", "+bitexact",
          "-flags:v", "+bitexact"};
  // clang-format on
}

// As many threads everywhere, since they change the bytes.
Words h264_words(Rgb ground) {
  // clang-format off
  Words words{"-vf", filter(ground, "yuv420p"),
              "-c:v", "libx264",
              "-preset", "medium",
              "-crf", "19",
              "-tune", "animation",
              "-threads", "4"};
  // clang-format on
  for (const auto& word : colour_words()) words.push_back(word);
  words.insert(words.end(), {"-movflags", "+faststart", "-f", "mp4"});
  return words;
}

/// VP9 in WebM, which every browser plays, and free to use.
Words vp9_words(Rgb ground) {
  // clang-format off
  Words words{"-vf", filter(ground, "yuv420p"),
              "-c:v", "libvpx-vp9",
              "-crf", "24",
              "-b:v", "0",
              "-deadline", "good",
              "-cpu-used", "3",
              "-row-mt", "1",
              "-threads", "4"};
  // clang-format on
  for (const auto& word : colour_words()) words.push_back(word);
  words.insert(words.end(), {"-f", "webm"});
  return words;
}

/// ProRes 422 HQ, for those who cut films; 4444 where pictures are transparent.
Words prores_words(Rgb ground, bool transparent) {
  // clang-format off
  Words words{"-vf", transparent ? std::string("pad=ceil(iw/2)*2:ceil(ih/2)*2:0:0:black@0,scale=out_color_matrix=bt709:out_range=tv"
                                               ":flags=accurate_rnd+full_chroma_int,format=yuva444p10le")
                                 : filter(ground, "yuv422p10le"),
              "-c:v", "prores_ks",
              "-profile:v", transparent ? "4" : "3",
              "-vendor", "apl0",
              "-threads", "4"};
  // clang-format on
  for (const auto& word : colour_words()) words.push_back(word);
  words.insert(words.end(), {"-movflags", "+faststart", "-f", "mov"});
  return words;
}

/// A number of one byte or more as EBML writes it; -1 if there is none, or it says that the length is unknown.
std::int64_t ebml_size(std::string_view bytes, std::size_t& at) {
  if (at >= bytes.size()) return -1;
  const auto first = static_cast<unsigned char>(bytes[at]);
  std::size_t length = 1;
  while (length <= 8 && !(first & (0x100U >> length))) ++length;
  if (length > 8 || at + length > bytes.size()) return -1;
  std::uint64_t value = first & ((0x100U >> length) - 1U);
  bool unknown = value == (0x100U >> length) - 1U;
  for (std::size_t i = 1; i < length; ++i) {
    const auto byte = static_cast<unsigned char>(bytes[at + i]);
    value = value << 8U | byte, unknown = unknown && byte == 0xff;
  }
  at += length;
  return unknown ? -1 : static_cast<std::int64_t>(value);
}

/// The head of a WebM file, and a segment of known length that fills the rest: ffmpeg writes that length last.
bool is_whole_webm(std::string_view bytes) {
  for (const std::string_view id : {"\x1a\x45\xdf\xa3", "\x18\x53\x80\x67"}) {
    if (!bytes.starts_with(id)) return false;
    std::size_t at = id.size();
    const auto size = ebml_size(bytes, at);
    if (size < 0 || static_cast<std::uint64_t>(size) > bytes.size() - at) return false;
    bytes.remove_prefix(at + static_cast<std::size_t>(size));
  }
  return bytes.empty();
}

/// Top-level boxes of an MP4 file fill it exactly, and the index and the pictures are among them.
bool is_whole_mp4(std::string_view bytes) {
  bool has_index = false, has_pictures = false;
  while (bytes.size() >= 8) {
    const auto number = [&](std::size_t from, std::size_t digits) {
      std::uint64_t value = 0;
      for (std::size_t i = 0; i < digits; ++i)
        value = value << 8 | static_cast<unsigned char>(bytes[from + i]);
      return value;
    };
    std::uint64_t size = number(0, 4);
    if (size == 1 && bytes.size() >= 16) size = number(8, 8);
    if (size < 8 || size > bytes.size()) return false;
    has_index = has_index || bytes.substr(4, 4) == "moov";
    has_pictures = has_pictures || bytes.substr(4, 4) == "mdat";
    bytes.remove_prefix(size);
  }
  return bytes.empty() && has_index && has_pictures;
}

/// Does a file end as its kind does? A program that ran out of disk may not have noticed.
bool is_whole(Movie::Kind kind, const fs::path& file) {
  const auto bytes = read_file(file);
  if (kind == Movie::Kind::h264 || kind == Movie::Kind::prores) return is_whole_mp4(bytes);
  if (kind == Movie::Kind::vp9) return is_whole_webm(bytes);
  if (kind == Movie::Kind::gif) return bytes.starts_with("GIF8") && bytes.ends_with('\x3b');
  return bytes.ends_with(std::string_view("\0\0\0\0IEND\xae\x42\x60\x82", 12));
}

void over_ground(image::Image& picture, Rgb ground) {
  const double rgb[3] = {255 * ground.r, 255 * ground.g, 255 * ground.b};
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    const double alpha = picture.rgba[i + 3] / 255.0;
    if (alpha == 1) continue;
    for (std::size_t c = 0; c < 3; ++c)
      picture.rgba[i + c] =
          static_cast<std::uint8_t>(std::lround(alpha * picture.rgba[i + c] + (1 - alpha) * rgb[c]));
    picture.rgba[i + 3] = 255;
  }
}

}  // namespace

struct Movie::Inside {
  Temporary file;
  int width, height;
  Kind content;  ///< of the file: a GIF's palette is a PNG
  Rgb ground;
  std::unique_ptr<Encoder> encoder;
  image::Image flat;
  bool transparent = false;

  const fs::path& path() const { return file.target(); }
  /// Does it; what goes wrong is said with the movie's own name.
  template <class Work>
  void encode(Work&& work) {
    try {
      work();
    } catch (const WorkError& error) {
      std::string what = error.what();
      const std::string name = "file:" + file.path().string() + ": ";
      if (const auto at = what.find(name); at != std::string::npos) what.erase(at, name.size());
      throw WorkError(path().string() + ": " + what);
    }
  }
};

Movie::Kind Movie::kind_of(const fs::path& path) {
  const auto extension = path.extension();
  if (extension == ".mp4") return Kind::h264;
  if (extension == ".webm") return Kind::vp9;
  if (extension == ".mov") return Kind::prores;
  if (extension == ".gif") return Kind::gif;
  if (extension == ".png" || extension == ".apng") return Kind::apng;
  throw InputError(path.string() + ": the movie's name must end in .mp4, .webm, .mov, .gif or .png");
}

Movie::Movie(const fs::path& path, int width, int height, double frames_per_second, Rgb ground,
             const fs::path& palette, bool transparent) {
  const auto kind = kind_of(path);
  std::error_code error;
  if (!path.parent_path().empty()) fs::create_directories(path.parent_path(), error);
  remove_leftovers(folder_of(path));
  Temporary file(path);
  Words words = input_words(width, height, frames_per_second);
  const auto append = [&](const Words& more) { words.insert(words.end(), more.begin(), more.end()); };
  if (kind == Kind::h264) append(h264_words(ground));
  if (kind == Kind::vp9) append(vp9_words(ground));
  if (kind == Kind::prores) append(prores_words(ground, transparent));
  if (kind == Kind::gif && palette.empty())
    append({"-vf", "palettegen=stats_mode=full", "-frames:v", "1", "-update", "1", "-f", "image2", "-c:v",
            "png"});
  else if (kind == Kind::gif)
    append({"-i", palette.string(), "-lavfi", "paletteuse=dither=none:diff_mode=rectangle", "-loop", "0",
            "-f", "gif"});
  if (kind == Kind::apng) append({"-c:v", "apng", "-pred", "mixed", "-plays", "0", "-f", "apng"});
  words.push_back("file:" + file.path().string());
  const bool is_palette = kind == Kind::gif && palette.empty();
  inside_ = std::make_unique<Inside>(Inside{std::move(file),
                                            width,
                                            height,
                                            is_palette ? Kind::apng : kind,
                                            ground,
                                            {},
                                            {},
                                            kind == Kind::apng || (kind == Kind::prores && transparent)});
  inside_->encode([&] { inside_->encoder = std::make_unique<Encoder>(words); });
}

Movie::~Movie() = default;

void Movie::add(const image::Image& picture) {
  auto& in = *inside_;
  if (picture.width != in.width || picture.height != in.height)
    throw WorkError(in.path().string() + ": the pictures of a movie must all have one size");
  if (in.transparent) {
    in.encode([&] { in.encoder->write(picture.rgba.data(), picture.rgba.size()); });
  } else {
    in.flat = picture;
    over_ground(in.flat, in.ground);
    in.encode([&] { in.encoder->write(in.flat.rgba.data(), in.flat.rgba.size()); });
  }
}

void Movie::finish_hidden() {
  auto& in = *inside_;
  in.encode([&] {
    in.encoder->finish();
    if (!is_whole(in.content, in.file.path())) throw WorkError("ffmpeg left a file that is not whole");
  });
}

void Movie::finish() {
  finish_hidden();
  inside_->file.flush();
  inside_->file.move_into_place();
  flush_folder(folder_of(inside_->path()));
}

const fs::path& Movie::hidden_file() const { return inside_->file.path(); }

PalettePicker::PalettePicker(const fs::path& gif, int width, int height, Rgb ground)
    : maker_(std::make_unique<Movie>(gif, width, height, 1, ground)) {}

void PalettePicker::add(const image::Image& picture) { maker_->add(picture); }
void PalettePicker::finish() { maker_->finish_hidden(); }

}  // namespace chute::view
