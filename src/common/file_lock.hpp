#pragma once
#include <filesystem>
#include <string>

namespace chute {

enum class LockKind {
  alone,    ///< nobody else may have any lock
  together  ///< others may have this kind too
};
enum class TryLock {
  got,
  held_by_another,
  not_possible  ///< this file system has no locks
};

/// Locks an open file without waiting. The lock belongs to the open file: it goes when the process ends, however it ends,
/// and it is seen by other machines that share the disk, where the file system can do that.
TryLock try_lock(int file, LockKind kind);

/// Keeps a folder for one process, or for several that know of each other. The lock is a file `.chute-lock` in the folder,
/// which tells who has it, moves with the folder when that is renamed, and is removed in the end.
class FolderLock {
 public:
  /// `part` names a lock on a part of what is done in the folder. WorkError in one line that says who has it, or that the
  /// folder cannot be written.
  explicit FolderLock(const std::filesystem::path& folder, LockKind kind = LockKind::alone,
                      const std::string& part = "");
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;

  /// Is there a process that holds the folder alone, or one of those that hold it together?
  static bool is_held(const std::filesystem::path& folder);
  /// Removes the file of a lock that nobody has: of a process that was killed when all its work was done.
  static void remove_leftover(const std::filesystem::path& folder);
  /// Is it the name of a lock's file?
  static bool is_name(const std::filesystem::path& file);

 private:
  std::string name_;
  int folder_ = -1, file_ = -1;

  bool take(const std::filesystem::path& folder, LockKind kind);
  void close();
  bool is_current(const std::filesystem::path& folder) const;
  bool has_its_name() const;
  void say_who() const;
};

}  // namespace chute
