#include "read/run_frames.hpp"

#include <expat.h>
#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>
#include <string_view>

#include "common/atomic_file.hpp"
#include "common/error.hpp"

namespace chute::read {
namespace fs = std::filesystem;
namespace {

struct Index {
  fs::path file;
  std::vector<FrameFile> frames;
  bool is_collection = false;
  std::string wrong;  // expat is C: what is wrong is said after it has returned
};

void on_element(void* user, const XML_Char* name, const XML_Char** attributes) {
  auto& index = *static_cast<Index*>(user);
  const std::string_view element = name;
  if (element == "Collection") index.is_collection = true;
  if (element != "DataSet" || !index.wrong.empty()) return;
  FrameFile frame;
  for (; *attributes; attributes += 2) {
    const std::string_view key = attributes[0], value = attributes[1];
    if (key == "file") frame.path = index.file.parent_path() / value;
    if (key != "timestep") continue;
    double time = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), time);
    if (error != std::errc() || end != value.data() + value.size() || !std::isfinite(time))
      index.wrong = fmt::format("timestep \"{}\" is not a number", value);
    frame.time = time;
  }
  if (frame.path.empty()) index.wrong = "a DataSet without a file";
  index.frames.push_back(std::move(frame));
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

bool is_vtk(const fs::path& path) {
  const auto extension = path.extension();
  return extension == ".vtp" || extension == ".vtu" || extension == ".vtk" || extension == ".vti";
}

std::vector<FrameFile> files_in(const fs::path& directory, const std::string& pattern) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory.empty() ? "." : directory, error)) {
    const auto name = entry.path().filename().string();
    // LIGGGHTS writes its walls' box beside every dump
    if (!is_vtk(name) || name.starts_with('.') || name.find("boundingBox") != std::string::npos) continue;
    if (fnmatch(pattern.c_str(), name.c_str(), 0) == 0) names.push_back(name);
  }
  std::sort(names.begin(), names.end(), natural_less);
  std::vector<FrameFile> frames;
  for (const auto& name : names) frames.push_back({directory / name, {}, {}});
  return frames;
}

std::vector<FrameFile> frames_of(const fs::path& source) {
  std::error_code error;
  if (fs::is_directory(source, error)) {
    for (const char* index : {"frames.pvd", "cells.pvd"})
      if (fs::exists(source / index, error)) return read_pvd(source / index);
    if (fs::exists(source / "scene.toml", error))
      throw InputError(
          source.string() +
          ": the run kept no frames; its scene asks for them with [output] frames = { every = … }");
    auto frames = files_in(source, "*");
    if (frames.empty()) frames = files_in(source / "frames", "*");
    return frames;
  }
  if (fs::exists(source, error))
    return source.extension() == ".pvd" ? read_pvd(source) : std::vector<FrameFile>{{source, {}, {}}};
  const auto pattern = source.filename().string();
  if (pattern.find_first_of("*?[") != std::string::npos) return files_in(source.parent_path(), pattern);
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
  std::stable_sort(index.frames.begin(), index.frames.end(),
                   [](const auto& a, const auto& b) { return a.time.value_or(0) < b.time.value_or(0); });
  return std::move(index.frames);
}

std::vector<FrameFile> find_frames(const fs::path& source) {
  auto frames = frames_of(source);
  if (frames.empty())
    throw InputError(source.string() + ": no frames: no VTK file (.vtp, .vtu, .vtk, .vti) is there");
  for (auto& frame : frames)
    frame.contacts = find_beside(frame, (fs::path("contacts") / frame.path.filename()).string());
  return frames;
}

fs::path find_beside(const FrameFile& frame, std::string_view name) {
  const auto folder = frame.path.parent_path();
  const auto beside = folder.parent_path() / name;
  std::error_code error;
  return folder.filename() == "frames" && fs::exists(beside, error) ? beside : fs::path();
}

}  // namespace chute::read
