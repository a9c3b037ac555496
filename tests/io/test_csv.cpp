#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "io/csv.hpp"

using namespace chute;

TEST_CASE("a table has comments, a header and rows") {
  io::Csv csv({"what it is"}, {"a", "b", "c"});
  csv.row({1.0, 0.1, -2e-30});
  csv.row({std::nullopt, 3.0, std::nullopt});
  CHECK(csv.text() == "# what it is\na,b,c\n1,0.1,-2e-30\n,3,\n");
}

TEST_CASE("what is not a number is an empty cell, never 'nan' or 0") {
  io::Csv csv({}, {"a", "b", "c", "d"});
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  csv.row({nan, -nan, inf, -inf});
  CHECK(csv.text() == "a,b,c,d\n,,,\n");
}

TEST_CASE("numbers read back the same") {
  for (const double x : {0.1, 1.0 / 3, 6.02214076e23, 5e-324, -0.0, 123456789.123456789}) {
    io::Csv csv({}, {"x"});
    csv.row({x});
    const double back = std::strtod(csv.text().c_str() + 2, nullptr);  // stod refuses the smallest
    CHECK(back == x);
    CHECK(std::signbit(back) == std::signbit(x));
  }
}

TEST_CASE("first cells may be texts") {
  io::Csv csv({}, {"name", "x"});
  csv.row({"series A"}, {2.5});
  CHECK(csv.text() == "name,x\nseries A,2.5\n");
}

TEST_CASE("a comment of several lines stays a comment") {  // titles come from users
  const io::Csv csv({"one\ntwo\r\nthree"}, {"x"});
  CHECK(csv.text() == "# one two  three\nx\n");
}
