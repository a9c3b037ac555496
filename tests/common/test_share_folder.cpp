#include <catch2/catch.hpp>

#include "common/share_folder.hpp"

// Programs of the build folder must find what installed ones find; tests/install has those.
TEST_CASE("a program finds scenes and fonts beside itself") {
  const auto folder = chute::share_folder();
  CHECK(folder.is_absolute());
  CHECK(std::filesystem::is_regular_file(folder / "scenes" / "demo.toml"));
  CHECK(std::filesystem::is_regular_file(folder / "fonts" / "STIXGeneral-Regular.otf"));
}
