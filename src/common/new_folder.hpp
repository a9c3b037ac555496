#pragma once
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "common/error.hpp"

namespace chute {

/// A folder that a verb fills from nothing. What is in it when the verb fails goes again, with the folders that had to be
/// made for it, so that the same command finds its place free; what was there before stays.
class NewFolder {
 public:
  /// InputError if something is there that is no empty folder; `why` ends its message.
  explicit NewFolder(std::filesystem::path path, const std::string& why = {}) : path_(std::move(path)) {
    if (path_.empty()) throw InputError("the folder for what is written: its name is empty");
    std::error_code error;
    const bool there = std::filesystem::exists(path_, error);
    if (there && !std::filesystem::is_directory(path_, error))
      throw InputError(path_.string() + ": is a file; name a new folder" + why);
    if (there && !std::filesystem::is_empty(path_, error))
      throw InputError(path_.string() + ": is not empty; name a new folder" + why);
  }
  ~NewFolder() {
    if (kept_ || !made_) return;
    std::error_code ignored;
    std::vector<std::filesystem::path> inside;
    for (auto entry = std::filesystem::directory_iterator(path_, ignored);
         entry != std::filesystem::directory_iterator(); entry.increment(ignored))
      inside.push_back(entry->path());
    for (const auto& one : inside) std::filesystem::remove_all(one, ignored);
    for (const auto& folder : fresh_) std::filesystem::remove(folder, ignored);  // only if it is empty
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  /// WorkError if it cannot be made.
  void make() {
    if (made_) return;
    std::error_code error;
    for (auto folder = path_; !folder.empty() && !std::filesystem::exists(folder, error);
         folder = folder.parent_path())
      fresh_.push_back(folder);
    std::filesystem::create_directories(path_, error);
    if (error) throw WorkError(path_.string() + ": cannot be made: " + error.message());
    made_ = true;
  }
  /// The work is done, or what is there is worth keeping.
  void keep() { kept_ = true; }

 private:
  std::filesystem::path path_;
  std::vector<std::filesystem::path> fresh_;  // what make() made, innermost first
  bool made_ = false, kept_ = false;
};

}  // namespace chute
