#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "common/error.hpp"
#include "view/series_plot.hpp"

using namespace chute;
using namespace chute::view;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace series_plot_tests {

namespace {

TimeSeries straight() {
  TimeSeries series;
  series.columns = {{"v_x", {}}};
  for (int i = 0; i <= 10; ++i) series.times.push_back(i), series.columns[0].values.push_back(2.0 * i);
  return series;
}

/// How far to the right and up the strong curve and its dot reach, pixels.
struct Reach {
  int right = -1, top = 1 << 20;
};
Reach reach(const TimeSeries& series, double time) {
  const SeriesPlot plot(series, "reduced", Background::white, {0, 0, 400, 200}, 12);
  image::Image before(400, 200), after(400, 200);
  plot.stand(before), plot.stand(after);
  plot.put_on(after, time);
  Reach r;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 400; ++x)
      if (!std::equal(before.pixel(x, y), before.pixel(x, y) + 4, after.pixel(x, y)))
        r.right = std::max(r.right, x), r.top = std::min(r.top, y);
  return r;
}

std::string failure(const std::string& text, const std::vector<std::string>& columns) {
  const auto file = fs::temp_directory_path() / "chute-series.csv";
  std::ofstream(file) << text;
  try {
    read_time_series(file, columns);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("The curve grows with time, evenly for an even rise") {
  const auto series = straight();
  const Reach a = reach(series, 2.5), b = reach(series, 5), c = reach(series, 7.5);
  CHECK(b.right - a.right > 50);
  CHECK(std::abs((c.right - b.right) - (b.right - a.right)) <= 1);
  CHECK(a.top - b.top > 15);
  CHECK(std::abs((b.top - c.top) - (a.top - b.top)) <= 1);
  CHECK(reach(series, 30).right == reach(series, 10).right);
  CHECK(reach(series, -1).right == -1);  // nothing yet
}

TEST_CASE("A gap in the values is a gap in the curve, and no dot stands there") {
  auto series = straight();
  series.columns[0].values[5] = std::nan("");
  CHECK(reach(series, 5.4).right < reach(series, 4).right);  // the curve to 4, without its dot
  CHECK(reach(series, 6).right > reach(series, 4).right);
}

TEST_CASE("Columns have names and units of physics, others their own") {
  CHECK(column_title("v_x", "SI") == "mean velocity $\\bar{v}_x$ (m/s)");
  CHECK(column_title("v_x", "reduced") == "mean velocity $\\bar{v}_x$ ($\\sqrt{gd}$)");
  CHECK(column_title("contacts", "SI") == "number of contacts");
  CHECK(column_title("mu=0.5", "SI") == "$\\mu=0.5$");
}

TEST_CASE("A table that is no series is refused in one line") {
  CHECK(failure("time,v_x\n0,1\n1,2\n", {"v_x"}).empty());
  CHECK_THAT(failure("time,v_x\n0,1\n1,2\n", {"v_y"}), Contains("no column \"v_y\", did you mean \"v_x\"?"));
  CHECK_THAT(failure("time,v_x\n0,1\n0,2\n", {"v_x"}), Contains(":3: time must rise"));
  CHECK_THAT(failure("time,v_x\n0,1\n", {"v_x"}), Contains("two at least"));
  CHECK_THAT(failure("t,v_x\n0,1\n1,2\n", {"v_x"}), Contains("time"));
}

TEST_CASE("A place too small for axes is refused") {
  const auto series = straight();
  CHECK_THROWS_WITH(SeriesPlot(series, "SI", Background::white, {0, 0, 30, 20}, 12), Contains("too small"));
}

}  // namespace series_plot_tests
