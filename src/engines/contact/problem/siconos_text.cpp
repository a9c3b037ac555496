#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "common/error.hpp"
#include "engines/contact/problem/parts.hpp"

namespace chute::contact {
namespace {

/// The words of a text one by one, with the line that each stands in.
class Words {
 public:
  Words(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  [[noreturn]] void complain(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", name_, line_, what));
  }
  bool at_end() {
    skip_blanks();
    return rest_.empty();
  }
  /// The next word, or nothing at the end.
  std::string_view peek() {
    skip_blanks();
    return rest_.substr(0, std::min(rest_.find_first_of(blanks), rest_.size()));
  }
  std::string_view next(const char* what) {
    const auto word = peek();
    if (word.empty()) complain(fmt::format("the file ends where {} should be", what));
    rest_.remove_prefix(word.size());
    return word;
  }
  void skip_line() { rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size())); }
  double number(const char* what) {
    const auto word = next(what);
    double x = 0;
    // strtod's "+1" is from_chars's "1"
    const auto digits = word.substr(word.starts_with('+') ? 1 : 0);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), x);
    if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(x))
      complain(fmt::format("{} must be a finite number, not \"{}\"", what, word.substr(0, 40)));
    return x;
  }
  /// A whole number from 0 to `most`.
  std::size_t count(const char* what, std::size_t most) { return whole(next(what), what, most); }
  std::size_t whole(std::string_view word, const char* what, std::size_t most) const {
    std::size_t n = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), n);
    if (error != std::errc{} || end != word.data() + word.size() || n > most)
      complain(
          fmt::format("{} must be a whole number from 0 to {}, not \"{}\"", what, most, word.substr(0, 40)));
    return n;
  }
  void expect(const char* what, std::size_t value) {
    if (const auto n = count(what, std::numeric_limits<std::size_t>::max()); n != value)
      complain(fmt::format("{} must be {}, not {}", what, value, n));
  }
  /// So many numbers can still follow: nothing larger may be made room for.
  std::size_t left() const { return rest_.size() / 2 + 1; }
  std::vector<double> numbers(const char* what, std::size_t n) {
    if (n > left()) complain(fmt::format("the file is too short for {} numbers of {}", n, what));
    std::vector<double> x(n);
    for (auto& value : x) value = number(what);
    return x;
  }

 private:
  static constexpr std::string_view blanks = " \t\r\n";
  std::string_view rest_;
  const std::string& name_;
  std::size_t line_ = 1;
  void skip_blanks() {
    while (!rest_.empty() && blanks.find(rest_.front()) != blanks.npos) {
      line_ += rest_.front() == '\n';
      rest_.remove_prefix(1);
    }
  }
};

/// Rows and columns again, then row by row.
void read_dense(Words& words, std::size_t size, std::vector<Entry>& matrix) {
  words.expect("the number of rows", size);
  words.expect("the number of columns", size);
  if (size > 0 && words.left() / size < size) words.complain("the file is too short for its matrix");
  for (std::size_t row = 0; row < size; ++row)
    for (std::size_t column = 0; column < size; ++column)
      if (const double x = words.number("an element of W"); x != 0) matrix.push_back({row, column, x});
}

/// Compressed rows of blocks; each block column by column.
void read_blocks(Words& words, std::size_t contacts, std::size_t dimensions, std::vector<Entry>& matrix) {
  const auto blocks = words.count("the number of blocks", words.left());
  words.expect("the number of block rows", contacts);
  words.expect("the number of block columns", contacts);
  for (const char* what : {"the last row of a block", "the last column of a block"})
    for (std::size_t i = 1; i <= contacts; ++i) words.expect(what, i * dimensions);
  words.expect("the number of row starts", contacts + 1);
  words.expect("the number of column numbers", blocks);
  std::vector<std::size_t> starts(contacts + 1), columns(blocks);
  for (auto& start : starts) start = words.count("where a row of blocks starts", blocks);
  if (starts.front() != 0 || starts.back() != blocks || !std::ranges::is_sorted(starts))
    words.complain(fmt::format("the rows of blocks must start at 0, go up and end at {}", blocks));
  for (auto& column : columns) column = words.count("the column of a block", contacts - 1);
  std::size_t row = 0;
  for (std::size_t k = 0; k < blocks; ++k) {
    words.expect("the number of the block", k);
    while (starts[row + 1] <= k) ++row;
    for (std::size_t c = 0; c < dimensions; ++c)
      for (std::size_t r = 0; r < dimensions; ++r)
        matrix.push_back(
            {row * dimensions + r, columns[k] * dimensions + c, words.number("an element of a block")});
  }
}

