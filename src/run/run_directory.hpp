#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "common/file_lock.hpp"

namespace chute::run {

struct RunRecord;

enum class Existing { refuse, resume, replace };

/// The folder of one run: names of its files, and who may write into it.
///
/// At every moment, however the process ends, the folder is one that `--resume` or `--force` takes: run.json stands there
/// before anything else. A run that is replaced is exchanged for the new one's folder in one rename and stays beside it as
/// `.chute-old-…-NAME` until the new one has finished.
class RunDirectory {
 public:
  /// Claims `path` for a run, and locks it. An existing run is refused, resumed or replaced; a folder that holds other
  /// things is never touched (InputError). WorkError if the folder cannot be made or written, or another process has it.
  RunDirectory(const std::filesystem::path& path, Existing existing);
  /// Writes run.json, which says that it is running; from now on this run stands at `path`.
  void claim(const RunRecord& record);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path file(const std::string& name) const { return path_ / name; }
  /// Is there a checkpoint to go on from?
  bool resumes() const { return resumes_; }

  /// The run is whole: runs that it replaced go. What in their folders was not chute's moves into this one.
  void finish();
  /// The run did not get as far as something that can be resumed: the one that it replaced stands in its place again, or the
  /// place is free again.
  void put_back() noexcept;

 private:
  std::filesystem::path path_;
  std::optional<std::filesystem::path>
      beside_;  ///< where the new folder is until it is claimed, then the old one
  bool resumes_ = false, replaces_ = false, exchanged_ = false;
  bool made_ = false, fresh_ = false;  ///< was there no such folder, no run in it
  std::optional<FolderLock> lock_,
      new_lock_;  ///< of the folder that stood at `path`, and of the one that replaces it

  std::filesystem::path sibling(const char* what) const;
  void prepare(Existing existing);
  void exchange();
  void leave_no_trace() const noexcept;
};

}  // namespace chute::run
