#pragma once
#include <string>
#include <vector>

#include "plot/figure.hpp"
#include "plot/layout.hpp"
#include "plot/style.hpp"

/// A figure of few numbers as what a journal prints in its place: a table.
namespace chute::plot {

struct TableSheet {
  struct Cell {
    double value = unknown, error = unknown;  ///< unknown: there is none
  };
  struct Row {
    std::string name;  ///< in the TeX of mathtext.hpp, as all texts here
    std::vector<Cell> cells;
  };
  struct Group {
    std::string heading;  ///< of the panel; may be empty
    std::string panel;    ///< its label in the data
    std::vector<Row> rows;
  };
  std::string title;
  std::vector<std::string> columns;  ///< how the series are called
  std::vector<std::string> series;   ///< their names in the data
  std::vector<Group> groups;
  std::vector<std::string> notes;  ///< below the table
  int decimals = 0;                ///< of all numbers
};

/// A group for each panel, with a row for each name of its x axis and a column for each series. InputError if an axis has no
/// names: what has many numbers is read in its CSV.
TableSheet table_sheet(const Figure& figure, const std::string& title, const std::vector<std::string>& notes);

/// On a page of its own size. A box for every text.
Layout lay_out(const TableSheet& sheet, const Look& look);

/// As a pipe table, with its title above and its notes below; formulas stand between $ as they are.
std::string markdown(const TableSheet& sheet);

/// A number as the table shows it, such as "0.1333" and "±0.1417"; the error is empty where it is unknown or rounds to 0.
struct CellText {
  std::string value, error;
};
CellText text_of(const TableSheet::Cell& cell, int decimals);

}  // namespace chute::plot
