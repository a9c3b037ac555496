#include "read/run_frames.hpp"

#include <expat.h>
#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "read/byte_stream.hpp"
#include "read/dump_parts.hpp"
#include "read/number.hpp"
#include "read/points_file.hpp"

namespace chute::read {
namespace fs = std::filesystem;
namespace {

struct Entry {
  fs::path path;
  std::optional<double> time;
  std::string part;  ///< its group and number
};

struct Index {
  fs::path file;
  std::vector<Entry> entries;
  bool is_collection = false;
  std::string wrong;  // expat is C: what is wrong is said after it has returned
};

void on_element(void* user, const XML_Char* name, const XML_Char** attributes) {
  auto& index = *static_cast<Index*>(user);
  const std::string_view element = name;
  if (element == "Collection") index.is_collection = true;
  if (element != "DataSet" || !index.wrong.empty()) return;
  Entry entry;
  std::string group, part = "0";
  for (; *attributes; attributes += 2) {
    const std::string_view key = attributes[0], value = attributes[1];
    if (key == "file") entry.path = index.file.parent_path() / value;
    if (key == "group") group = value;
    if (key == "part") part = trimmed(value);
    if (key != "timestep") continue;
    entry.time = number_in(value);
    if (!entry.time || !std::isfinite(*entry.time))
      index.wrong = fmt::format("timestep \"{}\" is not a number", value);
  }
  if (entry.path.empty()) index.wrong = "a DataSet without a file";
  entry.part = fmt::format("{} {}", part, group);
  index.entries.push_back(std::move(entry));
}

/// Frames in the order of their times. An entry without one stands for itself.
std::vector<FrameFile> frames_from(std::vector<Entry> entries) {
  std::stable_sort(entries.begin(), entries.end(),
                   [](const auto& a, const auto& b) { return a.time.value_or(0) < b.time.value_or(0); });
  std::vector<FrameFile> frames;
  std::map<std::string, fs::path> parts;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto& entry = entries[i];
    parts[entry.part] = entry.path;
    if (entry.time && i + 1 < entries.size() && entries[i + 1].time == entry.time) continue;
    FrameFile frame;
    frame.time = entry.time;
    for (const auto& [name, path] : parts) {
      if (frame.path.empty())
        frame.path = path;
      else if (path != frame.path &&
               std::find(frame.more.begin(), frame.more.end(), path) == frame.more.end())
        frame.more.push_back(path);
    }
    frames.push_back(std::move(frame));
    parts.clear();
  }
  return frames;
}

/// Compares names so that numbers in them count as numbers: step9 before step10.
bool natural_less(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (digit(a[i]) && digit(b[j])) {
      const auto end_of = [&](const std::string& s, std::size_t k) {
        while (k < s.size() && digit(s[k])) ++k;
        return k;
      };
      const auto skip_zeros = [&](const std::string& s, std::size_t k) {
        while (k + 1 < s.size() && s[k] == '0' && digit(s[k + 1])) ++k;
        return k;
      };
      const std::size_t ia = skip_zeros(a, i), jb = skip_zeros(b, j), ie = end_of(a, ia), je = end_of(b, jb);
      if (ie - ia != je - jb) return ie - ia < je - jb;
      if (const int order = a.compare(ia, ie - ia, b, jb, je - jb)) return order < 0;
      i = ie, j = je;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
    }
  }
  return a.size() - i < b.size() - j || (a.size() - i == b.size() - j && a < b);
}

/// What the name says that a file holds, packed or not.
fs::path unpacked_extension(const fs::path& path) {
  const auto extension = path.extension();
  return extension == ".gz" || extension == ".zst" ? path.stem().extension() : extension;
}

/// Tables hold contacts, never grains.
bool is_frame(const fs::path& path) {
  const auto extension = unpacked_extension(path);
  constexpr std::string_view known[] = {".vtp", ".vtu", ".vtk", ".vti", ".vts", ".vtr", ".csv"};
  return std::find(std::begin(known), std::end(known), extension) != std::end(known);
}

/// Names the parts of one time, which are no frames then.
bool is_index_of_parts(const fs::path& path) {
  const auto extension = unpacked_extension(path);
  constexpr std::string_view known[] = {".pvtp", ".pvtu", ".pvti", ".pvts",
                                        ".pvtr", ".vtm",  ".vtpd", ".vtpc"};
  return std::find(std::begin(known), std::end(known), extension) != std::end(known);
}

