// A line of beads whose roughness is a parameter.
#include <catch2/catch.hpp>
#include <cmath>

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
