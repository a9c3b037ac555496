#include "read/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "read/iso_time.hpp"
#include "read/number.hpp"

namespace chute::read {
namespace {

/// How the quotes of a line end: `open` asks for the next line.
enum class Quotes { closed, open, astray };

/// The cell that starts `rest`, which then starts behind the separator.
Quotes take_cell(std::string_view& rest, char separator, std::string& cell, bool& last) {
  const auto skip = [&](std::string_view blanks) {
    rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
  };
  const std::string_view separators =
      separator == ' ' ? std::string_view(" \t") : std::string_view(&separator, 1);
  const auto pass = [&](std::size_t at) {
    last = at == std::string_view::npos;
    rest.remove_prefix(last ? rest.size() : at + 1);
    if (separator == ' ') skip(" \t"), last = rest.empty();  // several blanks are one separator
  };
  skip(separator == '\t' ? " " : " \t");
  cell.clear();
  if (rest.empty() || rest.front() != '"') {
    const auto at = rest.find_first_of(separators);
    cell = trimmed(rest.substr(0, at));
    pass(at);
    return Quotes::closed;
  }
  for (std::size_t i = 1; i < rest.size(); ++i) {
    if (rest[i] != '"') {
      cell += rest[i];
    } else if (i + 1 < rest.size() && rest[i + 1] == '"') {
      cell += rest[i++];
    } else {
      rest.remove_prefix(i + 1);
      const auto at = rest.find_first_of(separators);
      if (!trimmed(rest.substr(0, at)).empty()) return Quotes::astray;
      pass(at);
      return Quotes::closed;
    }
  }
  return Quotes::open;
}

/// The cells of a line.
Quotes take_cells(std::string_view line, char separator, std::vector<std::string>& cells) {
  cells.clear();
  auto quotes = Quotes::closed;
  for (bool last = false; !last && quotes == Quotes::closed;)
    quotes = take_cell(line, separator, cells.emplace_back(), last);
  return quotes;
}

/// Bytes that are UTF-8, as far as their number tells; others are taken for Latin-1.
bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto c = static_cast<unsigned char>(text[i++]);
    const int more = c < 0x80                ? 0
                     : c >= 0xC2 && c < 0xE0 ? 1
                     : c >= 0xE0 && c < 0xF0 ? 2
                     : c >= 0xF0 && c < 0xF5 ? 3
                                             : -1;
    if (more < 0) return false;
    for (int k = 0; k < more; ++k, ++i)
      if (i >= text.size() || (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U) return false;
  }
  return true;
}

std::string from_latin_1(std::string_view text) {
  std::string utf8;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x80)
      utf8 += c;
    else
      utf8 += static_cast<char>(0xC0U | code >> 6U), utf8 += static_cast<char>(0x80U | (code & 0x3FU));
  }
  return utf8;
}

/// Lines of a text, whose ends may be those of any system.
class TableLines {
 public:
  explicit TableLines(std::string_view text)
      : text_(text), end_(text.find('\n') == std::string_view::npos ? '\r' : '\n') {}
  bool at_end() const { return text_.empty(); }
  std::size_t number() const { return number_; }  ///< of the last line, from 1
  std::string_view next() {
    const auto end = text_.find(end_);
    auto line = text_.substr(0, end);
    text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    ++number_;
    return line;
  }

 private:
  std::string_view text_;
  char end_;
  std::size_t number_ = 0;
};

/// Cells in quotes may have line breaks (RFC 4180): `line` goes on until they end.
Quotes take_row(TableLines& lines, std::string line, char separator, std::vector<std::string>& cells) {
  constexpr std::size_t longest = 1U << 20U;  // a quote that never ends must not cost the whole file twice
  constexpr int most_cells = 64;              // of several lines, in one row
  auto quotes = take_cells(line, separator, cells);
  for (int k = 0; k < most_cells && quotes == Quotes::open && !lines.at_end() && line.size() < longest; ++k) {
    bool ends = false;
    while (!ends && !lines.at_end() && line.size() < longest) {
      const auto more = lines.next();
      line += '\n';
      line += more;
      ends = std::count(more.begin(), more.end(), '"') % 2 != 0;
    }
    quotes = take_cells(line, separator, cells);
  }
  return quotes;
}

