#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "grains.hpp"
#include "plot/geometry.hpp"
#include "view/color_map.hpp"

using namespace chute;
using grains::bare;
using grains::picture;

namespace flat_tests {

namespace {

struct Blob {
  double area = 0, x = 0, y = 0;  ///< in pixels; the centre from the picture's middle, y up
};

/// What is not transparent.
Blob blob(const image::Image& image) {
  Blob b;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double cover = image.pixel(x, y)[3] / 255.0;
      b.area += cover;
      b.x += cover * (x + 0.5 - image.width / 2.0);
      b.y += cover * (image.height / 2.0 - y - 0.5);
    }
  b.x /= b.area, b.y /= b.area;
  return b;
}

/// Of the pixels within 0.8 radii that differ from the colour `beside` the mark: their mean place from the middle (y up), the
/// direction along which they are spread most, and how far (root mean square).
struct Mark {
  plot::Point mean{0, 0}, along{0, 0};
  double spread = 0, weight = 0;
};
Mark mark(const image::Image& image, double radius, plot::Point beside) {
  const auto* plain = image.pixel(image.width / 2 + static_cast<int>(beside.x()),
                                  image.height / 2 - static_cast<int>(beside.y()));
  Mark m;
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (int j = 0; j < image.height; ++j)
    for (int i = 0; i < image.width; ++i) {
      const plot::Point p{i + 0.5 - image.width / 2.0, image.height / 2.0 - j - 0.5};
      if (p.norm() > 0.8 * radius) continue;
      const auto* seen = image.pixel(i, j);
      const double w =
          std::abs(seen[0] - plain[0]) + std::abs(seen[1] - plain[1]) + std::abs(seen[2] - plain[2]);
      m.mean += w * p, moments += w * p * p.transpose(), m.weight += w;
    }
  if (m.weight == 0) return m;
  m.mean /= m.weight;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> main(moments / m.weight);
  m.along = main.eigenvectors().col(1), m.spread = std::sqrt(main.eigenvalues()[1]);
  return m;
}

bool near_color(const std::uint8_t* pixel, view::Rgb color, int by = 1) {
  return std::abs(pixel[0] - 255 * color.r) <= by + 0.5 && std::abs(pixel[1] - 255 * color.g) <= by + 0.5 &&
         std::abs(pixel[2] - 255 * color.b) <= by + 0.5;
}

}  // namespace

TEST_CASE("A disc covers what a circle covers, where it is") {
  auto style = bare(GENERATE(64, 101, 400));
  style.background = view::Background::transparent;
  auto frame = grains::one_disc();
  frame.x[0] = 0.137, frame.y[0] = -0.271;
  const auto image = picture(frame, style);
  const double unit = 0.96 * style.width / 4;  // a bare picture leaves 2 % on each side
  const auto seen = blob(image);
  CHECK(seen.area == Approx(std::numbers::pi * unit * unit).epsilon(2e-3));
  CHECK(seen.x == Approx(0.137 * unit).margin(0.03));
  CHECK(seen.y == Approx(-0.271 * unit).margin(0.03));
}

TEST_CASE("A transparent ground is transparent, and a disc is not") {
  auto style = bare(128);
  style.background = view::Background::transparent;
  const auto image = picture(grains::one_disc(), style);
  CHECK(image.pixel(0, 0)[3] == 0);
  CHECK(image.pixel(64, 64)[3] == 255);
  style.background = view::Background::white;
  CHECK(near_color(picture(grains::one_disc(), style).pixel(0, 0), {1, 1, 1}, 0));
  style.background = view::Background::dark;
  CHECK(near_color(picture(grains::one_disc(), style).pixel(0, 0), view::palette_of(style.background).ground,
                   0));
}

TEST_CASE("A disc has the map's colour at its value") {
  auto style = bare(128);
  style.map = GENERATE("viridis", "batlow", "cividis", "rdbu_r"), style.spin = false;
  for (const double speed : {0.0, 1.0, 2.7, 4.0, 9.0}) {
    auto frame = grains::one_disc();
    frame.arrays[3].values[0] = -speed;  // the speed has no sign
    CHECK(near_color(picture(frame, style).pixel(64, 64), view::ColorMap(style.map).at(speed / 4)));
  }
}

