// A line of beads whose roughness is a parameter.
#include <catch2/catch.hpp>
#include <cmath>

#include "beds/lattice.hpp"
#include "beds/rough.hpp"

using namespace chute;

TEST_CASE(
    "beads of any size and gap fill the length evenly, with the gap that was asked for or a little more") {
  beds::Rough bed;
  bed.length = 30;
  for (const double diameter : {0.25, 0.7, 1.0, 2.0})
    for (const double gap : {0.0, 0.25, 0.5}) {
      bed.diameter = diameter, bed.gap = gap;
      const auto ground = bed.lay({2, 1});
      const auto n = static_cast<double>(ground.beads.size());
      CAPTURE(diameter, gap);
      CHECK(ground.spacing == Approx(30 / n));
      CHECK(ground.spacing >= diameter * (1 + gap) * (1 - 1e-9));
      CHECK(30 / (n + 1) < diameter * (1 + gap));  // one more would not fit
      CHECK(ground.length == 30);
      for (std::size_t i = 1; i < ground.beads.size(); ++i)
        CHECK(ground.beads[i].along - ground.beads[i - 1].along == Approx(ground.spacing));
    }
}

TEST_CASE("a second layer closes the gaps: its beads touch the two above, or leave no way through") {
  beds::Rough bed;
  bed.length = 30, bed.layers = 2;
  for (const double gap : {0.0, 0.25, 0.5}) {
    bed.gap = gap;
    const auto ground = bed.lay({2, 1});
    const auto count = ground.beads.size() / 2;
    for (std::size_t i = 0; i < count; ++i) {
      const auto &above = ground.beads[i], &below = ground.beads[count + i];
      CHECK(below.along == Approx(above.along - ground.spacing / 2));
      CHECK(std::hypot(below.along - above.along, below.above) == Approx(1));
    }
  }
}

TEST_CASE("heights scatter as far as was asked, about 0, and the same seed gives the same bed") {
  beds::Rough bed;
  bed.length = 20000, bed.height_std = 0.2;
  double mean = 0, square = 0, highest = 0;
  const auto ground = bed.lay({2, 4});
  for (const auto& bead : ground.beads) {
    mean += bead.above / 20000, square += bead.above * bead.above / 20000;
    highest = std::max(highest, std::abs(bead.above));
  }
  CHECK(mean == Approx(0).margin(4 * 0.2 / std::sqrt(20000)));
  // A gaussian that ends at three standard deviations has a variance of 0.9733 of them.
  CHECK(std::sqrt(square - mean * mean) == Approx(0.2 * std::sqrt(0.97334)).epsilon(0.02));
  CHECK(highest <= 0.6);
  CHECK(bed.lay({2, 4}).beads[7].above == ground.beads[7].above);
  CHECK(bed.lay({2, 5}).beads[7].above != ground.beads[7].above);
  bed.height_std = 0.3;
  CHECK(bed.misfit({2, 1})->key == "bed.height_std");
  CHECK(bed.misfit({3, 1})->key == "bed.kind");
}

namespace {

/// Distance of two beads of a bed that repeats along and across.
double apart(const beds::Ground& ground, const beds::Bead& a, const beds::Bead& b) {
  const double dx = a.along - b.along, dy = a.across - b.across, dz = a.above - b.above;
  const double x = dx - *ground.length * std::round(dx / *ground.length),
               y = dy - *ground.width * std::round(dy / *ground.width);
  return std::sqrt(x * x + y * y + dz * dz);
}

}  // namespace

TEST_CASE("a second layer of a lattice touches three or four beads of the first, and none overlap") {
  beds::Lattice bed;
  bed.arrangement = GENERATE(beds::Lattice::Arrangement::square, beds::Lattice::Arrangement::triangular);
  const bool square = bed.arrangement == beds::Lattice::Arrangement::square;
  bed.count = 7, bed.count_across = 6, bed.layers = 2;
  for (const double gap : {0.0, 0.1, 0.2}) {
    bed.gap = gap;
    const auto ground = bed.lay({3, 1});
    const std::size_t count = ground.beads.size() / 2;
    REQUIRE(count == 42);
    for (std::size_t i = 0; i < 2 * count; ++i) {
      const auto& bead = ground.beads[i];
      CHECK((bead.along >= 0 && bead.along < *ground.length));
      CHECK((bead.across >= 0 && bead.across < *ground.width));
      int touching = 0;
      for (std::size_t j = 0; j < 2 * count; ++j) {
        if (i == j) continue;
        const double distance = apart(ground, bead, ground.beads[j]);
        CHECK(distance > 1 - 1e-9);
        if ((i < count) != (j < count) && distance < 1 + 1e-9) ++touching;
      }
      CAPTURE(gap, i);
      CHECK(touching == (square ? 4 : 3));
    }
  }
}

TEST_CASE("heights of a lattice are those of a line with the same seed") {
  beds::Lattice bed;
  bed.count = 10, bed.count_across = 10;
  const auto flat = bed.lay({3, 4});
  for (const auto& bead : flat.beads) CHECK(bead.above == 0);
  bed.height_std = 0.2;
  beds::Rough line;
  line.length = 100, line.height_std = 0.2;
  const auto ground = bed.lay({3, 4}), other = line.lay({2, 4});
  for (std::size_t i = 0; i < 100; ++i) {
    CHECK(ground.beads[i].along == flat.beads[i].along);
    CHECK(ground.beads[i].above == other.beads[i].above);
  }
  bed.height_std = 0.3;
  CHECK(bed.misfit({3, 1})->key == "bed.height_std");
}
