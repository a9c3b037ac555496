#include "read/dump_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <regex>
#include <set>

#include "common/error.hpp"
#include "common/fields.hpp"

namespace chute::read {
namespace fs = std::filesystem;
namespace {

struct Part {
  fs::path file;
  std::size_t process = 0;
};

std::optional<std::size_t> number_of(const std::string& digits) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || error != std::errc() || end != digits.data() + digits.size()) return {};
  return value;
}

/// A file name's pattern as a regular expression, whose one group is what stands for the `%`.
std::regex expression_of(const std::string& pattern) {
  std::string text;
  for (const char c : pattern) {
    if (c == '%')
      text += "([0-9]+)";
    else if (c == '*')
      text += ".*";
    else if (c == '?')
      text += '.';
    else
      text += std::ispunct(static_cast<unsigned char>(c)) != 0 ? std::string("\\") + c : std::string(1, c);
  }
  return std::regex(text, std::regex::ECMAScript);
}

std::vector<Part> find_parts(const fs::path& source) {
  const auto pattern = source.filename().string();
  if (std::count(pattern.begin(), pattern.end(), '%') != 1)
    throw InputError(source.string() + ": one % stands for the number of the process, not several");
  const auto expression = expression_of(pattern);
  std::vector<Part> parts;
  std::error_code error;
  const auto folder = source.parent_path();
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error)) {
    const auto name = entry.path().filename().string();
    std::smatch match;
    if (!std::regex_match(name, match, expression)) continue;
    if (const auto process = number_of(match[1].str())) parts.push_back({folder / name, *process});
  }
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return a.process != b.process ? a.process < b.process : a.file < b.file;
  });
  return parts;
}

using PieceOf = std::map<std::size_t, std::pair<fs::path, TextPiece>>;  // by process

/// What each process wrote for each time; of a time that a process has twice, as after a restart, what it wrote last.
std::map<double, PieceOf> pieces_of(const std::vector<Part>& parts) {
  std::map<double, PieceOf> times;
  for (const auto& part : parts) {
    if (text_format_of(part.file) != PointSet::Format::dump)
      throw InputError(part.file.string() + ": no dump, which the files are that a % names");
    for (auto& piece : find_pieces(part.file)) {
      if (!piece.time)
        throw InputError(
            fmt::format("{}:{}: a frame without ITEM: TIMESTEP: which parts belong together is not known",
                        part.file.string(), piece.first_line));
      const double time = *piece.time;
      times[time].insert_or_assign(part.process, std::pair{part.file, std::move(piece)});
    }
  }
  return times;
}

}  // namespace

bool names_parts(const fs::path& source) {
  std::error_code error;
  return source.filename().string().find('%') != std::string::npos && !fs::exists(source, error);
}

std::vector<FrameFile> frames_of_parts(const fs::path& source) {
  const auto parts = find_parts(source);
  if (parts.empty())
    throw InputError(source.string() +
                     ": no such file, and none with the number of a process, from 0 on, for the %");
  std::set<std::size_t> processes;
  for (const auto& part : parts) processes.insert(part.process);
  const std::size_t count = *processes.rbegin() + 1;
  for (std::size_t k = 0; k < count; ++k)
    if (!processes.count(k))
      throw InputError(
          fmt::format("{}: part {} is missing, up to {} others are there", source.string(), k, count - 1));
  const auto times = pieces_of(parts);
  std::vector<FrameFile> frames;
  std::string lacking;  // said only if a later time is whole: at the end a part may still be on its way
  for (const auto& [time, pieces] : times) {
    if (pieces.size() < count) {
      std::size_t first = 0;
      while (pieces.count(first)) ++first;
      lacking = fmt::format("{}: part {} has no whole frame of time {}, which others have", source.string(),
                            first, time);
      continue;
    }
    if (!lacking.empty()) throw InputError(lacking);
    FrameFile frame;
    frame.time = time;
    for (const auto& [process, piece] : pieces) {
      if (process == 0)
        frame.path = piece.first, frame.piece = piece.second;
      else
        frame.more.push_back(piece.first), frame.more_pieces.push_back(piece.second);
    }
    frames.push_back(std::move(frame));
  }
  if (frames.empty()) throw InputError(lacking);
  if (!lacking.empty()) frames.back().piece->cut_after = lacking;
  return frames;
}

