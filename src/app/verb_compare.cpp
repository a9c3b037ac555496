#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/verbs.hpp"
#include "common/error.hpp"
#include "image/compare.hpp"
#include "image/png.hpp"

namespace chute::app {
namespace {
namespace fs = std::filesystem;

struct CompareArguments {
  std::string expected, difference;
  std::vector<std::string> actual;
  int tolerance = image::strict.channel;
  bool json = false;
};

/// Pictures of one name, and where the difference goes, if it is wanted.
struct Pair {
  std::string name;
  fs::path expected, actual;
  std::optional<fs::path> difference;
};

std::set<fs::path> pictures_in(const fs::path& folder) {
  std::set<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() == ".png")
      found.insert(fs::relative(entry.path(), folder));
  return found;
}

/// What is compared with what: two pictures; each of several with the one of its name in a folder; two
/// folders, by name, where one that only one of them has is a difference.
std::vector<Pair> pairs_of(const CompareArguments& a) {
  const fs::path expected = a.expected;
  const auto difference = [&](const fs::path& name) {
    return a.difference.empty() ? std::nullopt : std::optional(fs::path(a.difference) / name);
  };
  const bool folder = fs::is_directory(expected);
  std::vector<Pair> pairs;
  if (folder && a.actual.size() == 1 && fs::is_directory(a.actual[0])) {
    auto names = pictures_in(expected);
    names.merge(pictures_in(a.actual[0]));
    for (const auto& name : names)
      pairs.push_back({name.string(), expected / name, fs::path(a.actual[0]) / name, difference(name)});
    if (pairs.empty()) throw InputError(a.expected + ": no PNG pictures in these folders");
    return pairs;
  }
  for (const auto& actual : a.actual) {
    if (fs::is_directory(actual))
      throw InputError(fmt::format("{}: compare two pictures or two folders, not one of each", actual));
    const auto name = fs::path(actual).filename();
    if (folder)
      pairs.push_back({name.string(), expected / name, actual, difference(name)});
    else
      pairs.push_back({name.string(), expected, actual,
                       a.difference.empty() ? std::nullopt : std::optional<fs::path>(a.difference)});
  }
  if (!folder && pairs.size() > 1)
    throw InputError(a.expected + ": several pictures are compared with a folder that holds one for each");
  return pairs;
}

/// What came of a pair.
struct Outcome {
  std::string name, missing;  ///< the file that is not there, if one is not
  image::Comparison numbers;
  bool same() const { return missing.empty() && numbers.passes; }
};

Outcome compare(const Pair& pair, const image::Tolerance& tolerance, bool both_must_be) {
  for (const auto* file : {&pair.expected, &pair.actual})
    if (!both_must_be && !fs::exists(*file)) return {pair.name, file->string(), {}};
  const auto before = image::read_png(pair.expected), after = image::read_png(pair.actual);
  const auto result = image::compare(before, after, tolerance);
  if (pair.difference && !result.passes) {
    if (pair.difference->has_parent_path()) fs::create_directories(pair.difference->parent_path());
    image::write_png(*pair.difference, image::difference(before, after));
  }
  return {pair.name, "", result};
}

void show(const Outcome& outcome) {
  if (outcome.missing.empty())
    fmt::print("{}: {}\n", outcome.name, outcome.numbers.summary());
  else
    fmt::print("{}: missing: {}\n", outcome.name, outcome.missing);
}

nlohmann::ordered_json as_json(const Outcome& outcome) {
  nlohmann::ordered_json json{{"name", outcome.name}, {"same", outcome.same()}};
  if (!outcome.missing.empty()) {
    json["missing"] = outcome.missing;
    return json;
  }
  const auto& n = outcome.numbers;
  json["expected_size"] = {n.expected_width, n.expected_height};
  json["actual_size"] = {n.actual_width, n.actual_height};
  if (!n.same_size) return json;
  json["pixels"] = n.pixels, json["differing"] = n.differing, json["over"] = n.over;
  json["worst"] = n.worst, json["worst_at"] = {n.worst_x, n.worst_y};
  json["rms"] = n.rms, json["ssim"] = n.ssim;
  return json;
}

void run(const CompareArguments& a) {
  image::Tolerance tolerance;
  tolerance.channel = a.tolerance;
  const auto pairs = pairs_of(a);
  std::size_t different = 0;
  auto pictures = nlohmann::ordered_json::array();
  for (const auto& pair : pairs) {
    const auto outcome = compare(pair, tolerance, !fs::is_directory(a.expected));
    if (!outcome.same()) ++different;
    if (a.json)
      pictures.push_back(as_json(outcome));
    else
      show(outcome);
  }
  if (a.json)
    fmt::print("{}\n", nlohmann::ordered_json{{"pictures", pictures}, {"different", different}}.dump(2));
  if (!different) return;
  if (pairs.size() == 1) throw WorkError(fmt::format("{} differs from {}", a.actual[0], a.expected));
  throw WorkError(fmt::format("{} of {} pictures differ", different, pairs.size()));
}

}  // namespace

void add_compare(CLI::App& app) {
  auto* verb = app.add_subcommand("compare", "Compare pictures, or folders of pictures, pixel by pixel");
  auto a = std::make_shared<CompareArguments>();
  verb->add_option("expected", a->expected, "a PNG picture or a folder of them")->required();
  verb->add_option(
          "actual", a->actual,
          "what to compare with it: a picture, a folder, or several pictures if `expected` is a folder "
          "that holds one of each name")
      ->required();
  verb->add_option(
      "--diff", a->difference,
      "where pictures differ: write what differs, amplified, to this PNG (this folder, for a folder)");
  verb->add_option("--tolerance", a->tolerance,
                   "largest difference of a colour channel, of 255, that still counts as same")
      ->check(CLI::Range(0, 255))
      ->capture_default_str();
  verb->add_flag("--json", a->json, "for programs: keys as in README.md");
  verb->footer(
      "Exit status: 0 same, 1 different, 2 a file is wrong.\n"
      "Example: chute compare golden/fig-4-10.png out/figures/fig-4-10.png --diff difference.png\n"
      "         chute compare expected/ out/figures/*.png --diff out/differences");
  verb->callback([a] { run(*a); });
}

}  // namespace chute::app
