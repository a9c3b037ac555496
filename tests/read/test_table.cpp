#include <catch2/catch.hpp>
#include <cmath>

#include "complaint.hpp"
#include "read/iso_time.hpp"
#include "read/table.hpp"

using namespace chute;
using Catch::Matchers::Contains;
using chute::test::complaint;

TEST_CASE("A table with comments, texts, numbers and gaps") {
  const auto table = read::parse_table(
      "# x: time, s\r\n#\n# made by hand\npanel,series,x,x_err\r\n\na,e_n=0.7,1.5,\n,\"say \"\"yes\"\", "
      "twice\",-2e-3,0.25\n",
      "t.csv");
  CHECK(table.comments == std::vector<std::string>{"x: time, s", "", "made by hand"});
  CHECK(table.header == std::vector<std::string>{"panel", "series", "x", "x_err"});
  REQUIRE(table.rows.size() == 2);
  CHECK(table.text("series") == std::vector<std::string>{"e_n=0.7", "say \"yes\", twice"});
  CHECK(table.text("panel") == std::vector<std::string>{"a", ""});
  CHECK(table.column("x") == std::vector<double>{1.5, -2e-3});
  CHECK(std::isnan(table.column("x_err")[0]));
  CHECK(table.column("x_err")[1] == 0.25);
  CHECK(table.has("x"));
  CHECK_FALSE(table.has("y"));
}

TEST_CASE("What is wrong with a table is said with the line") {
  const auto parse = [](const char* text) { return complaint([&] { read::parse_table(text, "t.csv"); }); };
  CHECK(parse("# c\nx,y\n1,2\n1,2,3\n") == "t.csv:4: 3 cells, but the header names 2");
  CHECK(parse("x,y\n1\n") == "t.csv:2: 1 cells, but the header names 2");
  CHECK(parse("x,x\n1,2\n") == "t.csv:1: two columns are called \"x\"");
  CHECK_THAT(parse("x\n\"no end\n"), Contains("t.csv:2: a quoted cell"));
  CHECK_THAT(parse("# only\n"), Contains("t.csv: no header line"));
  const auto table = read::parse_table("x,y\n1,2\n3,4z\n", "t.csv");
  CHECK(complaint([&] { table.column("y"); }) == "t.csv:3: y: \"4z\" is not a number");
  CHECK_THAT(complaint([&] { table.column("z"); }), Contains("no column \"z\", there are: x, y"));
  CHECK_THAT(complaint([] { read::read_table("/nowhere/t.csv"); }), Contains("cannot read"));
}

TEST_CASE("Tables of other programs: a mark of byte order, gaps by name, signs, a header behind a hash") {
  const auto marked = read::parse_table("\xEF\xBB\xBFx,y\n+1.0e+00, 2.\nN/A,-nan(ind)\n", "t.csv");
  CHECK(marked.header == std::vector<std::string>{"x", "y"});
  CHECK(marked.column("x")[0] == 1);
  CHECK(std::isnan(marked.column("x")[1]));
  CHECK(marked.column("y")[0] == 2);
  CHECK(std::isnan(marked.column("y")[1]));
  const auto numpy = read::parse_table("# a run, of last week\n# time,force\n0,1.5\n1,-\n", "t.csv");
  CHECK(numpy.header == std::vector<std::string>{"time", "force"});
  CHECK(numpy.rows.size() == 2);
  CHECK(numpy.comments == std::vector<std::string>{"a run, of last week"});
  CHECK(numpy.is_number("force"));
  CHECK_FALSE(read::parse_table("day\n2024-03-07\n", "t.csv").is_number("day"));
}

