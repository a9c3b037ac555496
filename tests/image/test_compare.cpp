#include <catch2/catch.hpp>

#include "image/compare.hpp"

using namespace chute::image;

namespace {

Image ramp(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.pixel(x, y)[0] = std::uint8_t((3 * x + 2 * y) % 256);
  return image;
}

}  // namespace

TEST_CASE("equal pictures are the same, and say so") {
  const auto c = compare(ramp(40, 30), ramp(40, 30));
  REQUIRE(c.passes);
  REQUIRE((c.differing == 0 && c.worst == 0 && c.rms == 0 && c.ssim == 1));
  REQUIRE(c.summary().find("same: 0 of 1200 pixels differ") == 0);
}

TEST_CASE("one channel of one pixel decides: 2/255 passes, 3/255 fails") {
  const auto expected = ramp(40, 30);
  for (int channel = 0; channel < 4; ++channel)
    for (int change : {2, 3}) {
      auto actual = expected;
      actual.pixel(17, 5)[channel] = std::uint8_t(expected.pixel(17, 5)[channel] ^ 0);
      auto& value = actual.pixel(17, 5)[channel];
      value = std::uint8_t(value >= change ? value - change : value + change);
      const auto c = compare(expected, actual);
      REQUIRE(c.passes == (change == 2));
      REQUIRE((c.differing == 1 && c.worst == change && c.worst_x == 17 && c.worst_y == 5));
      REQUIRE(c.over == (change == 3 ? 1u : 0u));
      REQUIRE(c.rms == Approx(change / std::sqrt(4 * 1200.)));
    }
}

TEST_CASE("different sizes differ, whatever they show") {
  const auto c = compare(Image(40, 30), Image(30, 40));
  REQUIRE_FALSE(c.passes);
  REQUIRE(c.summary() == "different sizes: expected 40 x 30, got 30 x 40");
  const auto d = difference(Image(40, 30), Image(30, 40));
  REQUIRE((d.width == 40 && d.height == 40));
}

TEST_CASE("a blank picture is told from a drawn one") {
  REQUIRE(is_blank(Image(20, 20)));
  REQUIRE(is_blank(Image{}));
  auto image = Image(20, 20);
  image.pixel(19, 19)[2] = 254;
  REQUIRE_FALSE(is_blank(image));
  REQUIRE_FALSE(compare(ramp(20, 20), Image(20, 20)).passes);
}

TEST_CASE("a tolerance may let a small share differ by a little") {
  const Tolerance loose{2, 2e-4, 16};
  const auto expected = Image(100, 100);
  auto actual = expected;
  actual.pixel(3, 3)[0] -= 16, actual.pixel(60, 3)[0] -= 16;
  REQUIRE(compare(expected, actual, loose).passes);  // 2 of 10000
  REQUIRE_FALSE(compare(expected, actual).passes);
  actual.pixel(3, 3)[0] -= 1;
  REQUIRE_FALSE(compare(expected, actual, loose).passes);  // over 16
  actual.pixel(3, 3)[0] += 1, actual.pixel(9, 9)[1] -= 3;
  REQUIRE_FALSE(compare(expected, actual, loose).passes);  // a third one
}

TEST_CASE("structural similarity falls with what is seen") {
  const auto expected = ramp(64, 64);
  auto slight = expected, gross = expected;
  for (int i = 10; i < 50; ++i) slight.pixel(i, i)[0] ^= 8;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) gross.pixel(x, y)[0] = 128;
  const double a = compare(expected, slight).ssim, b = compare(expected, gross).ssim;
  REQUIRE((a < 1 && a > b && b > 0));
}

TEST_CASE("the difference shows where, and only there") {
  const auto expected = ramp(20, 20);
  auto actual = expected;
  actual.pixel(4, 7)[1] -= 1;
  const auto d = difference(expected, actual);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) REQUIRE((d.pixel(x, y)[0] != d.pixel(x, y)[1]) == (x == 4 && y == 7));
}
