#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "common/atomic_file.hpp"

namespace chute::io {

/// What a file should hold.
struct FileSum {
  std::uint64_t bytes = 0;
  std::string sha256;
  bool once = false;  ///< a frame, which never changes
  template <class Archive>
  void serialize(Archive& archive) {
    archive(bytes, sha256, once);
  }
};
using FileSums = std::map<std::string, FileSum>;  ///< by name in the folder

/// The files of a run directory. Flushing each to the disk as it comes would wait for the disk each time; they are flushed
/// together, by `commit`, before the checkpoint that counts on them.
class RunFiles {
 public:
  explicit RunFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// A file that never changes, a frame: it appears at once, and is surely on the disk after the next `commit`.
  void write_once(const std::string& name, std::string_view bytes);
  /// A table that is written again and again: the old one stays until `commit`.
  void write(const std::string& name, std::string_view bytes);
  /// Tables that were written take their names, for those who watch. They are surely on the disk only after `commit`.
  void show();
  /// Frames that are there but that this run did not write, left by one that was killed after its checkpoint, go.
  void remove_frames_beyond() const;
  /// Everything is on the disk, under its name. WorkError that names the file if it is not.
  void commit();

  const FileSums& sums() const { return sums_; }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(sums_);
  }

 private:
  std::filesystem::path folder_;
  FileSums sums_;
  std::vector<std::filesystem::path> unflushed_;
  std::map<std::string, Temporary> hidden_;

  Temporary made(const std::string& name, std::string_view bytes);
};

FileSum sum_of(std::string_view bytes);

/// One line for each file that is missing or of another size.
std::vector<std::string> sizes_that_differ(const std::filesystem::path& folder, const FileSums& sums);
/// Frames that are there but cut short, as a power cut leaves them if the disk lies: a run that goes on would keep them so.
std::vector<std::string> frames_cut_short(const std::filesystem::path& folder, const FileSums& sums);
/// One line for each file that is missing or does not hold what it should.
std::vector<std::string> differences(const std::filesystem::path& folder, const FileSums& sums);

}  // namespace chute::io