/// A number of a table's cell: where no comma separates, one may stand for the point.
std::optional<double> number_of(const std::string& cell, char separator) {
  const auto comma = separator != ',' ? cell.find(',') : std::string::npos;
  if (comma == std::string::npos || cell.find('.') != std::string::npos) return number_in(cell);
  std::string pointed = cell;
  pointed[comma] = '.';
  return number_in(pointed);
}

/// What programs write where a number is not known.
bool is_gap(std::string_view cell) {
  std::string lower(cell);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  constexpr std::string_view gaps[] = {"", "na", "n/a", "#n/a", "null", "none", "-", "--", "?"};
  return std::find(std::begin(gaps), std::end(gaps), lower) != std::end(gaps);
}

bool all_numbers(const std::vector<std::string>& cells, char separator) {
  return std::all_of(cells.begin(), cells.end(),
                     [&](const std::string& cell) { return number_of(cell, separator) || is_gap(cell); });
}

/// What stands between the cells of the first two lines that are no comments: a comma if it divides both into as many, more
/// than one; else `;`, a tab or blanks if those do. Blanks only before numbers: other texts may hold some.
char separator_of(std::string_view text) {
  std::vector<std::string_view> first;
  for (TableLines lines(text); !lines.at_end() && first.size() < 2;) {
    const auto line = lines.next();
    if (!trimmed(line).empty() && trimmed(line).front() != '#') first.push_back(line);
  }
  const auto divides = [&](char separator) {
    std::size_t count = 0;
    bool numbers = false;
    for (const auto line : first) {
      std::vector<std::string> cells;
      if (take_cells(separator == '\t' ? line : trimmed(line), separator, cells) != Quotes::closed)
        return false;
      if (cells.size() < 2 || (count && cells.size() != count)) return false;
      count = cells.size();
      numbers = std::any_of(cells.begin(), cells.end(),
                            [&](const auto& cell) { return number_of(cell, separator); });
    }
    return count > 1 && (numbers || separator != ' ');
  };
  for (const char separator : {',', ';', '\t', ' '})
    if (divides(separator)) return separator;
  return ',';
}

/// numpy and gnuplot write the names of columns as a comment: the last one before numbers that has a name for each.
bool take_commented_header(Table& table, std::size_t columns) {
  for (auto comment = table.comments.rbegin(); comment != table.comments.rend(); ++comment) {
    std::vector<std::string> names;
    if (take_cells(*comment, table.separator, names) != Quotes::closed || names.size() != columns ||
        all_numbers(names, table.separator))
      continue;
    if (std::find(names.begin(), names.end(), "") != names.end()) continue;
    table.comments.erase(std::next(comment).base());
    table.header = std::move(names);
    return true;
  }
  return false;
}

/// pandas calls columns without names 0, 1, 2 …
bool count_up(const std::vector<std::string>& cells) {
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (cells[k] != std::to_string(k)) return false;
  return true;
}

}  // namespace

