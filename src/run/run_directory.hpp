#pragma once
#include <filesystem>
#include <string>

namespace chute::run {

enum class Existing { refuse, resume, replace };

/// The folder of one run: names of its files, and who may write into it.
class RunDirectory {
 public:
  /// Claims `path` for a run. An existing run is refused, resumed or replaced; a folder that holds other
  /// things is never touched (InputError). WorkError if the folder cannot be made or written.
  RunDirectory(std::filesystem::path path, Existing existing);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path file(const std::string& name) const { return path_ / name; }
  bool resumes() const { return resumes_; }

 private:
  std::filesystem::path path_;
  bool resumes_ = false;
};

}  // namespace chute::run
