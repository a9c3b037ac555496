#pragma once
#include <filesystem>
#include <string_view>

namespace chute {

/// A folder for what is made on the way, in the one for temporary files, gone when it is done with. It is locked as long as a
/// process works in it; what killed ones left is removed by the next that makes one of the same word.
class ScratchFolder {
 public:
  /// `chute-WORD-` and six random letters. WorkError if it cannot be made.
  explicit ScratchFolder(std::string_view word);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace chute
