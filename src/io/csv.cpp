#include "io/csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cassert>
#include <cmath>

namespace chute::io {

Csv::Csv(std::vector<std::string> comments, std::vector<std::string_view> columns)
    : columns_(columns.size()) {
  for (auto& comment : comments) {
    for (char& c : comment)
      if (c == '\n' || c == '\r') c = ' ';  // a title may have several lines
    text_ += "# " + comment + "\n";
  }
  text_ += fmt::format("{}\n", fmt::join(columns, ","));
}

void Csv::row(std::span<const Cell> cells) { row(std::span<const std::string_view>(), cells); }

void Csv::row(std::span<const std::string_view> texts, std::span<const Cell> cells) {
  assert(texts.size() + cells.size() == columns_);
  const char* comma = "";
  for (const auto text : texts) {
    assert(text.find_first_of(",\"\n") == text.npos);
    text_ += fmt::format("{}{}", comma, text);
    comma = ",";
  }
  for (const auto& cell : cells) {
    text_ += comma;
    if (cell && std::isfinite(*cell)) text_ += fmt::format("{}", *cell);
    comma = ",";
  }
  text_ += '\n';
}

}  // namespace chute::io