/// The frames of files of text. InputError if they look like parts of one dump, of which only the last would be drawn.
std::vector<FrameFile> text_frames(const std::vector<fs::path>& files, const fs::path& directory = {}) {
  std::vector<FrameFile> frames;
  for (const auto& file : files)
    for (auto& piece : find_pieces(file)) {
      auto& frame = frames.emplace_back(FrameFile{file, {}, piece.time, {}});
      frame.piece = std::move(piece);
    }
  if (!std::all_of(frames.begin(), frames.end(), [](const auto& f) { return f.time.has_value(); }))
    return frames;
  if (const auto pattern = parts_pattern(frames))
    throw InputError(fmt::format(
        "{}: files with the same times, as processes of LAMMPS write them: give '{}', and each frame is put together of its parts; "
        "or one of the files",
        directory.string(), (directory / *pattern).string()));
  std::stable_sort(frames.begin(), frames.end(),
                   [](const auto& a, const auto& b) { return *a.time < *b.time; });
  std::vector<FrameFile> last;
  for (auto& frame : frames) {
    if (!last.empty() && last.back().time == frame.time) last.pop_back();
    last.push_back(std::move(frame));
  }
  return last;
}

std::vector<FrameFile> files_in(const fs::path& directory, const std::string& pattern, bool tables) {
  std::vector<std::string> names, indexes, others;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory.empty() ? "." : directory, error)) {
    const auto name = entry.path().filename().string();
    // LIGGGHTS writes its walls' box beside every dump
    if (name.starts_with('.') || name.find("boundingBox") != std::string::npos) continue;
    if (fnmatch(pattern.c_str(), name.c_str(), 0) != 0) continue;
    const bool is_one = is_frame(name) && (tables || unpacked_extension(name) != ".csv");
    (is_index_of_parts(name) ? indexes : is_one ? names : others).push_back(name);
  }
  if (!indexes.empty()) names = indexes;
  if (names.empty()) {
    std::sort(others.begin(), others.end(), natural_less);
    std::vector<fs::path> texts;
    for (const auto& name : others)
      if (text_format_of(directory / name)) texts.push_back(directory / name);
    return text_frames(texts, directory);
  }
  std::sort(names.begin(), names.end(), natural_less);
  std::vector<FrameFile> frames;
  for (const auto& name : names) frames.push_back(FrameFile{directory / name, {}, {}, {}});
  return frames;
}

/// `tables`: CSV files are frames, too.
std::vector<FrameFile> frames_of(const fs::path& source, bool tables = false) {
  std::error_code error;
  if (fs::is_directory(source, error)) {
    for (const char* index : {"frames.pvd", "cells.pvd"})
      if (fs::exists(source / index, error)) return read_pvd(source / index);
    if (fs::exists(source / "scene.toml", error))
      throw InputError(
          source.string() +
          ": the run kept no frames; its scene asks for them with [output] frames = { every = … }");
    auto frames = files_in(source, "*", tables);
    if (frames.empty()) frames = files_in(source / "frames", "*", tables);
    return frames;
  }
  if (names_parts(source)) return frames_of_parts(source);
  if (fs::exists(source, error)) {
    if (source.extension() == ".pvd") return read_pvd(source);
    if (source.extension() == ".series") return read_series_index(source);
    if (text_format_of(source)) return text_frames({source});
    return {FrameFile{source, {}, {}, {}}};
  }
  const auto pattern = source.filename().string();
  if (pattern.find_first_of("*?[") != std::string::npos)
    return files_in(source.parent_path(), pattern, tables);
  throw InputError(source.string() + ": no such file or directory");
}

}  // namespace

std::vector<FrameFile> read_pvd(const fs::path& path) {
  const std::string text = read_file(path);
  Index index{path, {}, false, {}};
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate(nullptr),
                                                                            XML_ParserFree);
  XML_SetUserData(parser.get(), &index);
  XML_SetStartElementHandler(parser.get(), on_element);
  if (XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), 1) != XML_STATUS_OK)
    throw InputError(fmt::format("{}:{}: not a time index: {}", path.string(),
                                 XML_GetCurrentLineNumber(parser.get()),
                                 XML_ErrorString(XML_GetErrorCode(parser.get()))));
  if (!index.wrong.empty()) throw InputError(path.string() + ": " + index.wrong);
  if (!index.is_collection) throw InputError(path.string() + ": not a time index: no element Collection");
  return frames_from(std::move(index.entries));
}

