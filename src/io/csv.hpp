#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace chute::io {

/// Text of a CSV file: comment lines with #, a header, rows. Numbers are the shortest text that reads back
/// the same; an unknown number is an empty cell, never 0.
class Csv {
 public:
  Csv(std::vector<std::string> comments, std::vector<std::string_view> columns);
  using Cell = std::optional<double>;
  void row(std::span<const Cell> cells);
  void row(std::initializer_list<Cell> cells) { row(std::span(cells.begin(), cells.size())); }
  /// First cells text, in quotes where they need them, the others numbers.
  void row(std::span<const std::string_view> texts, std::span<const Cell> cells);
  void row(std::initializer_list<std::string_view> texts, std::span<const Cell> cells) {
    row(std::span(texts.begin(), texts.size()), cells);
  }
  void row(std::initializer_list<std::string_view> texts, std::initializer_list<Cell> cells) {
    row(texts, std::span(cells.begin(), cells.size()));
  }
  const std::string& text() const { return text_; }

 private:
  void add_text(std::string_view text);

  std::string text_;
  std::size_t columns_;
};

}  // namespace chute::io
