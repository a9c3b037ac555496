#include "plot/table_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "plot/headings.hpp"
#include "plot/legend.hpp"
#include "plot/mathtext.hpp"

namespace chute::plot {
namespace {

/// Digits that the smallest of the larger numbers has: those below a thousandth of the largest count as 0.
constexpr int digits = 3;
constexpr double zero_of_largest = 1e-3;
constexpr int most_decimals = 9;

int decimals_of(const std::vector<TableSheet::Group>& groups) {
  double largest = 0, smallest = std::numeric_limits<double>::infinity();
  const auto each = [&](auto&& use) {
    for (const auto& group : groups)
      for (const auto& row : group.rows)
        for (const auto& cell : row.cells)
          if (std::isfinite(cell.value)) use(std::abs(cell.value));
  };
  each([&](double v) { largest = std::max(largest, v); });
  each([&](double v) {
    if (v > zero_of_largest * largest) smallest = std::min(smallest, v);
  });
  if (!(largest > 0)) return 0;
  return std::clamp(digits - 1 - static_cast<int>(std::floor(std::log10(smallest) + 1e-9)), 0, most_decimals);
}

}  // namespace

TableSheet table_sheet(const Figure& figure, const std::string& title,
                       const std::vector<std::string>& notes) {
  TableSheet sheet;
  sheet.title = title, sheet.notes = notes;
  for (const auto& panel : figure.panels)
    for (const auto& s : panel.series) {
      if (std::find(sheet.series.begin(), sheet.series.end(), s.name) != sheet.series.end()) continue;
      sheet.series.push_back(s.name);
      sheet.columns.push_back(s.label.value_or(label_from_name(s.name)));
    }
  for (const auto& panel : figure.panels) {
    if (panel.x.names.empty())
      throw InputError(figure.source +
                       ": plot.table: a table has the names of the x axis as its rows: plot.x.names");
    auto& group = sheet.groups.emplace_back();
    group.panel = panel.label;
    group.heading = heading(panel);
    for (const auto& name : panel.x.names)
      group.rows.push_back({name, std::vector<TableSheet::Cell>(sheet.series.size())});
    for (const auto& s : panel.series) {
      const auto column = static_cast<std::size_t>(
          std::find(sheet.series.begin(), sheet.series.end(), s.name) - sheet.series.begin());
      for (std::size_t i = 0; i < s.x.size(); ++i) {
        const double row = std::round(s.x[i]);  // points of one name stand side by side
        if (!(row >= 1) || row > static_cast<double>(group.rows.size())) continue;
        group.rows[static_cast<std::size_t>(row) - 1].cells[column] = {
            s.y[i], i < s.y_err.size() ? s.y_err[i] : unknown};
      }
    }
  }
  sheet.decimals = decimals_of(sheet.groups);
  return sheet;
}

CellText text_of(const TableSheet::Cell& cell, int decimals) {
  if (!std::isfinite(cell.value)) return {"", ""};
  CellText text{fmt::format("{:.{}f}", cell.value, decimals), ""};
  if (text.value.starts_with('-') && text.value.find_first_not_of("-0.") == std::string::npos)
    text.value.erase(0, 1);  // a zero has no sign
  if (cell.error > 0) {
    const auto error = fmt::format("{:.{}f}", cell.error, decimals);
    if (error.find_first_not_of("0.") != std::string::npos) text.error = "±" + error;
  }
  return text;
}

std::string markdown(const TableSheet& sheet) {
  const auto cell_text = [](std::string text) {  // a bar would end the cell
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
    return text;
  };
  std::string text = fmt::format("**{}**\n\n|  |", sheet.title);
  for (const auto& column : sheet.columns) text += fmt::format(" {} |", cell_text(column));
  text += "\n|---|";
  for (std::size_t i = 0; i < sheet.columns.size(); ++i) text += "---:|";
  text += "\n";
  for (const auto& group : sheet.groups) {
    if (!group.heading.empty()) {
      text += fmt::format("| *{}* |", cell_text(group.heading));
      for (std::size_t i = 0; i < sheet.columns.size(); ++i) text += "  |";
      text += "\n";
    }
    for (const auto& row : group.rows) {
      text += fmt::format("| {} |", cell_text(row.name));
      for (const auto& cell : row.cells) {
        const auto [value, error] = text_of(cell, sheet.decimals);
        text += fmt::format(" {}{} |", value, error.empty() ? "" : " " + error);
      }
      text += "\n";
    }
  }
  for (const auto& note : sheet.notes) text += "\n" + note + "\n";
  return text;
}

namespace {

/// The table on its way to the page.
class Typesetter {
 public:
  Typesetter(const TableSheet& sheet, const Look& look)
      : sheet_(sheet), look_(look), size_(look.tick_size), gap_(0.9 * size_) {
    measure();
  }