namespace {

/// The name that these make with a `%` for one of its numbers, which goes from 0 on without a gap.
std::optional<std::string> pattern_of(const std::vector<std::string>& names) {
  const auto& name = names[0];
  for (std::size_t at = 0; at < name.size(); ++at) {
    if (std::isdigit(static_cast<unsigned char>(name[at])) == 0) continue;
    std::size_t end = at;
    while (end < name.size() && std::isdigit(static_cast<unsigned char>(name[end])) != 0) ++end;
    const auto before = name.substr(0, at), behind = name.substr(end);
    std::set<std::size_t> numbers;
    for (const auto& other : names) {
      if (other.size() <= before.size() + behind.size() || !other.starts_with(before) ||
          !other.ends_with(behind))
        break;
      if (const auto number = number_of(other.substr(at, other.size() - before.size() - behind.size())))
        numbers.insert(*number);
    }
    if (numbers.size() == names.size() && *numbers.begin() == 0 && *numbers.rbegin() + 1 == numbers.size())
      return before + "%" + behind;
    at = end;
  }
  return {};
}

/// The same for the files of all times: their other numbers differ.
std::string for_all_times(const std::string& pattern) {
  std::string all;
  for (const char c : pattern) {
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    if (!digit)
      all += c;
    else if (!all.ends_with('*'))
      all += '*';
  }
  return all;
}

}  // namespace

std::optional<std::string> parts_pattern(const std::vector<FrameFile>& frames) {
  std::map<fs::path, std::vector<double>> times_of;
  for (const auto& frame : frames) {
    if (!frame.time) return {};
    times_of[frame.path].push_back(*frame.time);
  }
  std::map<std::vector<double>, std::vector<std::string>> with_times;
  for (const auto& [file, times] : times_of) with_times[times].push_back(file.filename().string());
  std::vector<std::string> patterns;
  for (const auto& [times, names] : with_times)
    if (names.size() > 1)
      if (auto pattern = pattern_of(names)) patterns.push_back(*pattern);
  if (patterns.empty()) return {};
  const auto all = for_all_times(patterns[0]);
  const bool one_a_time =
      patterns.size() > 1 &&
      std::all_of(patterns.begin(), patterns.end(), [&](const auto& p) { return for_all_times(p) == all; });
  return one_a_time ? all : patterns[0];
}

PointSet join_parts(std::vector<PointSet> sets, const std::vector<FileBytes>& files) {
  const auto fail = [&](std::size_t part, const std::string& what) {
    throw InputError(fmt::format("{}: {} {}", files[part].path.string(), what, files[0].path.string()));
  };
  PointSet all = std::move(sets[0]);
  for (std::size_t p = 1; p < sets.size(); ++p) {
    auto& set = sets[p];
    if (set.point_names != all.point_names)
      fail(p, fmt::format("its columns {} are not those of", fmt::join(set.point_names, " ")));
    if (set.lattice.has_value() != all.lattice.has_value() ||
        (set.lattice &&
         (set.lattice->origin != all.lattice->origin || set.lattice->edges != all.lattice->edges)))
      fail(p, "its box is not that of");
    all.x.insert(all.x.end(), set.x.begin(), set.x.end());
    all.y.insert(all.y.end(), set.y.begin(), set.y.end());
    all.z.insert(all.z.end(), set.z.begin(), set.z.end());
    for (std::size_t a = 0; a < all.point_arrays.size(); ++a) {
      auto &into = all.point_arrays[a], &from = set.point_arrays[a];
      // a part without grains does not know which of its columns are words
      if (into.words.empty() != from.words.empty() && !into.values.empty() && !from.values.empty())
        fail(p, fmt::format("its column {} has words where numbers are in", into.name));
      for (double& value : from.values)
        if (!from.words.empty()) {
          const auto& word = from.words[static_cast<std::size_t>(value)];
          auto known = std::find(into.words.begin(), into.words.end(), word);
          if (known == into.words.end()) into.words.push_back(word), known = into.words.end() - 1;
          value = static_cast<double>(known - into.words.begin());
        }
      into.values.insert(into.values.end(), from.values.begin(), from.values.end());
    }
  }
  for (const auto& array : all.point_arrays) {
    if (array.name != fields::id.name) continue;
    std::set<double> ids;
    for (const double id : array.values)
      if (!ids.insert(id).second)
        throw InputError(fmt::format("{}: grain {} is in this frame twice: not the parts of one dump",
                                     files[0].path.string(), id));
  }
  return all;
}

}  // namespace chute::read
