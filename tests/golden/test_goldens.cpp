#include <catch2/catch.hpp>
#include <filesystem>
#include <set>

#include "harness.hpp"
#include "image/png.hpp"
#include "manifest.hpp"

using namespace chute;
using namespace chute::golden;
namespace fs = std::filesystem;

namespace {

const fs::path folder = fs::path(CHUTE_SOURCE_DIR) / "golden";

/// Pixels by which the two differ beyond the golden's tolerance; all of them if the sizes differ.
std::size_t pixels_apart(const image::Image& a, const image::Image& b, image::Tolerance tolerance) {
  const auto c = image::compare(a, b, tolerance);
  return c.same_size ? c.over : c.pixels;
}

}  // namespace

TEST_CASE("every golden is drawn as it was recorded") {
  fs::remove_all(CHUTE_GOLDEN_REPORT);
  Harness harness(folder, CHUTE_GOLDEN_REPORT);
  for (const auto& golden : all_goldens()) {
    INFO(golden.name);
    const bool same = harness.check(golden);
    if (!same)
      UNSCOPED_INFO(harness.failures().back().what << "\nsee " << CHUTE_GOLDEN_REPORT << "/index.html");
    CHECK(same);
  }
}

TEST_CASE("goldens, manifest and code name the same pictures, each with its reason") {
  std::set<std::string> named, recorded, stored;
  for (const auto& g : all_goldens()) REQUIRE(named.insert(g.name).second);
  for (const auto& [name, record] : read_manifest(folder / "manifest.json")) {
    recorded.insert(name);
    REQUIRE_FALSE(record.reason.empty());
    REQUIRE_FALSE(record.versions.empty());
    REQUIRE_FALSE(record.made_by.empty());
  }
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".png") stored.insert(entry.path().stem().string());
  REQUIRE(named == recorded);
  REQUIRE(named == stored);
  for (const auto& g : all_goldens()) {
    const auto t = read_manifest(folder / "manifest.json").at(g.name).tolerance;
    REQUIRE(
        (t.channel == g.tolerance.channel && t.share == g.tolerance.share && t.limit == g.tolerance.limit));
  }
}

TEST_CASE("every mutant is noticed, by 50 pixels at least") {
  for (const auto& golden : all_goldens()) {
    const auto expected = image::read_png(folder / (golden.name + ".png"));
    REQUIRE_FALSE(golden.mutants.empty());
    for (const auto& mutant : golden.mutants) {
      INFO(golden.name << ": " << mutant.what);
      const auto drawn = mutant.draw();
      CHECK_FALSE(image::compare(expected, drawn, golden.tolerance).passes);
      CHECK(pixels_apart(expected, drawn, golden.tolerance) >= 50);
    }
  }
}

TEST_CASE("every two goldens differ") {
  const auto goldens = all_goldens();
  std::vector<image::Image> pictures;
  for (const auto& g : goldens) pictures.push_back(image::read_png(folder / (g.name + ".png")));
  for (std::size_t i = 0; i < pictures.size(); ++i)
    for (std::size_t k = i + 1; k < pictures.size(); ++k) {
      INFO(goldens[i].name << " and " << goldens[k].name);
      REQUIRE(pixels_apart(pictures[i], pictures[k], goldens[i].tolerance) >= 50);
    }
}

TEST_CASE("a referee finds nothing wrong with the plots") {
  for (const auto& finding : referee_on_plots()) FAIL_CHECK(finding);
}