TEST_CASE("The spin mark is a diameter that turns with the disc") {
  const auto style = bare(200);
  for (const double angle : {0.0, 1.0, std::numbers::pi / 2, 4.0}) {
    auto frame = grains::one_disc();
    frame.arrays[2].values[0] = angle;
    const plot::Point along{std::cos(angle), std::sin(angle)}, beside{-20 * along.y(), 20 * along.x()};
    const auto seen = mark(picture(frame, style), 48, beside);
    CHECK(seen.mean.norm() < 0.3);
    CHECK(std::abs(seen.along.dot(along)) > 0.9995);
    CHECK(seen.spread == Approx(0.8 * 48 / std::sqrt(3.0)).epsilon(0.02));  // all across what is looked at
  }
  auto still = style;
  still.spin = false;
  CHECK(mark(picture(grains::one_disc(), still), 48, {0, 20}).weight == 0);
}

TEST_CASE("Copies appear beyond the periodic ends, fainter the farther out") {
  auto frame = grains::one_disc();
  frame.domain = {Eigen::Vector3d(-2, 0, 0), Eigen::Vector3d(2, 0, 0)};
  frame.x[0] = 1.8, frame.radius[0] = 0.5;
  grains::add(frame, -1, 1, 0, 0.5);
  view::FrameStyle style;
  style.width = 400, style.height = 200, style.furniture = false,
  style.background = view::Background::transparent;
  style.color = "none", style.spin = false;
  const auto faint = [&] {
    const auto image = picture(frame, style);
    int count = 0;  // a copy at -2.2 is 0.31 of the way out: alpha 0.5 * 1.15 * 0.69
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) count += std::abs(image.rgba[i] - 255 * 0.395) < 2;
    return count;
  };
  CHECK(faint() < 20);
  style.copies = true;
  CHECK(faint() > 500);
}

TEST_CASE("A tilted picture has gravity downwards: the incline falls to the right") {
  auto frame = grains::small_chute();
  view::FrameStyle style;
  style.width = 300, style.height = 200, style.furniture = false,
  style.background = view::Background::transparent;
  style.tilt = true;
  const auto image = picture(frame, style);
  const auto lowest = [&](int from, int to) {
    for (int y = image.height - 1; y >= 0; --y)
      for (int x = from; x < to; ++x)
        if (image.pixel(x, y)[3] > 128) return y;
    return -1;
  };
  const int left = lowest(0, 40), right = lowest(260, 300);
  CHECK(right - left > 50);
}

TEST_CASE("The same bytes every time, with everything switched on") {
  const auto frame = grains::small_chute();
  view::FrameStyle style;
  style.width = 400, style.height = 300;
  style.arrows = style.copies = style.tilt = true;
  const auto first = picture(frame, style);
  CHECK_FALSE(image::is_blank(first));
  CHECK(first == picture(frame, style));
  style.arrows = false;
  CHECK_FALSE(first == picture(frame, style));
}

TEST_CASE("Bed grains are gray whatever they are coloured by") {
  auto style = bare(128);
  auto frame = grains::one_disc();
  grains::add(frame, 0, 0, 0, 1, 3.0, 0, 0);
  frame.x[0] = 50;  // away
  CHECK(near_color(picture(frame, style).pixel(64, 64), view::palette_of(style.background).bed));
}

TEST_CASE("A grain that has flown far away changes nothing in the picture") {
  auto style = bare(128);
  auto frame = grains::one_disc();
  const auto alone = picture(frame, style);
  grains::add(frame, 1e7, 3e6, 0, 1, 2);
  CHECK(picture(frame, style) == alone);
}