Table parse_table(std::string_view text, const std::filesystem::path& name) {
  Table table;
  table.file = name;
  std::size_t number = 0;
  const auto fail = [&](const std::string& what) {
    throw InputError(fmt::format("{}:{}: {}", name.string(), number, what));
  };
  const auto refuse_twins = [&] {
    for (auto cell = table.header.begin(); cell != table.header.end(); ++cell)
      if (std::find(table.header.begin(), cell, *cell) != cell)
        fail(fmt::format("two columns are called \"{}\"", *cell));
  };
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw InputError(name.string() + ": a text in UTF-16: save it as UTF-8");
  if (text.find('\0') != text.npos)
    throw InputError(name.string() + ": no table: it holds bytes that are no text");
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  std::string converted;
  if (!is_utf8(text)) text = converted = from_latin_1(text);
  table.separator = separator_of(text);
  for (TableLines lines(text); !lines.at_end();) {
    const auto raw = lines.next(), line = trimmed(raw);
    number = lines.number();
    if (line.empty()) continue;
    if (line.front() == '#') {
      table.comments.emplace_back(trimmed(line.substr(1)));
      continue;
    }
    std::vector<std::string> cells;
    if (take_row(lines, std::string(table.separator == '\t' ? raw : line), table.separator, cells) !=
        Quotes::closed)
      fail("a quoted cell does not end as it should");
    if (table.header.empty() && all_numbers(cells, table.separator) &&
        take_commented_header(table, cells.size())) {
      refuse_twins();
    } else if (table.header.empty()) {
      if (all_numbers(cells, table.separator) && !cells.front().empty() && !count_up(cells))
        fail(
            "the first line has numbers and no names of columns: put such a line before it, or one behind a #");
      if (cells.size() > 1 && cells.back().empty()) cells.pop_back();  // a separator that ends each line
      table.header = std::move(cells);
      refuse_twins();
      continue;
    }
    if (cells.size() == table.header.size() + 1 && cells.back().empty()) cells.pop_back();
    if (cells.size() != table.header.size())
      fail(fmt::format("{} cells, but the header names {}", cells.size(), table.header.size()));
    table.rows.push_back(std::move(cells));
    table.lines.push_back(number);
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

namespace {

/// Why a cell is no number: dates are numbers where all of a column are dates.
const char* no_number(std::string_view cell) {
  const bool looks_like_date = cell.size() >= 10 && cell[4] == '-' && cell[7] == '-' &&
                               cell.substr(0, 4).find_first_not_of("0123456789") == std::string_view::npos;
  if (!looks_like_date) return "is not a number";
  return iso_time(cell) ? "is a date, where others are numbers" : "is no date, or one that does not exist";
}

}  // namespace

std::vector<double> Table::column(std::string_view name) const {
  const auto at = index(name);
  std::vector<double> values;
  values.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string& cell = rows[i][at];
    const auto value = number_of(cell, separator);
    if (!value && !is_gap(cell))
      throw InputError(
          fmt::format("{}:{}: {}: \"{}\" {}", file.string(), lines[i], name, cell, no_number(cell)));
    values.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return values;
}

std::vector<double> Table::values(std::string_view name) const {
  const auto at = index(name);
  if (!is_time(name)) {
    // where most are dates, that which is none is wrong, not those
    const auto dates = std::count_if(rows.begin(), rows.end(),
                                     [&](const auto& row) { return iso_time(row[at]).has_value(); });
    for (std::size_t i = 0; i < rows.size() && 2 * static_cast<std::size_t>(dates) > rows.size(); ++i)
      if (!iso_time(rows[i][at]) && !is_gap(rows[i][at]))
        throw InputError(fmt::format(
            "{}:{}: {}: \"{}\" is no date, or one that does not exist; most others here are dates",
            file.string(), lines[i], name, rows[i][at]));
    return column(name);
  }
  std::vector<double> values;
  for (const auto& row : rows)
    values.push_back(iso_time(row[at]).value_or(std::numeric_limits<double>::quiet_NaN()));
  return values;
}

bool Table::is_number(std::string_view name) const {
  const auto at = index(name);
  return std::all_of(rows.begin(), rows.end(),
                     [&](const auto& row) { return number_of(row[at], separator) || is_gap(row[at]); });
}

std::vector<std::string> Table::text(std::string_view name) const {
  const auto at = index(name);
  std::vector<std::string> values;
  values.reserve(rows.size());
  for (const auto& row : rows) values.push_back(row[at]);
  return values;
}

ColumnSummary Table::summary(std::string_view name) const {
  const auto at = index(name);
  ColumnSummary found;
  std::set<std::string_view> different;
  bool numbers = true, times = true;
  for (const auto& row : rows) {
    const std::string& cell = row[at];
    different.insert(cell);
    const auto number = number_of(cell, separator);
    if (is_gap(cell) || (number && std::isnan(*number))) {
      ++found.gaps;
      continue;
    }
    const auto time = iso_time(cell);
    numbers = numbers && number, times = times && time;
    const auto value = number ? number : time;
    if (!value) continue;
    if (!(*value >= found.low)) found.low = *value, found.low_text = cell;
    if (!(*value <= found.high)) found.high = *value, found.high_text = cell;
  }
  found.different = different.size();
  const bool nothing = found.gaps == rows.size();
  found.type = numbers             ? ColumnSummary::Type::number
               : times && !nothing ? ColumnSummary::Type::time
                                   : ColumnSummary::Type::text;
  if (found.type == ColumnSummary::Type::text)
    found.gaps = static_cast<std::size_t>(
        std::count_if(rows.begin(), rows.end(), [&](const auto& row) { return row[at].empty(); }));
  return found;
}

}  // namespace chute::read
