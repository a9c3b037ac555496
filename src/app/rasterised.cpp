#include "app/rasterised.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <vector>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/scratch_folder.hpp"
#include "image/png.hpp"

namespace chute::app {
namespace fs = std::filesystem;
namespace {

constexpr const char* resolution = "150";  // pixels an inch: strokes of 0.5 points are a pixel wide

/// Runs a program without a shell, with nothing on its streams; its exit status, or -1 if it is not there.
int run_program(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  for (const int stream : {0, 1, 2})
    posix_spawn_file_actions_addopen(&streams, stream, "/dev/null", stream == 0 ? O_RDONLY : O_WRONLY, 0);
  pid_t child = 0;
  const int failed = ::posix_spawnp(&child, arguments[0], &streams, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&streams);
  if (failed) return -1;
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (!WIFEXITED(status) || WEXITSTATUS(status) == 127) return WIFEXITED(status) ? -1 : 1;
  return WEXITSTATUS(status);
}

image::Image drawn(const fs::path& file, std::vector<std::string> words, const char* package,
                   const fs::path& picture) {
  read_file(file);  // says what is wrong with it in chute's own words
  const int status = run_program(words);
  if (status < 0)
    throw WorkError(
        fmt::format("{}: is drawn by {}, which is not here: install {}", file.string(), words[0], package));
  if (status != 0 || !fs::exists(picture))
    throw InputError(fmt::format("{}: {} cannot draw it", file.string(), words[0]));
  return image::read_png(picture);
}

}  // namespace

bool is_picture(const fs::path& file) {
  const auto extension = file.extension();
  return extension == ".png" || extension == ".pdf" || extension == ".svg";
}

image::Image read_picture(const fs::path& file) {
  if (file.extension() == ".pdf") {
    const ScratchFolder scratch("compare");
    return drawn(file,
                 {"pdftoppm", "-png", "-r", resolution, "-singlefile", fs::absolute(file).string(),
                  (scratch.path() / "page").string()},
                 "poppler-utils", scratch.path() / "page.png");
  }
  if (file.extension() == ".svg") {
    const ScratchFolder scratch("compare");
    const auto picture = scratch.path() / "drawing.png";
    return drawn(file,
                 {"rsvg-convert", "--dpi-x", resolution, "--dpi-y", resolution, "--background-color", "white",
                  "-o", picture.string(), fs::absolute(file).string()},
                 "librsvg2-bin", picture);
  }
  return image::read_png(file);
}

}  // namespace chute::app
