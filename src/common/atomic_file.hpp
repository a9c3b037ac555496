#pragma once
#include <filesystem>
#include <string>
#include <string_view>

/// The one place where chute writes files. What is written stands under a name of its own beside its place until it is whole
/// and on the disk, and only then takes the name that it is for; so a reader sees the old file or the new one, never a part,
/// and that after a power cut too.
namespace chute {

enum class Flush {
  now,  ///< it is on the disk when the call returns
  later  ///< for what is checked when it is read and can be made again, or is flushed with others by flush_file
};

/// Writes `content` to `path`. On failure (no room, no permission) the old file is left as it was,
/// nothing is left beside it, and WorkError says which file and why.
void write_atomically(const std::filesystem::path& path, std::string_view content, Flush flush = Flush::now);

/// Writes `content` to `path` unless there is a file of that name already, whoever comes first; false if there is.
bool write_if_absent(const std::filesystem::path& path, std::string_view content);

/// Whole file as bytes. InputError if it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// A file that is being written beside its place. Its name begins with `.chute-` and holds 64 random bits, so that no two
/// writers share one, on machines that share a disk neither; it is locked while its writer lives, so that what a killed
/// process left behind is known (remove_leftovers). Removed if it is not moved into place.
class Temporary {
 public:
  /// WorkError that names `target` if no file can be made beside it.
  explicit Temporary(std::filesystem::path target);
  ~Temporary();
  Temporary(Temporary&& other) noexcept;
  Temporary& operator=(Temporary&&) = delete;

  /// For libraries and programs that insist on writing files themselves; it has the target's extension.
  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& target() const { return target_; }
  void write(std::string_view content);
  /// Asks the disk to begin: flushing many files then waits once, not for each.
  void begin_flush() const;
  /// Returns when it is on the disk.
  void flush();
  /// Takes its name. The name is on the disk when the folder is flushed.
  void move_into_place();
  /// The same, but false if the name is taken.
  bool move_if_absent();

 private:
  std::filesystem::path target_, path_;
  int file_ = -1;

  [[noreturn]] void fail() const;
  void done();
};

/// Flushes the names in a folder to the disk.
void flush_folder(const std::filesystem::path& folder);
/// Flushes what a file holds to the disk. WorkError.
void flush_file(const std::filesystem::path& file);
/// The folder that a file lies in, "." for a bare name.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// Does a file's name say that it is being written, or was when its writer was killed?
bool is_temporary(const std::filesystem::path& path);
/// Removes from a folder what killed processes left half written there. What a living process writes stays.
void remove_leftovers(const std::filesystem::path& folder) noexcept;

/// Runs `write(temporary_path)`, for libraries that insist on writing files themselves, and moves the result to `path`; the
/// temporary file, in the same folder and with the same extension, is removed if `write` throws.
template <class Write>
void replace_atomically(const std::filesystem::path& path, Write&& write) {
  Temporary temporary(path);
  write(temporary.path());
  temporary.flush();
  temporary.move_into_place();
  flush_folder(folder_of(path));
}

/// 64 random bits as 16 hexadecimal digits.
std::string random_name();

}  // namespace chute
