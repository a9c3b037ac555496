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
    text_ += comma;
    add_text(text);
    comma = ",";
  }
  for (const auto& cell : cells) {
    text_ += comma;
    if (cell && std::isfinite(*cell)) text_ += fmt::format("{}", *cell);
    comma = ",";
  }
  text_ += '\n';
}

/// RFC 4180: what has commas, quotes or line ends stands in quotes, with its own doubled. Tables are read line by line,
/// so that a line's end within becomes a blank.
void Csv::add_text(std::string_view text) {
  if (text.find_first_of(",\"\n\r#") == text.npos && !text.starts_with(' ') && !text.ends_with(' ')) {
    text_ += text;
    return;
  }
  text_ += '"';
  for (const char c : text) {
    if (c == '"') text_ += c;
    text_ += c == '\n' || c == '\r' ? ' ' : c;
  }
  text_ += '"';
}

}  // namespace chute::io
