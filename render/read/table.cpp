#include "read/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "common/atomic_file.hpp"
#include "common/error.hpp"

namespace chute::read {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The cell that starts `rest`, which then starts behind the comma. False if a quote does not end.
bool take_cell(std::string_view& rest, std::string& cell, bool& last) {
  rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
  cell.clear();
  if (rest.empty() || rest.front() != '"') {
    const auto comma = rest.find(',');
    cell = trimmed(rest.substr(0, comma));
    last = comma == std::string_view::npos;
    rest.remove_prefix(last ? rest.size() : comma + 1);
    return true;
  }
  for (std::size_t i = 1; i < rest.size(); ++i) {
    if (rest[i] != '"') {
      cell += rest[i];
    } else if (i + 1 < rest.size() && rest[i + 1] == '"') {
      cell += rest[i++];
    } else {
      rest.remove_prefix(i + 1);
      const auto comma = rest.find(',');
      if (!trimmed(rest.substr(0, comma)).empty()) return false;
      last = comma == std::string_view::npos;
      rest.remove_prefix(last ? rest.size() : comma + 1);
      return true;
    }
  }
  return false;
}

}  // namespace

Table parse_table(std::string_view text, const std::filesystem::path& name) {
  Table table;
  table.file = name;
  std::size_t number = 0;
  const auto fail = [&](const std::string& what) {
    throw InputError(fmt::format("{}:{}: {}", name.string(), number, what));
  };
  while (!text.empty()) {
    ++number;
    const auto end = text.find('\n');
    std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty()) continue;
    if (line.front() == '#') {
      table.comments.emplace_back(trimmed(line.substr(1)));
      continue;
    }
    std::vector<std::string> cells;
    for (bool last = false; !last;)
      if (!take_cell(line, cells.emplace_back(), last)) fail("a quoted cell does not end as it should");
    if (table.header.empty()) {
      for (auto cell = cells.begin(); cell != cells.end(); ++cell)
        if (std::find(cells.begin(), cell, *cell) != cell)
          fail(fmt::format("two columns are called \"{}\"", *cell));
      table.header = std::move(cells);
    } else if (cells.size() != table.header.size()) {
      fail(fmt::format("{} cells, but the header names {}", cells.size(), table.header.size()));
    } else {
      table.rows.push_back(std::move(cells));
      table.lines.push_back(number);
    }
  }
  if (table.header.empty())
    throw InputError(name.string() + ": no header line, expected comma-separated values");
  return table;
}

Table read_table(const std::filesystem::path& path) { return parse_table(read_file(path), path); }

bool Table::has(std::string_view name) const {
  return std::find(header.begin(), header.end(), name) != header.end();
}

std::size_t Table::index(std::string_view name) const {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end())
    throw InputError(
        fmt::format("{}: no column \"{}\", there are: {}", file.string(), name, fmt::join(header, ", ")));
  return static_cast<std::size_t>(found - header.begin());
}

std::vector<double> Table::column(std::string_view name) const {
  const auto at = index(name);
  std::vector<double> values;
  values.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string& cell = rows[i][at];
    double value = std::numeric_limits<double>::quiet_NaN();
    const char* const end = cell.data() + cell.size();
    const auto [stop, error] = std::from_chars(cell.data() + cell.starts_with('+'), end, value);
    if (!cell.empty() && (error != std::errc() || stop != end))
      throw InputError(fmt::format("{}:{}: {}: \"{}\" is not a number", file.string(), lines[i], name, cell));
    values.push_back(value);
  }
  return values;
}

std::vector<std::string> Table::text(std::string_view name) const {
  const auto at = index(name);
  std::vector<std::string> values;
  values.reserve(rows.size());
  for (const auto& row : rows) values.push_back(row[at]);
  return values;
}

}  // namespace chute::read
