#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "core/random.hpp"
#include "measure/impact_histograms.hpp"

namespace impact_histograms_tests {
using namespace chute;

namespace {
constexpr double pi = 3.14159265358979323846;
constexpr std::size_t moving = 10;

Impact impact(double time, double gamma, double v_n, bool bed) {
  Impact i{};
  i.time = time, i.gamma = gamma, i.v_n = v_n, i.bead = bed ? 12 : 3;
  return i;
}
using Rows = std::map<std::pair<std::string, std::string>, std::vector<measure::HistogramRow>>;
Rows rows_of(const measure::ImpactHistograms& histograms, double start = 0) {
  Rows rows;
  for (const auto& row : histograms.result(start))
    rows[{std::string(row.pair), std::string(row.quantity)}].push_back(row);
  return rows;
}
}  // namespace

TEST_CASE("angles count modulo pi, and impacts with the bed apart from those of grains") {
  measure::ImpactHistograms histograms({4, 10, 2}, {0, 10});
  std::vector<Impact> impacts;
  impacts.push_back(impact(1, 0.1, -0.5, false));
  impacts.push_back(impact(1, 0.1 - pi, -1.5, false));  // the same line, seen from the other grain
  impacts.push_back(impact(1, 3 * pi / 8, -0.3, false));
  impacts.push_back(impact(1, -0.1, -5, true));  // in the last quarter; faster than all bins
  histograms.add(impacts, moving);
  auto rows = rows_of(histograms);
  const auto& gamma = rows.at({"grain", "gamma"});
  REQUIRE(gamma.size() == 4);
  CHECK(gamma[0].x == Approx(pi / 8));
  CHECK(gamma[0].value.mean == Approx(2.0 / 3 / (pi / 4)));
  CHECK(gamma[1].value.mean == Approx(1.0 / 3 / (pi / 4)));
  CHECK(gamma[2].value.mean == 0);
  CHECK(rows.at({"bed", "gamma"})[3].value.mean == Approx(1 / (pi / 4)));
  CHECK(rows.at({"all", "gamma"})[0].value.mean == Approx(2.0 / 4 / (pi / 4)));
  CHECK(rows.at({"grain", "v_n of gamma"})[0].value.mean == Approx(1));
  CHECK(std::isnan(rows.at({"grain", "v_n of gamma"})[2].value.mean));
  CHECK(rows.at({"grain", "v_n"})[7].value.mean == Approx(1.0 / 3 / 0.2));  // 1.5 in [1.4, 1.6)
  for (const auto& row : rows.at({"bed", "v_n"})) CHECK(row.value.mean == 0);
}

TEST_CASE("densities integrate to 1, whatever the angles are, and have errors") {
  Random random(3, Purpose::start);
  std::vector<Impact> impacts;
  for (int k = 0; k < 20000; ++k)
    impacts.push_back(impact(k / 1000.0, random.uniform(-pi, pi), -random.uniform(0, 2), k % 3 == 0));
  measure::ImpactHistograms histograms({30, 20, 2}, {0, 20});
  for (std::size_t k = 0; k < impacts.size(); k += 500)  // as a run hands them over
    histograms.add(std::span(impacts).subspan(k, 500), moving);
  auto rows = rows_of(histograms);
  for (const char* pair : {"grain", "bed", "all"})
    for (const auto& [quantity, width] : {std::pair{"gamma", pi / 30}, {"v_n", 0.1}}) {
      double sum = 0, off = 0;
      for (const auto& row : rows.at({pair, quantity})) {
        sum += row.value.mean * width;
        REQUIRE(row.value.error);
        const double sigmas = (row.value.mean - 1 / (quantity[0] == 'g' ? pi : 2)) / *row.value.error;
        off += sigmas * sigmas / static_cast<double>(rows.at({pair, quantity}).size());
      }
      CHECK(sum == Approx(1));
      CHECK(off < 3);    // even densities within their errors
      CHECK(off > 0.3);  // which are not far too large
    }
}

TEST_CASE("impacts before the start do not count") {
  measure::ImpactHistograms histograms({4, 10, 2}, {0, 10, 10});
  histograms.add(std::vector{impact(1.5, 0.1, -1, false), impact(6.5, 1.0, -1, false)}, moving);
  CHECK(rows_of(histograms).at({"grain", "gamma"})[0].value.mean > 0);
  const auto late = rows_of(histograms, 6);
  CHECK(late.at({"grain", "gamma"})[0].value.mean == 0);
  CHECK(late.at({"grain", "gamma"})[1].value.mean == Approx(4 / pi));
}

TEST_CASE("without impacts there is no histogram") {
  CHECK(measure::ImpactHistograms({4, 10, 2}, {0, 10}).result(0).empty());
}

TEST_CASE("an impact that is not a number belongs to no bin") {
  measure::ImpactHistograms histograms({4, 10, 2}, {0, 10});
  histograms.add(
      std::vector{impact(1, NAN, -1, false), impact(1, 0.1, NAN, false), impact(1, 0.1, -1, false)}, moving);
  const auto gamma = rows_of(histograms).at({"all", "gamma"});
  CHECK(gamma[0].value.mean == Approx(4 / pi));
  for (std::size_t b = 1; b < 4; ++b) CHECK(gamma[b].value.mean == 0);
}

}  // namespace impact_histograms_tests
