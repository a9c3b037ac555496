#include "common/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "common/error.hpp"

namespace chute {
namespace fs = std::filesystem;

namespace detail {

fs::path beside(const fs::path& path) {
  auto name = fmt::format(".{}.{}{}", path.stem().string(), ::getpid(), path.extension().string());
  return path.parent_path() / name;
}

void move_into_place(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) {
    std::error_code ignored;
    fs::remove(from, ignored);
    throw WorkError(fmt::format("{}: cannot write: {}", to.string(), error.message()));
  }
}

}  // namespace detail

void write_atomically(const fs::path& path, std::string_view content) {
  replace_atomically(path, [&](const fs::path& temporary) {
    const auto fail = [&] {
      throw WorkError(fmt::format("{}: cannot write: {}", path.string(), std::strerror(errno)));
    };
    const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0) fail();
    while (!content.empty()) {
      const auto written = ::write(file, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) {
        const int why = errno;
        ::close(file);
        errno = why;
        fail();
      }
      content.remove_prefix(static_cast<std::size_t>(written));
    }
    if (::close(file) != 0) fail();  // some file systems report a full disk only here
  });
}

std::string read_file(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw InputError(path.string() + ": is a directory, not a file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(fmt::format("{}: cannot read: {}", path.string(), std::strerror(errno)));
  std::ostringstream content;
  content << in.rdbuf();
  return std::move(content).str();
}

}  // namespace chute
