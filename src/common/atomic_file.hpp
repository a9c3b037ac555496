#pragma once
#include <filesystem>
#include <string_view>

namespace chute {

/// Writes `content` to `path` so that a reader sees the old file or the new one, never a part: it is written
/// beside and renamed. On failure (no room, no permission) the old file is left as it was, nothing is left
/// beside it, and WorkError says which file and why.
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// Whole file as bytes. InputError if it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// Runs `write(temporary_path)`, for libraries that insist on writing files themselves, and renames the
/// result to `path`; the temporary file, in the same folder and with the same extension, is removed if
/// `write` throws.
template <class Write>
void replace_atomically(const std::filesystem::path& path, Write&& write);

namespace detail {
std::filesystem::path beside(const std::filesystem::path& path);
void move_into_place(const std::filesystem::path& from, const std::filesystem::path& to);
}  // namespace detail

template <class Write>
void replace_atomically(const std::filesystem::path& path, Write&& write) {
  const auto temporary = detail::beside(path);
  try {
    write(temporary);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
  detail::move_into_place(temporary, path);
}

}  // namespace chute