std::vector<FrameFile> read_series_index(const fs::path& path) {
  const auto json = nlohmann::json::parse(read_file(path), nullptr, false);
  const auto fail = [&](const std::string& what) {
    throw InputError(path.string() + ": not a time index: " + what);
  };
  if (json.is_discarded()) fail("no JSON");
  if (!json.is_object() || !json.contains("files") || !json["files"].is_array()) fail("no list \"files\"");
  std::vector<Entry> entries;
  for (const auto& file : json["files"]) {
    if (!file.is_object() || !file.contains("name") || !file["name"].is_string())
      fail("an entry without a name");
    if (!file.contains("time") || !file["time"].is_number()) fail("an entry without a time");
    entries.push_back({path.parent_path() / file["name"].get<std::string>(), file["time"].get<double>(), {}});
  }
  return frames_from(std::move(entries));
}

std::vector<FrameFile> find_frames(const fs::path& source) {
  auto frames = frames_of(source);
  if (frames.empty())
    throw InputError(
        source.string() +
        ": no frames: no VTK file (.vtp, .vtu, .vtk, .vti, .vts, .vtr), dump or XYZ file is there");
  for (auto& frame : frames)
    frame.contacts = find_beside(frame, (fs::path("contacts") / frame.path.filename()).string());
  return frames;
}

void attach_networks(std::vector<FrameFile>& frames, const fs::path& source) {
  const auto networks = frames_of(source, true);
  if (networks.empty()) throw InputError(source.string() + ": no files of contacts");
  const auto attach = [](FrameFile& frame, const FrameFile& network) {
    frame.contacts = network.path, frame.contacts_piece = network.piece;
    frame.more_contacts = network.more, frame.more_contacts_pieces = network.more_pieces;
  };
  const auto have_times = [](const std::vector<FrameFile>& files) {
    return std::all_of(files.begin(), files.end(), [](const auto& f) { return f.time.has_value(); });
  };
  for (auto& frame : frames) attach(frame, {});
  if (have_times(frames) && have_times(networks)) {
    constexpr double same = 1e-9;  // relative: times as text lose digits
    std::size_t fit = 0;
    for (auto& frame : frames)
      for (const auto& network : networks)
        if (std::abs(*frame.time - *network.time) <= same * std::max(1.0, std::abs(*frame.time)))
          attach(frame, network), ++fit;
    if (fit == 0) throw InputError(source.string() + ": no contacts have the time of a frame");
    return;
  }
  if (frames.size() != networks.size())
    throw InputError(fmt::format(
        "{}: {} file{} of contacts for {} frame{}: without times each frame needs its own", source.string(),
        networks.size(), networks.size() == 1 ? "" : "s", frames.size(), frames.size() == 1 ? "" : "s"));
  for (std::size_t i = 0; i < frames.size(); ++i) attach(frames[i], networks[i]);
}

std::vector<FileBytes> read_files(const FrameFile& frame) {
  const auto text = [](const fs::path& path, const TextPiece& piece) {
    return FileBytes{path, read_piece(path, piece.from, piece.size), piece.first_line, piece.units};
  };
  if (frame.piece) {
    std::vector<FileBytes> files{text(frame.path, *frame.piece)};
    for (std::size_t k = 0; k < frame.more_pieces.size(); ++k)
      files.push_back(text(frame.more[k], frame.more_pieces[k]));
    return files;
  }
  auto files = read_parts(frame.path);
  for (const auto& more : frame.more)
    for (auto& part : read_parts(more)) files.push_back(std::move(part));
  return files;
}

fs::path find_beside(const FrameFile& frame, std::string_view name) {
  const auto folder = frame.path.parent_path();
  const auto beside = folder.parent_path() / name;
  std::error_code error;
  return folder.filename() == "frames" && fs::exists(beside, error) ? beside : fs::path();
}

}  // namespace chute::read
