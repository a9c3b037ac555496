#include "common/csv_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <string>

#include "common/atomic_file.hpp"
#include "common/error.hpp"

namespace chute {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == text.npos ? std::string_view{} : text.substr(first, last - first + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const auto comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == line.npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

std::vector<std::vector<double>> read_csv_columns(const std::filesystem::path& file,
                                                  const std::vector<std::string_view>& names) {
  std::istringstream in(read_file(file));
  std::vector<std::vector<double>> columns(names.size());
  std::vector<std::string> header;
  std::string text;
  for (int number = 1; std::getline(in, text); ++number) {
    const auto line = trimmed(text);
    if (line.empty() || line[0] == '#') continue;
    const auto cells = cells_of(line);
    if (header.empty()) {
      header.assign(cells.begin(), cells.end());
      continue;
    }
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto at =
          static_cast<std::size_t>(std::find(header.begin(), header.end(), names[k]) - header.begin());
      const auto cell = at < cells.size() ? cells[at] : std::string_view{};
      double value = 0;
      const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
      if (error != std::errc{} || end != cell.data() + cell.size())
        throw InputError(
            fmt::format("{}:{}: no number in a column {}; the first line names the columns, {} among them",
                        file.string(), number, names[k], fmt::join(names, " and ")));
      columns[k].push_back(value);
    }
  }
  return columns;
}

}  // namespace chute
