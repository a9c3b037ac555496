#include "engines/lammps/dump_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/atomic_file.hpp"
#include "common/error.hpp"

namespace chute::lammps {
namespace fs = std::filesystem;
namespace {

/// A text line by line, and word by word.
class Words {
 public:
  Words(std::string_view text, const fs::path& file) : text_(text), file_(file) {}

  std::string_view line() {
    if (text_.empty()) fail("cut short");
    const auto end = std::min(text_.find('\n'), text_.size());
    const auto line = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    return line;
  }
  double number() {
    const auto first = text_.find_first_not_of(" \n");
    if (first == std::string_view::npos) fail("cut short");
    text_.remove_prefix(first);
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
    if (error != std::errc() || !std::isfinite(value)) fail("a value is no number");
    text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
    return value;
  }
  bool at_end() const { return text_.find_first_not_of(" \n") == std::string_view::npos; }
  std::size_t left() const { return text_.size(); }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: no whole frame of a dump: {}", file_.string(), what));
  }

 private:
  std::string_view text_;
  fs::path file_;
};

}  // namespace

DumpFrame read_dump_frame(const fs::path& file) {
  const auto text = read_file(file);
  Words words(text, file);
  DumpFrame frame;
  std::uint64_t rows = 0;
  for (;;) {
    auto line = words.line();
    if (!line.starts_with("ITEM: ")) words.fail("expected ITEM:");
    line.remove_prefix(6);
    if (line == "TIMESTEP") {
      frame.step = static_cast<std::int64_t>(words.number()), words.line();
    } else if (line.starts_with("NUMBER OF ")) {
      rows = static_cast<std::uint64_t>(words.number()), words.line();
    } else if (line.starts_with("BOX BOUNDS")) {
      for (int k = 0; k < 3; ++k) words.line();
    } else if (line.starts_with("ATOMS ") || line.starts_with("ENTRIES ")) {
      line.remove_prefix(line.find(' ') + 1);
      for (std::size_t at = 0; at < line.size();) {
        const auto end = std::min(line.find(' ', at), line.size());
        if (end > at) frame.names.emplace_back(line.substr(at, end - at));
        at = end + 1;
      }
      break;
    } else {
      for (const std::string_view other : {"UNITS", "TIME"})
        if (line == other) line = {}, words.line();
      if (!line.empty()) words.fail(fmt::format("ITEM: {}", line.substr(0, 40)));
    }
  }
  if (frame.names.empty() || rows * frame.names.size() > words.left()) words.fail("cut short");
  frame.values.resize(rows * frame.names.size());
  for (auto& value : frame.values) value = words.number();
  if (!words.at_end()) words.fail("more rows than it says");
  return frame;
}

std::vector<std::int64_t> steps_in(const fs::path& folder, const std::string& stem) {
  std::vector<std::int64_t> steps;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto name = entry.path().filename().string();
    if (!name.starts_with(stem + ".")) continue;
    std::int64_t step = 0;
    const char* const begin = name.data() + stem.size() + 1;
    const auto [end, wrong] = std::from_chars(begin, name.data() + name.size(), step);
    if (wrong == std::errc() && end == name.data() + name.size()) steps.push_back(step);
  }
  std::ranges::sort(steps);
  return steps;
}

}  // namespace chute::lammps
