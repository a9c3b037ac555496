// Tables say themselves what their columns mean.
#include <catch2/catch.hpp>

#include "common/column_texts.hpp"

using namespace chute;

TEST_CASE("columns that a table has are explained before its header, errors once") {
  const std::string table = "# flow\n# seed 1\nh,v_x,v_x_err,v_y,v_y_err\n1,2,,3,\n";
  const auto told = with_column_comments("profiles.csv", table, false);
  const auto has = [&](const char* text) { return told.find(text) != std::string::npos; };
  CHECK(told.starts_with("# flow\n# seed 1\n# column h (d): height above"));
  CHECK(has("\n# column v_* (sqrt(gd)): mean velocity"));
  CHECK(has("\n# column *_err: standard error"));
  CHECK_FALSE(has("column omega"));  // it has none
  CHECK(told.ends_with("\nh,v_x,v_x_err,v_y,v_y_err\n1,2,,3,\n"));
  CHECK(with_column_comments("profiles.csv", table, true).find("# column v_* (m/s)") != std::string::npos);
}

TEST_CASE(
    "a table without errors has no line of them, one without comments or of another name is left alone") {
  const auto told = with_column_comments("moments.csv", "sweeps,temperature,a_2\n", false);
  CHECK(told.starts_with("# column sweeps: "));
  CHECK(told.find("column time") == std::string::npos);
  CHECK(told.find("_err") == std::string::npos);
  CHECK(told.ends_with("\nsweeps,temperature,a_2\n"));
  CHECK(with_column_comments("mine.csv", "a,b\n1,2\n", false) == "a,b\n1,2\n");
}