/// A print-out of CSparse: a title, `triplet: m-by-n, nzmax: … nnz: …` and lines `row column : value`, or
/// `m-by-n, nzmax: … nnz: …, 1-norm: …` and for each column `col k : locations a to b` and lines `row : value`.
void read_sparse(Words& words, std::size_t size, std::vector<Entry>& matrix) {
  if (!words.peek().starts_with("CSparse")) words.count("the origin of the sparse matrix", 10);
  if (!words.peek().starts_with("CSparse")) words.complain("a sparse matrix must begin with CSparse's title");
  words.skip_line();
  const bool triplets = words.peek() == "triplet:";
  if (triplets) words.next("triplet:");
  const auto expect_word = [&](const char* word) {
    if (const auto met = words.next(word); met != word)
      words.complain(fmt::format("\"{}\" must stand here, not \"{}\"", word, met.substr(0, 40)));
  };
  expect_word(fmt::format("{0}-by-{0},", size).c_str());
  expect_word("nzmax:");
  auto most = words.next("nzmax");
  if (most.ends_with(',')) most.remove_suffix(1);
  words.whole(most, "nzmax", std::numeric_limits<std::size_t>::max());
  expect_word("nnz:");
  auto word = words.next("nnz");
  if (word.ends_with(',')) word.remove_suffix(1);
  const auto filled = words.whole(word, "nnz", words.left());
  words.skip_line();
  const auto take = [&](std::size_t row, std::size_t column) {
    expect_word(":");
    matrix.push_back({row, column, words.number("an element of W")});
  };
  if (triplets) {
    for (std::size_t k = 0; k < filled; ++k) {
      const auto row = words.count("a row of W", size - 1);
      take(row, words.count("a column of W", size - 1));
    }
    return;
  }
  std::size_t done = 0;
  for (std::size_t column = 0; column < size; ++column) {
    expect_word("col");
    words.expect("the column's number", column);
    expect_word(":");
    expect_word("locations");
    words.expect("the column's first location", done);
    expect_word("to");
    const auto last = words.next("the column's last location");
    const auto end = last == "-1" ? 0 : words.whole(last, "the column's last location", filled) + 1;
    if (end < done || end > filled)
      words.complain("the locations of a column must go up to the number of elements");
    for (; done < end; ++done) take(words.count("a row of W", size - 1), column);
  }
  if (done != filled) words.complain(fmt::format("W must have {} elements, not {}", filled, done));
}

}  // namespace

Parts read_siconos_text(const std::string& content, const std::string& name) {
  Words words(content, name);
  Parts parts;
  const auto dimensions = words.count("the dimension", 3);
  if (dimensions < 2) words.complain("the dimension must be 2 or 3");
  parts.dimensions = static_cast<int>(dimensions);
  parts.contacts = words.count("the number of contacts", std::min(most_contacts, words.left()));
  if (parts.contacts == 0) words.complain("the number of contacts must be at least 1");
  const auto size = dimensions * parts.contacts;
  const auto storage = words.count("the storage (0 dense, 1 blocks, 2 sparse)", 2);
  words.expect("the number of W's rows", size);
  words.expect("the number of W's columns", size);
  if (storage == 0) read_dense(words, size, parts.matrix);
  if (storage == 1) read_blocks(words, parts.contacts, dimensions, parts.matrix);
  if (storage == 2) read_sparse(words, size, parts.matrix);
  parts.q = words.numbers("q", size);
  parts.friction = words.numbers("the coefficient of friction", parts.contacts);
  // Siconos's planar files end with a flag
  if (!words.at_end()) words.count("what follows the coefficients of friction", 1);
  if (!words.at_end()) words.complain("the file should end here");
  return parts;
}

}  // namespace chute::contact