TEST_CASE("Cells in quotes may have line breaks, and rows are told by their first line") {
  const auto table =
      read::parse_table("a,b\r\n1,\"two\r\nlines, \"\"quoted\"\"\"\r\n2,\"\n\n\"\r\n3,x\r\n", "t.csv");
  CHECK(table.text("a") == std::vector<std::string>{"1", "2", "3"});
  CHECK(table.text("b") == std::vector<std::string>{"two\nlines, \"quoted\"", "\n\n", "x"});
  CHECK(table.lines == std::vector<std::size_t>{2, 4, 7});
  CHECK_THAT(complaint([] { read::parse_table("a,b\n1,\"x\n2,3\n", "t.csv"); }),
             Contains("t.csv:2: a quoted cell"));
  CHECK_THAT(complaint([] { read::parse_table("a,b\n1,\"x\" y\n2,3\n", "t.csv"); }),
             Contains("t.csv:2: a quoted cell"));
  std::string many = "a,b\n";  // quotes that never end, as often as lines: no more than a glance each
  for (int i = 0; i < 200'000; ++i) many += "a\"b,\"x\n";
  CHECK_THAT(complaint([&] { read::parse_table(many, "t.csv"); }), Contains("a quoted cell"));
}

TEST_CASE("Tables of blanks and tabs, as numpy writes them") {
  const auto blanks = read::parse_table("# of last week\n# time force\n0.0   1.5\n  1e0\t-2 \n", "t.csv");
  CHECK(blanks.header == std::vector<std::string>{"time", "force"});
  CHECK(blanks.column("time") == std::vector<double>{0, 1});
  CHECK(blanks.column("force") == std::vector<double>{1.5, -2});
  const auto named = read::parse_table("time \"mean force\"\n0 1,5\n1 2\n", "t.csv");
  CHECK(named.column("mean force") == std::vector<double>{1.5, 2});
  const auto tabs = read::parse_table("time\tv x\tnote\n0\t\ta b\n1\t2,5\t\n", "t.csv");
  CHECK(tabs.header == std::vector<std::string>{"time", "v x", "note"});
  CHECK(std::isnan(tabs.column("v x")[0]));
  CHECK(tabs.column("v x")[1] == 2.5);
  CHECK(tabs.text("note") == std::vector<std::string>{"a b", ""});
  // texts with blanks are no columns
  CHECK(read::parse_table("first word\nsecond word\n", "t.csv").header.size() == 1);
  CHECK(complaint([] { read::parse_table("a b\n1 2\n3\n", "t.csv"); }) ==
        "t.csv:3: 1 cells, but the header names 2");
}

TEST_CASE("Ends of lines and letters of other systems, separators at the end, lines without names") {
  const auto mac = read::parse_table("x,y\r1,2\r3,4\r", "t.csv");
  CHECK(mac.column("y") == std::vector<double>{2, 4});
  CHECK(mac.lines == std::vector<std::size_t>{2, 3});
  CHECK(read::parse_table("x,\xB5\n1,2\n", "t.csv").header[1] == "\u00B5");  // Latin-1
  CHECK(read::parse_table("x,\u00B5\n1,2\n", "t.csv").header[1] == "\u00B5");
  for (const char* text : {"x,y,\n1,2,\n3,4\n", "x,y\n1,2,\n3,4,\n"})
    CHECK(read::parse_table(text, "t.csv").column("y") == std::vector<double>{2, 4});
  CHECK_THAT(complaint([] { read::parse_table("x,y,\n1,2,3\n", "t.csv"); }), Contains("t.csv:2: 3 cells"));
  CHECK_THAT(complaint([] { read::parse_table("\xFF\xFEx", "t.csv"); }),
             Contains("UTF-16: save it as UTF-8"));
  CHECK_THAT(complaint([] { read::parse_table("0.5,1\n1.5,2\n", "t.csv"); }),
             Contains("t.csv:1: the first line has numbers"));
  CHECK(read::parse_table("0,1\n1.5,2\n", "t.csv").column("1") == std::vector<double>{2});  // pandas
  CHECK(read::parse_table(",0,1\n0,1.5,2\n", "t.csv").column("1") ==
        std::vector<double>{2});  // and with its index
}

TEST_CASE("Semicolons between cells, commas in numbers; commas stay what they are where they divide") {
  const auto table = read::parse_table("zeit;kraft\n0,5;1,25\n1;-2.5e0\n1,5;\n", "t.csv");
  CHECK(table.header == std::vector<std::string>{"zeit", "kraft"});
  CHECK(table.column("zeit") == std::vector<double>{0.5, 1, 1.5});
  CHECK(table.column("kraft")[0] == 1.25);
  CHECK(table.column("kraft")[1] == -2.5);
  CHECK(std::isnan(table.column("kraft")[2]));
  const auto plain = read::parse_table("x,y;z\n1,2\n", "t.csv");
  CHECK(plain.header == std::vector<std::string>{"x", "y;z"});
  CHECK(complaint([] { read::parse_table("a;b\n1;2\n3\n", "t.csv"); }) ==
        "t.csv:3: 1 cells, but the header names 2");
}

TEST_CASE("Dates and times of day in universal time; what does not exist is none") {
  CHECK(read::iso_time("1970-01-01") == 0.0);
  CHECK(read::iso_time("2000-03-01") == 951868800.0);  // the day after a leap day
  CHECK(read::iso_time("2026-11-26T18:10:05.5Z") == 1795716605.5);
  CHECK(read::iso_time("1970-01-02 01:30") == 91800.0);
  CHECK(read::iso_time("1970-01-01T01:00+01:00") == 0.0);
  CHECK(read::iso_time("1970-01-01T01:00-0130") == 9000.0);
  for (const char* wrong : {"", "2026", "2026-02-29", "2026-13-01", "2026-01-01T25:00", "2026-01-01Tnoon",
                            "2026-01-01T10:00+", "26-01-01", "2026-01-01T10:61", "1.5", "2026-01-01x"})
    CHECK_FALSE(read::iso_time(wrong));
}

TEST_CASE("A column's type, gaps and range") {
  const auto table =
      read::parse_table("date,force,note,none\n2024-03-08,0.5,a,\n2024-03-07,N/A,b,-\n,2.5,,nan\n", "t.csv");
  using Type = read::ColumnSummary::Type;
  const auto date = table.summary("date"), force = table.summary("force"), note = table.summary("note");
  CHECK(date.type == Type::time);
  CHECK(date.gaps == 1);
  CHECK(date.low_text == "2024-03-07");
  CHECK(date.high - date.low == 86400);
  CHECK(force.type == Type::number);
  CHECK(force.gaps == 1);
  CHECK(force.low == 0.5);
  CHECK(force.high == 2.5);
  CHECK(note.type == Type::text);
  CHECK(note.gaps == 1);
  CHECK(note.different == 3);
  CHECK(table.summary("none").type == Type::number);
  CHECK(std::isnan(table.summary("none").low));
}

TEST_CASE("A date that does not exist among dates is told with its line, and so is a date among numbers") {
  const auto said = [](const std::string& cells) {
    const auto table = read::parse_table("when\n" + cells, "t.csv");
    return complaint([&] { table.values("when"); });
  };
  CHECK_THAT(said("2026-02-27\n2026-02-28\n2026-02-30\n"),
             Contains("t.csv:4: when: \"2026-02-30\" is no date"));
  CHECK_THAT(said("1\n2\n2026-02-28\n"),
             Contains("t.csv:4: when: \"2026-02-28\" is a date, where others are numbers"));
  CHECK_THAT(said("1\n2\n2026-02-30\n"),
             Contains("t.csv:4: when: \"2026-02-30\" is no date, or one that does not exist"));
}
