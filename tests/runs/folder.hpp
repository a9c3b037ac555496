#pragma once
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace chute::test {

namespace fs = std::filesystem;

/// A folder of its own for a test, gone at its end.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "chute-test-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("cannot make " + name);
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path operator/(const std::string& name) const { return path_ / name; }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

inline std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}
inline void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// Every file below a folder, by its name, with its bytes.
inline std::map<std::string, std::string> tree(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = content(entry.path());
  return files;
}

const inline std::string scenes = CHUTE_SOURCE_DIR "/scenes/";

/// The rows of a CSV file, its names first, without the lines of comment.
inline std::vector<std::vector<std::string>> rows_of(const fs::path& file) {
  std::istringstream in(content(file));
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("#")) continue;
    auto& row = rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
  }
  return rows;
}
/// One column of it; a cell without a number is NaN.
inline std::vector<double> column(const fs::path& file, const std::string& name) {
  const auto rows = rows_of(file);
  const auto at = std::find(rows.at(0).begin(), rows.at(0).end(), name) - rows[0].begin();
  if (at == std::ssize(rows[0])) throw std::runtime_error(file.string() + " has no column " + name);
  std::vector<double> values;
  for (std::size_t r = 1; r < rows.size(); ++r)
    values.push_back(at < std::ssize(rows[r]) && !rows[r][at].empty() ? std::stod(rows[r][at]) : NAN);
  return values;
}

/// What a run promises to repeat: all but run.json (times) and the checkpoint.
inline std::map<std::string, std::string> results(const fs::path& run) {
  auto files = tree(run);
  files.erase("run.json");
  files.erase("checkpoint");
  return files;
}

/// The one line that an error says, and whether it was of the given kind.
template <class Error, class Work>
std::string message(Work&& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing thrown";
}

}  // namespace chute::test
