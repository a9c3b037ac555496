#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/compare_tables.hpp"
#include "app/numbers.hpp"
#include "app/rasterised.hpp"
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
  std::string max_pixels;
  std::optional<double> rms, ssim;
  double rtol = 0, atol = 0;
  bool json = false;
};

/// Pictures of one name, and where the difference goes, if it is wanted.
struct Pair {
  std::string name;
  fs::path expected, actual;
  std::optional<fs::path> difference;
};

/// What of a difference is allowed; what is not given does not matter as soon as something is.
struct Budget {
  std::optional<double> pixels, share, rms, ssim;
  bool given() const { return pixels || share || rms || ssim; }
  bool holds(const image::Comparison& n) const {
    const auto over = static_cast<double>(n.over);
    return n.same_size && over <= pixels.value_or(over) &&
           over <= share.value_or(1) * static_cast<double>(n.pixels) && n.rms <= rms.value_or(n.rms) &&
           n.ssim >= ssim.value_or(n.ssim);
  }
};

Budget budget_of(const CompareArguments& a) {
  Budget budget{{}, {}, a.rms, a.ssim};
  if (a.max_pixels.empty()) return budget;
  const bool percent = a.max_pixels.ends_with('%');
  constexpr const char* expected = "a number of pixels, or a part of them such as 0.1%";
  const auto values =
      numbers("--max-pixels", a.max_pixels.substr(0, a.max_pixels.size() - percent), ':', expected);
  require(values.size() == 1 && values[0] >= 0, "--max-pixels", a.max_pixels, expected);
  if (percent)
    budget.share = values[0] / 100;
  else
    budget.pixels = values[0];
  return budget;
}

bool is_table(const fs::path& file) { return file.extension() == ".csv"; }

std::set<fs::path> files_in(const fs::path& folder) {
  std::set<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && (is_picture(entry.path()) || is_table(entry.path())))
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
    auto names = files_in(expected);
    names.merge(files_in(a.actual[0]));
    for (const auto& name : names)
      pairs.push_back({name.string(), expected / name, fs::path(a.actual[0]) / name, difference(name)});
    if (pairs.empty())
      throw InputError(a.expected + ": no pictures (PNG, PDF, SVG) and no tables (CSV) in these folders");
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
  image::Comparison numbers{};
  std::optional<TableComparison> table{};  ///< of tables
  bool same() const { return missing.empty() && (table ? table->same() : numbers.passes); }
};

Outcome compare(const Pair& pair, const CompareArguments& a, bool both_must_be) {
  for (const auto* file : {&pair.expected, &pair.actual})
    if (!both_must_be && !fs::exists(*file)) return {pair.name, file->string()};
  if (is_table(pair.expected) != is_table(pair.actual))
    throw InputError(fmt::format("{} and {}: a picture and a table cannot be compared",
                                 pair.expected.string(), pair.actual.string()));
  if (is_table(pair.expected)) {
    Outcome outcome{pair.name, ""};
    outcome.table = compare_tables(pair.expected, pair.actual, a.rtol, a.atol);
    return outcome;
  }
  image::Tolerance tolerance;
  tolerance.channel = a.tolerance;
  const auto before = read_picture(pair.expected), after = read_picture(pair.actual);
  auto result = image::compare(before, after, tolerance);
  if (const auto budget = budget_of(a); budget.given()) result.passes = budget.holds(result);
  if (pair.difference && !result.passes) {
    if (pair.difference->has_parent_path()) fs::create_directories(pair.difference->parent_path());
    image::write_png(*pair.difference, image::difference(before, after));
  }
  return {pair.name, "", result};
}

void show(const Outcome& outcome) {
  if (outcome.missing.empty())
    fmt::print("{}: {}\n", outcome.name,
               outcome.table ? outcome.table->summary() : outcome.numbers.summary());
  else
    fmt::print("{}: missing: {}\n", outcome.name, outcome.missing);
}

nlohmann::ordered_json as_json(const Outcome& outcome) {
  nlohmann::ordered_json json{{"name", outcome.name}, {"same", outcome.same()}};
  if (!outcome.missing.empty()) {
    json["missing"] = outcome.missing;
    return json;
  }
  if (const auto& t = outcome.table) {
    json["cells"] = t->cells, json["over"] = t->over;
    if (!t->shape.empty()) json["shape"] = t->shape;
    if (t->over > 0) json["worst_at"] = t->worst_at;
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
  budget_of(a);  // a slip in it is told before anything is compared
  const auto pairs = pairs_of(a);
  std::size_t different = 0;
  auto pictures = nlohmann::ordered_json::array();
  for (const auto& pair : pairs) {
    const auto outcome = compare(pair, a, !fs::is_directory(a.expected));
    if (!outcome.same()) ++different;
    if (a.json)
      pictures.push_back(as_json(outcome));
    else
      show(outcome);
  }
  if (a.json)
    fmt::print("{}\n", nlohmann::ordered_json{{"pictures", pictures}, {"different", different}}.dump(
                           2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  if (!different) return;
  if (pairs.size() == 1) throw WorkError(fmt::format("{} differs from {}", a.actual[0], a.expected));
  throw WorkError(fmt::format("{} of {} files differ", different, pairs.size()));
}

}  // namespace

void add_compare(CLI::App& app) {
  auto* verb = app.add_subcommand("compare", "Compare pictures and tables, or folders of them");
  auto a = std::make_shared<CompareArguments>();
  verb->add_option("expected", a->expected, "a picture (PNG, PDF, SVG), a table (CSV), or a folder of them")
      ->required();
  verb->add_option("actual", a->actual,
                   "what to compare with it: a file, a folder, or several files if `expected` is a folder "
                   "that holds one of each name")
      ->required();
  verb->add_option(
      "--diff", a->difference,
      "where pictures differ: write what differs, amplified, to this PNG (this folder, for a folder)");
  verb->add_option("--tolerance", a->tolerance,
                   "largest difference of a colour channel, of 255, that still counts as same")
      ->check(CLI::Range(0, 255))
      ->capture_default_str();
  verb->add_option("--max-pixels", a->max_pixels,
                   "so many pixels, or 0.1% of them, may differ by more; default none");
  verb->add_option("--rms", a->rms, "instead: largest root mean square over the channels, of 255")
      ->check(not_negative);
  verb->add_option("--ssim", a->ssim, "instead: least mean structural similarity, 1 of equal pictures")
      ->check(CLI::Range(-1.0, 1.0));
  verb->add_option("--rtol", a->rtol, "tables: numbers a and b are the same if |a - b| <= atol + rtol |a|")
      ->check(not_negative);
  verb->add_option("--atol", a->atol, "tables: see --rtol; both 0: the same numbers")->check(not_negative);
  verb->add_flag("--json", a->json, "for programs: keys as in README.md");
  verb->footer(
      "Exit status: 0 same, 1 different, 2 a file is wrong.\n"
      "Example: chute compare golden/fig-4-10.png out/figures/fig-4-10.png --diff difference.png\n"
      "         chute compare expected/ out/figures/*.png --diff out/differences\n"
      "         chute compare expected/profiles.csv out/demo/profiles.csv --rtol 1e-6 --atol 1e-12");
  verb->callback([a] { run(*a); });
}

}  // namespace chute::app
