#include "harness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/toml_reader.hpp"
#include "image/png.hpp"
#include "manifest.hpp"
#include "plot/draw.hpp"
#include "sha256.hpp"

namespace chute::golden {
namespace fs = std::filesystem;

Harness::Harness(fs::path goldens, fs::path report)
    : goldens_(std::move(goldens)), report_(std::move(report)) {}

bool Harness::check(const Golden& golden) {
  const auto before = failures_.size();
  const auto actual = golden.draw();
  const auto path = goldens_ / (golden.name + ".png");
  if (image::is_blank(actual)) {
    fail(golden, "what was drawn is blank", nullptr, actual);
    return false;
  }
  if (!fs::exists(path)) {
    fail(golden, "there is no golden of this name; update_goldens makes one", nullptr, actual);
    return false;
  }
  std::optional<image::Image> expected;
  try {
    const auto records = read_manifest(goldens_ / "manifest.json");
    const auto record = records.find(golden.name);
    if (record == records.end())
      fail(golden, "the golden is not in manifest.json", nullptr, actual);
    else if (record->second.sha256 != sha256(read_file(path)))
      fail(golden, "the golden is not the file that manifest.json records", nullptr, actual);
    expected = image::read_png(path);
  } catch (const InputError& error) {
    fail(golden, error.what(), nullptr, actual);
    return false;
  }
  const auto comparison = image::compare(*expected, actual, golden.tolerance);
  if (image::is_blank(*expected))
    fail(golden, "the golden is blank", &*expected, actual);
  else if (!comparison.passes)
    fail(golden, comparison.summary(), &*expected, actual);
  return failures_.size() == before;
}

void Harness::fail(const Golden& golden, const std::string& what, const image::Image* expected,
                   const image::Image& actual) {
  const auto folder = report_ / golden.name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  if (actual.width > 0) image::write_png(folder / "actual.png", actual);
  if (expected) {
    image::write_png(folder / "expected.png", *expected);
    image::write_png(folder / "difference.png", image::difference(*expected, actual));
  }
  failures_.push_back({golden.name, what, folder});
  write_page();
}

void Harness::write_page() const {
  std::string page =
      "<!DOCTYPE html><html><head><meta charset=\"utf-8\"><title>Golden pictures that differ</title><style>"
      "body{font-family:sans-serif;margin:2em}figure{display:inline-block;margin:0 1em 1em "
      "0;vertical-align:top}"
      "img{border:1px solid #999;max-width:30vw}p{color:#a00}</style></head><body><h1>Golden pictures that "
      "differ</h1>\n";
  for (const auto& f : failures_) {
    page += fmt::format("<h2>{}</h2><p>{}</p>\n", f.name, f.what);
    for (const char* which : {"expected", "actual", "difference"})
      if (fs::exists(f.folder / (std::string(which) + ".png")))
        page +=
            fmt::format("<figure><img src=\"{}/{}.png\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
                        f.name, which, which, which);
  }
  write_atomically(report_ / "index.html", page + "</body></html>\n");
}

std::vector<std::string> update(const fs::path& goldens, const std::vector<Golden>& known,
                                const std::vector<std::string>& names, const std::string& reason) {
  if (reason.find_first_not_of(" \t\n") == std::string::npos)
    throw InputError("update_goldens: give a reason: why does the picture change?");
  std::vector<std::string> all;
  for (const auto& g : known) all.push_back(g.name);
  std::vector<const Golden*> chosen;
  for (const auto& name : names) {
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const Golden& g) { return g.name == name; });
    if (found == known.end()) {
      const auto hint = nearest(name, all);
      throw InputError(fmt::format("update_goldens: no golden \"{}\"{}", name,
                                   hint.empty() ? "" : fmt::format(", did you mean \"{}\"?", hint)));
    }
    chosen.push_back(&*found);
  }
  auto records = read_manifest(goldens / "manifest.json");
  std::vector<std::string> lines;
  for (const auto* golden : chosen) {
    const auto path = goldens / (golden->name + ".png");
    const auto picture = golden->draw();
    if (image::is_blank(picture)) throw WorkError(golden->name + ": what was drawn is blank");
    std::string change = "new";
    if (fs::exists(path))
      change = image::compare(image::read_png(path), picture, golden->tolerance).summary();
    const auto bytes = image::encode_png(picture, {}, image::small_level);
    write_atomically(path, bytes);
    records[golden->name] = {golden->made_by, plot::drawing_versions(), reason, sha256(bytes),
                             golden->tolerance};
    write_manifest(goldens / "manifest.json", records);
    lines.push_back(golden->name + ": " + change);
  }
  return lines;
}

}  // namespace chute::golden
