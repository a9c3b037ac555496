#include "io/run_files.hpp"

#include <fmt/format.h>

#include <set>

#include "common/error.hpp"
#include "common/hash.hpp"

namespace chute::io {
namespace fs = std::filesystem;

FileSum sum_of(std::string_view bytes) { return {bytes.size(), hash_of(bytes), false}; }

Temporary RunFiles::made(const std::string& name, std::string_view bytes) {
  const auto path = folder_ / name;
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error) throw WorkError(fmt::format("{}: cannot write: {}", path.string(), error.message()));
  Temporary file(path);
  file.write(bytes);
  file.begin_flush();
  sums_[name] = sum_of(bytes);
  return file;
}

void RunFiles::write_once(const std::string& name, std::string_view bytes) {
  auto file = made(name, bytes);
  file.move_into_place();
  unflushed_.push_back(file.target());
  sums_[name].once = true;
}

void RunFiles::write(const std::string& name, std::string_view bytes) {
  hidden_.erase(name);  // its bytes are of before
  hidden_.emplace(name, made(name, bytes));
}

void RunFiles::show() {
  for (auto& [name, file] : hidden_) {
    file.move_into_place();
    unflushed_.push_back(file.target());
  }
  hidden_.clear();
}

void RunFiles::remove_frames_beyond() const {
  std::set<fs::path> folders;
  for (const auto& [name, sum] : sums_)
    if (sum.once) folders.insert(fs::path(name).parent_path());
  for (const auto& inside : folders) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder_ / inside, error))
      if (!is_temporary(entry.path()) && sums_.count((inside / entry.path().filename()).string()) == 0)
        fs::remove(entry.path(), error);
  }
}

void RunFiles::commit() {
  std::set<fs::path> folders{folder_};
  for (auto& [name, file] : hidden_) file.flush();
  for (const auto& path : unflushed_) {
    flush_file(path);
    folders.insert(path.parent_path());
  }
  for (auto& [name, file] : hidden_) file.move_into_place();
  for (const auto& folder : folders) flush_folder(folder);
  hidden_.clear();
  unflushed_.clear();
}

std::vector<std::string> sizes_that_differ(const fs::path& folder, const FileSums& sums) {
  std::vector<std::string> found;
  for (const auto& [name, sum] : sums) {
    std::error_code error;
    const auto path = folder / name;
    const auto size = fs::file_size(path, error);
    if (error)
      found.push_back(fmt::format("{}: {}", path.string(), error.message()));
    else if (size != sum.bytes)
      found.push_back(fmt::format("{}: {} bytes, should be {}", path.string(), size, sum.bytes));
  }
  return found;
}

std::vector<std::string> frames_cut_short(const fs::path& folder, const FileSums& sums) {
  FileSums there;
  for (const auto& [name, sum] : sums)
    if (sum.once && fs::exists(folder / name)) there[name] = sum;
  return sizes_that_differ(folder, there);
}

std::vector<std::string> differences(const fs::path& folder, const FileSums& sums) {
  auto found = sizes_that_differ(folder, sums);
  if (!found.empty()) return found;
  for (const auto& [name, sum] : sums)
    if (hash_of(read_file(folder / name)) != sum.sha256)
      found.push_back(fmt::format("{}: holds other bytes than the run wrote", (folder / name).string()));
  return found;
}

}  // namespace chute::io
