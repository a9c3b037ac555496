#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "harness.hpp"
#include "image/png.hpp"
#include "manifest.hpp"
#include "sha256.hpp"

using namespace chute;
using namespace chute::golden;
namespace fs = std::filesystem;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("chute-golden-" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path / "golden"); }
  ~Folder() { fs::remove_all(path); }
  fs::path golden() const { return path / "golden"; }
  fs::path report() const { return path / "report"; }
};

image::Image square(int from) {
  image::Image picture(40, 30);
  for (int y = from; y < from + 10; ++y)
    for (int x = from; x < from + 10; ++x) picture.pixel(x, y)[0] = 0;
  return picture;
}

Golden golden_named(const std::string& name, int from = 5) {
  return {name, "a square", [from] { return square(from); }};
}

std::string check(const Folder& folder, const Golden& golden) {
  Harness harness(folder.golden(), folder.report());
  const bool same = harness.check(golden);
  REQUIRE(same == harness.failures().empty());
  return same ? "" : harness.failures()[0].what;
}

}  // namespace

TEST_CASE("a golden that was updated passes, and nothing is left behind") {
  Folder folder;
  const auto lines = update(folder.golden(), {golden_named("a")}, {"a"}, "first");
  REQUIRE(lines == std::vector<std::string>{"a: new"});
  REQUIRE(check(folder, golden_named("a")) == "");
  REQUIRE_FALSE(fs::exists(folder.report()));
  const auto record = read_manifest(folder.golden() / "manifest.json").at("a");
  REQUIRE((record.reason == "first" && record.made_by == "a square"));
  REQUIRE(record.versions.find("Mesa") != std::string::npos);
  REQUIRE(record.sha256 == sha256(read_file(folder.golden() / "a.png")));
  REQUIRE(update(folder.golden(), {golden_named("a", 6)}, {"a"}, "moved")[0].find("a: different") == 0);
}

TEST_CASE("a missing golden fails, and is not written") {
  Folder folder;
  REQUIRE(check(folder, golden_named("a")).find("there is no golden of this name") == 0);
  REQUIRE(fs::is_empty(folder.golden()));
  REQUIRE(fs::exists(folder.report() / "a" / "actual.png"));
}

TEST_CASE("a picture that differs fails and leaves what one wants to see") {
  Folder folder;
  update(folder.golden(), {golden_named("a")}, {"a"}, "first");
  REQUIRE(check(folder, golden_named("a", 6)).find("different: 38 of 1200 pixels") == 0);
  for (const char* which : {"expected", "actual", "difference"})
    REQUIRE_NOTHROW(image::read_png(folder.report() / "a" / (std::string(which) + ".png")));
  const auto page = read_file(folder.report() / "index.html");
  REQUIRE(page.find("a/difference.png") != std::string::npos);
  REQUIRE(page.find("different: 38 of 1200") != std::string::npos);
}

TEST_CASE("one pixel by 3/255, another size, a blank and a damaged file all fail") {
  Folder folder;
  update(folder.golden(), {golden_named("a")}, {"a"}, "first");
  auto pixel = golden_named("a"), size = pixel, blank = pixel;
  pixel.draw = [] {
    auto p = square(5);
    p.pixel(30, 20)[1] -= 3;
    return p;
  };
  size.draw = [] { return image::Image(41, 30, 7); };
  blank.draw = [] { return image::Image(40, 30); };
  REQUIRE(check(folder, pixel).find("different: 1 of 1200 pixels") == 0);
  REQUIRE(check(folder, blank) == "what was drawn is blank");
  size.draw = [] {
    image::Image p(41, 30);
    p.pixel(1, 1)[0] = 0;
    return p;
  };
  REQUIRE(check(folder, size) == "different sizes: expected 40 x 30, got 41 x 30");

  const auto path = folder.golden() / "a.png";
  const auto bytes = read_file(path);
  write_atomically(path, bytes.substr(0, bytes.size() / 2));
  REQUIRE(check(folder, golden_named("a")).find("not the file that manifest.json records") !=
          std::string::npos);
  write_atomically(path, image::encode_png(square(5), {{"Title", "replaced by hand"}}));
  REQUIRE(check(folder, golden_named("a")).find("not the file that manifest.json records") !=
          std::string::npos);
  write_atomically(path, bytes);
  REQUIRE(check(folder, golden_named("a")) == "");
  fs::remove(folder.golden() / "manifest.json");
  REQUIRE(check(folder, golden_named("a")) == "the golden is not in manifest.json");
  write_atomically(folder.golden() / "manifest.json", "{\"a\": 3}");
  REQUIRE(check(folder, golden_named("a")).find("manifest.json: ") != std::string::npos);
}

TEST_CASE("an update without a reason or of an unknown name writes nothing") {
  Folder folder;
  REQUIRE_THROWS_AS(update(folder.golden(), {golden_named("a")}, {"a"}, " "), InputError);
  REQUIRE_THROWS_WITH(update(folder.golden(), {golden_named("profiles")}, {"profils"}, "why"),
                      "update_goldens: no golden \"profils\", did you mean \"profiles\"?");
  REQUIRE_THROWS_AS(update(folder.golden(), {golden_named("a"), golden_named("b")}, {"a", "c"}, "why"),
                    InputError);
  REQUIRE(fs::is_empty(folder.golden()));
}

TEST_CASE("SHA-256 of known texts") {  // FIPS 180-4, examples
  REQUIRE(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  REQUIRE(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  REQUIRE(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
          "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}
