#include <catch2/catch.hpp>

#include "core/random.hpp"
#include "figures/peaks.hpp"

namespace peaks_tests {
using chute::Purpose;
using chute::Random;
using chute::figures::find_peaks;

namespace {

void add_cluster(std::vector<double>& values, double mean, double width, int count) {
  Random random(static_cast<std::uint64_t>(count), Purpose::start);
  for (int i = 0; i < count; ++i) values.push_back(mean + width * random.normal());
}

}  // namespace

TEST_CASE("clusters of known place, width and share are found, in order") {
  std::vector<double> values;
  add_cluster(values, 0.10, 0.004, 3000);
  add_cluster(values, -0.29, 0.002, 1000);
  add_cluster(values, -0.15, 0.006, 2000);
  const auto peaks = find_peaks(values, 0.0025);
  REQUIRE(peaks.size() == 3);
  const double place[] = {-0.29, -0.15, 0.10}, width[] = {0.002, 0.006, 0.004}, share[] = {1.0, 2.0, 3.0};
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(peaks[k].position == Approx(place[k]).margin(3 * width[k] / std::sqrt(1000.0)));
    CHECK(peaks[k].width == Approx(width[k]).epsilon(0.05));
    CHECK(peaks[k].share == Approx(share[k] / 6).epsilon(1e-12));
  }
}

TEST_CASE("neighbours are told apart from some three widths on, and not when they overlap") {
  for (const double apart : {1.5, 6.0}) {
    std::vector<double> values;
    add_cluster(values, 0, 0.01, 20000);
    add_cluster(values, apart * 0.01, 0.01, 20001);
    CHECK(find_peaks(values, 0.0025).size() == (apart > 3 ? 2 : 1));
  }
}

TEST_CASE("one value is a peak without width; a handful of stray ones is none; nothing has no peaks") {
  CHECK(find_peaks({}, 0.01).empty());
  std::vector<double> values(1000, 0.2);
  auto peaks = find_peaks(values, 0.01);
  REQUIRE(peaks.size() == 1);
  CHECK(peaks[0].position == Approx(0.2));
  CHECK(peaks[0].width == Approx(0).margin(1e-12));
  for (int i = 0; i < 9; ++i) values.push_back(-0.3 + 1e-4 * i);
  peaks = find_peaks(values, 0.01);
  REQUIRE(peaks.size() == 1);
  CHECK(peaks[0].position == Approx(0.2));
}

TEST_CASE("places do not depend on where the grid of the density begins") {
  std::vector<double> values;
  add_cluster(values, 0, 0.003, 5000);
  add_cluster(values, 0.05, 0.003, 5001);
  const auto before = find_peaks(values, 0.004);
  for (auto& v : values) v += 1000.123;
  const auto after = find_peaks(values, 0.004);
  REQUIRE(before.size() == 2);
  REQUIRE(after.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) CHECK(after[k].position - before[k].position == Approx(1000.123));
}

TEST_CASE("what is not a number is in no peak") {
  const std::vector<double> values{NAN, 1, 1.001, 0.999, NAN};
  const auto peaks = chute::figures::find_peaks(values, 0.01);
  REQUIRE(peaks.size() == 1);
  CHECK(peaks[0].position == Approx(1));
  CHECK(chute::figures::find_peaks(std::vector<double>{NAN, NAN}, 0.01).empty());
}

}  // namespace peaks_tests
