#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "app/verbs.hpp"
#include "common/error.hpp"
#include "image/compare.hpp"
#include "image/png.hpp"

namespace chute::app {
namespace {
namespace fs = std::filesystem;

struct CompareArguments {
  std::string expected, actual, difference;
  int tolerance = image::strict.channel;
};

image::Tolerance tolerance_of(const CompareArguments& a) {
  image::Tolerance tolerance;
  tolerance.channel = a.tolerance;
  return tolerance;
}

/// Prints the numbers; true if the pictures are the same.
bool compare_files(const CompareArguments& a, const fs::path& expected, const fs::path& actual,
                   const std::optional<fs::path>& difference, const std::string& name) {
  const auto before = image::read_png(expected), after = image::read_png(actual);
  const auto result = image::compare(before, after, tolerance_of(a));
  fmt::print("{}: {}\n", name, result.summary());
  if (difference && !result.passes) image::write_png(*difference, image::difference(before, after));
  return result.passes;
}

std::set<fs::path> pictures_in(const fs::path& folder) {
  std::set<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() == ".png")
      found.insert(fs::relative(entry.path(), folder));
  return found;
}

/// Compares the pictures of two folders by name; a picture that only one of them has is a difference.
void compare_folders(const CompareArguments& a) {
  const auto expected = pictures_in(a.expected), actual = pictures_in(a.actual);
  if (expected.empty()) throw InputError(a.expected + ": no PNG pictures in this folder");
  std::size_t different = 0;
  for (const auto& name : expected) {
    if (!actual.count(name)) {
      fmt::print("{}: missing in {}\n", name.string(), a.actual);
      ++different;
      continue;
    }
    std::optional<fs::path> difference;
    if (!a.difference.empty()) {
      difference = fs::path(a.difference) / name;
      fs::create_directories(difference->parent_path());
    }
    if (!compare_files(a, a.expected / name, a.actual / name, difference, name.string())) ++different;
  }
  for (const auto& name : actual)
    if (!expected.count(name)) {
      fmt::print("{}: only in {}\n", name.string(), a.actual);
      ++different;
    }
  if (different)
    throw WorkError(
        fmt::format("{} of {} pictures differ", different, std::max(expected.size(), actual.size())));
}

void run(const CompareArguments& a) {
  const bool folders = fs::is_directory(a.expected);
  if (folders != fs::is_directory(a.actual))
    throw InputError(fmt::format("{}: compare two pictures or two folders, not one of each", a.actual));
  if (folders) return compare_folders(a);
  const std::optional<fs::path> difference =
      a.difference.empty() ? std::nullopt : std::optional<fs::path>(a.difference);
  if (!compare_files(a, a.expected, a.actual, difference, fs::path(a.actual).filename().string()))
    throw WorkError(fmt::format("{} differs from {}", a.actual, a.expected));
}

}  // namespace

void add_compare(CLI::App& app) {
  auto* verb =
      app.add_subcommand("compare", "Compare two pictures, or two folders of pictures, pixel by pixel");
  auto a = std::make_shared<CompareArguments>();
  verb->add_option("expected", a->expected, "a PNG picture or a folder of them")->required();
  verb->add_option("actual", a->actual, "what to compare with it")->required();
  verb->add_option(
      "--diff", a->difference,
      "where pictures differ: write what differs, amplified, to this PNG (this folder, for folders)");
  verb->add_option("--tolerance", a->tolerance,
                   "largest difference of a colour channel, of 255, that still counts as same")
      ->check(CLI::Range(0, 255))
      ->capture_default_str();
  verb->footer(
      "Exit status: 0 same, 1 different, 2 a file is wrong.\n"
      "Example: chute compare golden/fig-4-10.png out/figures/fig-4-10.png --diff difference.png");
  verb->callback([a] { run(*a); });
}

}  // namespace chute::app
