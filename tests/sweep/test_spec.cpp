#include <catch2/catch.hpp>

#include "common/error.hpp"
#include "folder.hpp"
#include "sweep/sweep_file.hpp"

using namespace chute;
using namespace chute::sweep;
using test::Folder;

namespace {

SweepSpec read(const std::string& text) {
  const Folder folder;
  test::write(folder / "s.toml", text);
  return read_sweep(Base(folder / "s.toml"));
}

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("an axis has the values that it says, without dust") {
  const auto spec =
      read("[sweep]\n[[sweep.axis]]\nkey = \"incline.sin\"\nfrom = 0.02\nto = 0.16\ncount = 8\n");
  CHECK(spec.axes.at(0).points() == std::vector{0.02, 0.04, 0.06, 0.08, 0.1, 0.12, 0.14, 0.16});
  CHECK(spec.axes.at(0).setting(0.1) == "incline.sin=0.1");
  const auto degrees =
      read("[sweep]\n[[sweep.axis]]\nkey = \"incline.angle\"\nvalues = [12.6, 18]\nunit = \"deg\"\n");
  CHECK(degrees.axes.at(0).setting(12.6) == "incline.angle=\"12.6 deg\"");
}

TEST_CASE("the grid holds every combination once, the last axis fastest") {
  const auto spec = read(
      "[sweep]\n[[sweep.axis]]\nkey = \"a\"\nvalues = [1, 2]\n[[sweep.axis]]\nkey = \"b\"\nvalues = [3, 4, "
      "5]\n");
  const auto places = grid(spec.axes);
  REQUIRE(places.size() == 6);
  CHECK(places[0].set == std::vector<std::string>{"a=1", "b=3"});
  CHECK(places[1].values == std::vector{1.0, 4.0});
  CHECK(places[5].set == std::vector<std::string>{"a=2", "b=5"});
}

TEST_CASE("what a sweep lacks is said with its line") {
  CHECK_THAT(refusal("title = \"x\"\n"), Catch::Contains("has no [sweep]"));
  CHECK_THAT(refusal("[sweep]\nseeds = 2\n"), Catch::Contains("s.toml:1: sweep.axis: a sweep needs an axis"));
  CHECK_THAT(refusal("[sweep]\n[[sweep.axis]]\nkey = \"a\"\nvalues = [2, 1]\n"),
             Catch::Contains("must ascend"));
  CHECK_THAT(refusal("[sweep]\n[[sweep.axis]]\nkey = \"a\"\nfrom = 1\nto = 2\n"),
             Catch::Contains("give either values = [ … ] or from, to and count"));
  CHECK_THAT(refusal("[sweep]\n[[sweep.axis]]\nkey = \"a\"\nvalues = [1]\ncout = 3\n"),
             Catch::Contains("did you mean count?"));
}