  Layout run() {
    out_.list.background = look_.paper;
    double x = look_.margin + name_width_;
    for (const auto& column : columns_) x += 2 * gap_ + column.width();
    width_ = x - look_.margin;
    for (const auto& line : title_lines())
      next(), put(Box::Kind::title, set_text(line, look_.label_size), 0, line);
    y_ += 0.7 * size_;
    rule(heavy);
    next();
    x = name_width_;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      x += 2 * gap_;
      const auto text = set_text(sheet_.columns[i], size_);
      put(Box::Kind::axis_label, text, x + columns_[i].width() - text.width, sheet_.columns[i]);
      x += columns_[i].width();
    }
    y_ += 0.55 * size_;
    rule(light);
    for (std::size_t g = 0; g < sheet_.groups.size(); ++g) {
      if (g > 0) y_ += 0.55 * size_, rule(light);
      group(sheet_.groups[g]);
    }
    y_ += 0.6 * size_;
    rule(heavy);
    for (const auto& note : sheet_.notes)
      for (const auto& line : wrapped(note, note_size())) {
        y_ += 1.35 * note_size();
        put(Box::Kind::note, set_text(line, note_size()), 0, line);
      }
    out_.list.width = width_ + 2 * look_.margin;
    out_.list.height = y_ + 0.4 * size_ + look_.margin;
    return std::move(out_);
  }

 private:
  static constexpr double heavy = 1.6, light = 0.9;  // rules, in hairlines
  /// Numbers of a column stand flush right, errors flush left behind them: so decimal points stand in a line.
  struct Column {
    double head = 0, value = 0, error = 0;
    double width() const { return std::max(head, value + error); }
  };
  const TableSheet& sheet_;
  const Look& look_;
  double size_, gap_;
  double name_width_ = 0, width_ = 0, y_ = look_.margin;
  std::vector<Column> columns_;
  Layout out_;

  double note_size() const { return std::max(smallest_type, 0.85 * size_); }
  static std::string minus(const std::string& number) { return "$" + number + "$"; }
  static std::string pm(const std::string& error) {
    return "$\\,\\pm\\," + error.substr(std::string("±").size()) + "$";
  }

  void measure() {
    for (const auto& label : sheet_.columns) columns_.emplace_back().head = set_text(label, size_).width;
    for (const auto& group : sheet_.groups)
      for (const auto& row : group.rows) {
        name_width_ = std::max(name_width_, gap_ + set_text(row.name, size_).width);
        for (std::size_t i = 0; i < row.cells.size(); ++i) {
          const auto [value, error] = text_of(row.cells[i], sheet_.decimals);
          if (!value.empty())
            columns_[i].value = std::max(columns_[i].value, set_text(minus(value), size_).width);
          if (!error.empty())
            columns_[i].error = std::max(columns_[i].error, set_text(pm(error), size_).width);
        }
      }
  }

  void next() { y_ += 1.45 * size_; }
  void put(Box::Kind kind, const TextBox& text, double x, const std::string& source) {
    const Point at{look_.margin + x, y_};
    draw_text(out_.list, text, at, look_.ink);
    out_.boxes.push_back({kind, text.box_at(at), -1, source});
  }
  void rule(double width) {
    Path path;
    path.move({look_.margin, y_}).line({look_.margin + width_, y_});
    out_.list.stroke(path, {width * look_.hairline, {}, Cap::butt, Join::miter}, look_.ink);
  }

  void group(const TableSheet::Group& group) {
    if (!group.heading.empty()) {
      next();
      put(Box::Kind::panel_label, set_text(group.heading, size_), 0, group.heading);
    }
    for (const auto& row : group.rows) {
      next();
      put(Box::Kind::tick_label, set_text(row.name, size_), group.heading.empty() ? 0 : gap_, row.name);
      double x = name_width_;
      for (std::size_t i = 0; i < columns_.size(); ++i) {
        x += 2 * gap_;
        const auto [value, error] = text_of(row.cells[i], sheet_.decimals);
        const double split = x + columns_[i].width() - columns_[i].error;
        if (!value.empty()) {
          const auto text = set_text(minus(value), size_);
          put(Box::Kind::tick_label, text, split - text.width, value);
        }
        if (!error.empty()) put(Box::Kind::tick_label, set_text(pm(error), size_), split, error);
        x += columns_[i].width();
      }
    }
  }

  /// In lines no longer than the table is wide, broken between words; formulas hold no blanks that matter.
  std::vector<std::string> wrapped(const std::string& text, double size) const {
    std::vector<std::string> lines;
    std::string line;
    bool formula = false;
    std::string word;
    const auto flush = [&] {
      if (word.empty()) return;
      const auto longer = line.empty() ? word : line + " " + word;
      if (!line.empty() && set_text(longer, size).width > width_)
        lines.push_back(line), line = word;
      else
        line = longer;
      word.clear();
    };
    for (const char c : text) {
      if (c == '$') formula = !formula;
      if (c == ' ' && !formula)
        flush();
      else
        word += c;
    }
    flush();
    if (!line.empty()) lines.push_back(line);
    return lines;
  }
  std::vector<std::string> title_lines() const {
    return sheet_.title.empty() ? std::vector<std::string>() : wrapped(sheet_.title, look_.label_size);
  }
};

}  // namespace

Layout lay_out(const TableSheet& sheet, const Look& look) { return Typesetter(sheet, look).run(); }

}  // namespace chute::plot