TEST_CASE("Force chains are as wide as their forces") {
  auto frame = grains::one_disc();
  frame.arrays[1].values[0] = 1;
  auto style = bare(200);
  style.chains = true, style.color = "none", style.background = view::Background::white, style.spin = false;
  view::Surveyor surveyor(style);
  surveyor.see(frame);
  for (int i = 0; i < 10; ++i) surveyor.see_force(2);
  view::FrameRenderer renderer(style, surveyor.finish());
  const auto chain_rows = [&](double force) {
    const read::ForceLink link{{-1.5, 0.5, 0}, {1.5, 0.5, 0}, force};
    const auto& image = renderer.draw({.frame = frame, .links = std::span(&link, 1)});
    double sum = 0;
    for (int y = 0; y < 200; ++y)
      sum += near_color(image.pixel(70, y), view::palette_of(style.background).chain);
    return sum;
  };
  const double wide = chain_rows(2);
  CHECK(wide == Approx(0.42 * 2 * 48).margin(2));  // 0.42 diameters for (nearly) the largest force
  CHECK(chain_rows(1) == Approx(wide / 2).margin(2));
}

TEST_CASE("A trail leads to where a grain was, through the periodic ends") {
  auto style = bare(200);
  style.background = view::Background::transparent, style.trail = 2, style.color = "none";
  auto now = grains::one_disc(), before = now, long_ago = now;
  now.domain = before.domain = long_ago.domain = {Eigen::Vector3d(-2, 0, 0), Eigen::Vector3d(2, 0, 0)};
  now.radius[0] = before.radius[0] = long_ago.radius[0] = 0.2;
  now.x[0] = 1.5, before.x[0] = 0.5, long_ago.x[0] = -0.4;
  view::Surveyor surveyor(style);
  surveyor.see(now);
  view::FrameRenderer renderer(style, surveyor.finish());
  const std::vector<const read::GrainFrame*> both{&long_ago, &before}, last{&before};
  const auto& image = renderer.draw({.frame = now, .earlier = both});
  const auto alpha = [&](double x) {
    return static_cast<int>(image.pixel(100 + static_cast<int>(48 * x), 99)[3]);
  };
  CHECK(alpha(1.0) > alpha(0.6));
  CHECK(alpha(0.6) > alpha(0.0));
  CHECK(alpha(0.0) > 0);
  CHECK(alpha(-1.0) == 0);
  before.x[0] = -1.7;  // it left at the right end and came back at the left one: the nearest copy is at 2.3
  const auto& wrapped = renderer.draw({.frame = now, .earlier = last});
  CHECK(wrapped.pixel(100 + 48, 99)[3] == 0);
  CHECK(wrapped.pixel(100 + static_cast<int>(48 * 1.85), 99)[3] > 0);
}

// Two discs that overlap by a half, as one grain: in one colour, with a rim around both and none within; as two grains the second's
// rim crosses the first.
TEST_CASE("Discs of one body are drawn as one") {
  auto style = bare(200);
  style.spin = false, style.background = view::Background::transparent;
  auto frame = grains::one_disc();
  frame.own = true;
  frame.x[0] = -0.5;
  grains::add(frame, 0.5, 0, 0, 1, 2);
  read::PointArray body{"body", 1, {7, 7}};
  frame.arrays.push_back(body);
  const double unit = 0.96 * style.width / 4;
  const auto across =
      [&](const image::Image&
              image) {  // how many pixels of the middle line, inside, differ from the middle's
        int differ = 0;
        for (int x = 100 - static_cast<int>(1.3 * unit); x < 100 + static_cast<int>(1.3 * unit); ++x)
          differ += std::abs(image.pixel(x, 100)[1] - image.pixel(100, 100)[1]) > 3;
        return differ;
      };
  const auto one = picture(frame, style);
  CHECK(across(one) == 0);
  const double lens = 2 * std::numbers::pi / 3 - std::sqrt(3.0) / 2;
  CHECK(blob(one).area == Approx((2 * std::numbers::pi - lens) * unit * unit).epsilon(2e-3));
  CHECK(std::abs(one.pixel(100 + static_cast<int>(1.49 * unit), 100)[1] - one.pixel(100, 100)[1]) >
        20);  // the rim
  frame.arrays.back().values[1] = 8;
  CHECK(across(picture(frame, style)) > 0);
}

}  // namespace flat_tests
