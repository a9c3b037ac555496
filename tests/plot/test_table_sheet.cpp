#include <catch2/catch.hpp>

#include "common/error.hpp"
#include "plot/table_sheet.hpp"

namespace table_sheet_tests {
using namespace chute;
using namespace chute::plot;
using Catch::Matchers::Contains;

namespace {

Series column(const std::string& name, std::vector<double> y, std::vector<double> y_err = {}) {
  Series s;
  s.name = name, s.kind = Kind::markers;
  // as figure_from sets points of one name side by side
  for (std::size_t i = 0; i < y.size(); ++i) s.x.push_back(static_cast<double>(i + 1) + 0.2);
  s.y = std::move(y), s.y_err = std::move(y_err);
  return s;
}

Figure two_laws() {
  Figure figure;
  for (const char* label : {"a", "b"}) {
    auto& panel = figure.panels.emplace_back();
    panel.label = label, panel.title = "$F_p=0.8\\,mg$";
    panel.x.names = {"$F_s$", "$|v|$"};
  }
  figure.panels[0].series = {column("theory", {1. / 3, 0.0667}),
                             column("mu=0.5", {0.334, -1e-8}, {0.0021, 1e-9})};
  figure.panels[1].series = {column("mu=0.5", {12.5, unknown})};
  return figure;
}

}  // namespace

TEST_CASE("a figure over names is a table: every number in its row and column, and no other") {
  const auto sheet = table_sheet(two_laws(), "two laws", {"value ± error"});
  REQUIRE(sheet.series == std::vector<std::string>{"theory", "mu=0.5"});
  REQUIRE(sheet.columns == std::vector<std::string>{"theory", "$\\mu=0.5$"});
  REQUIRE(sheet.groups.size() == 2);
  REQUIRE(sheet.groups[0].heading == "(a) $F_p=0.8\\,mg$");
  REQUIRE(sheet.groups[0].rows[1].cells[0].value == 0.0667);
  REQUIRE(sheet.groups[0].rows[0].cells[1].error == 0.0021);
  REQUIRE(std::isnan(sheet.groups[1].rows[0].cells[0].value));
  REQUIRE(sheet.groups[1].rows[0].cells[1].value == 12.5);
  REQUIRE(sheet.decimals == 4);  // three digits of 0.0667
  REQUIRE(markdown(sheet) ==
          "**two laws**\n\n"
          "|  | theory | $\\mu=0.5$ |\n|---|---:|---:|\n"
          "| *(a) $F_p=0.8\\,mg$* |  |  |\n"
          "| $F_s$ | 0.3333 | 0.3340 ±0.0021 |\n"
          "| $\\|v\\|$ | 0.0667 | 0.0000 |\n"  // no error of 0, no sign of 0, and bars end no cell
          "| *(b) $F_p=0.8\\,mg$* |  |  |\n"
          "| $F_s$ |  | 12.5000 |\n"
          "| $\\|v\\|$ |  |  |\n"
          "\nvalue ± error\n");
  auto plain = two_laws();
  plain.panels[1].x.names.clear();
  REQUIRE_THROWS_WITH(table_sheet(plain, "", {}),
                      Contains("plot.table: a table has the names of the x axis"));
}

TEST_CASE("a table's texts stand on the page and beside each other, decimal points in a line") {
  const auto sheet =
      table_sheet(two_laws(), "A title that is longer than the table of two laws is wide, which breaks it",
                  {"a note that is longer than the table is wide, so that it takes several lines of it"});
  const auto layout = lay_out(sheet, look_of(Style::journal));
  const Rect page{0, 0, layout.list.width, layout.list.height};
  std::vector<double> right_ends;
  for (std::size_t i = 0; i < layout.boxes.size(); ++i) {
    const auto& box = layout.boxes[i];
    INFO(box.text);
    REQUIRE(page.contains(box.rect));
    for (std::size_t k = 0; k < i; ++k) REQUIRE_FALSE(box.rect.overlaps(layout.boxes[k].rect));
    if (box.text == "0.3340" || box.text == "12.5000") right_ends.push_back(box.rect.right);
  }
  REQUIRE(right_ends.size() == 2);
  REQUIRE(right_ends[0] == Approx(right_ends[1]).margin(1e-9));
}

}  // namespace table_sheet_tests
