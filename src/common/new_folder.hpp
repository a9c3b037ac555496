#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/file_lock.hpp"

namespace chute {

/// A folder that a verb fills from nothing. What is in it when the verb fails goes again, with the folders that had to be
/// made for it, so that the same command finds its place free; what was there before stays. While it is filled it is
/// locked: a lock's file that nobody holds says that its verb was killed, and what that one left is taken over.
class NewFolder {
 public:
  /// Does the verb write something of that name into the folder?
  using IsOwn = std::function<bool(const std::filesystem::path& name)>;

  /// InputError if something is there that is neither an empty folder nor what a killed verb left, all of it by names that
  /// are `own`; WorkError if another process is filling it. `why` ends the message.
  explicit NewFolder(std::filesystem::path path, IsOwn own, std::string why = {});
  ~NewFolder();
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  /// Makes it, locks it and empties it of what a killed verb left. WorkError if it cannot be made.
  void make();
  /// The work is done, or what is there is worth keeping.
  void keep() { kept_ = true; }

 private:
  std::filesystem::path path_;
  IsOwn own_;
  std::string why_;
  std::vector<std::filesystem::path> fresh_;  // what make() made, innermost first
  std::optional<FolderLock> lock_;
  bool made_ = false, kept_ = false;

  void refuse_used() const;
  void empty() const noexcept;
};

}  // namespace chute
