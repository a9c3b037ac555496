#include "read/text_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <unordered_map>

#include "common/error.hpp"
#include "read/number.hpp"

namespace chute::read {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";
// Different words in a column. Species are a handful; a file of nothing but different words would fill the memory.
constexpr std::size_t most_words = 10'000;

/// Words of a column, each once in the order in which they came.
class Words {
 public:
  double number(std::string_view word) {
    const std::string key(word);
    if (const auto found = numbers_.find(key); found != numbers_.end())
      return static_cast<double>(found->second);
    if (words.size() == most_words) return std::numeric_limits<double>::quiet_NaN();
    words.push_back(key);
    return static_cast<double>(numbers_[key] = words.size() - 1);
  }
  std::vector<std::string> words;

 private:
  std::unordered_map<std::string, std::size_t> numbers_;
};

}  // namespace

bool TextLines::next(std::string_view& line) {
  if (rest_.empty()) return false;
  const auto end = rest_.find('\n');
  line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  ++next_;
  return true;
}

std::string_view TextLines::needed(std::string_view what) {
  std::string_view line;
  if (!next(line)) {
    ++next_;
    fail(fmt::format("cut short: {} is missing", what));
  }
  return line;
}

void TextLines::fail(const std::string& what) const {
  throw InputError(fmt::format("{}:{}: {}", path_.string(), number(), what));
}

std::string_view take_word(std::string_view& text) {
  const auto begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) {
    text = {};
    return {};
  }
  const auto end = std::min(text.find_first_of(blanks, begin), text.size());
  const auto word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

std::vector<PointArray> read_rows(TextLines& lines, std::uint64_t count,
                                  const std::vector<RowColumn>& columns) {
  // a row has at least a character for each column and one between
  if (count > (lines.left() + 1) / (2 * std::max<std::size_t>(1, columns.size())))
    lines.fail(fmt::format("cut short: {} rows of {} columns are announced, {} bytes are left", count,
                           columns.size(), lines.left()));
  std::vector<PointArray> arrays;
  std::vector<Words> words(columns.size());
  std::vector<RowColumn::Kind> kinds;
  for (const auto& column : columns) {
    arrays.push_back({column.name, 1, {}});
    if (column.wanted) arrays.back().values.reserve(count);
    kinds.push_back(column.kind);
  }
  for (std::uint64_t row = 0; row < count; ++row) {
    auto line = lines.needed(fmt::format("row {} of {}", row + 1, count));
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const auto word = take_word(line);
      if (word.empty()) lines.fail(fmt::format("{} values, expected {}", c, columns.size()));
      if (!columns[c].wanted) continue;
      if (kinds[c] == RowColumn::Kind::words) {
        arrays[c].values.push_back(words[c].number(word));
        continue;
      }
      double value = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc() || end != word.data() + word.size()) {
        const auto number = number_in(word);
        if (!number && row == 0 && kinds[c] == RowColumn::Kind::by_first_row) {
          kinds[c] = RowColumn::Kind::words;
          arrays[c].values.push_back(words[c].number(word));
          continue;
        }
        if (!number)
          lines.fail(fmt::format("{} is \"{}\", expected a number", columns[c].name, word.substr(0, 40)));
        value = *number;
      }
      arrays[c].values.push_back(value);
    }
  }
  for (std::size_t c = 0; c < columns.size(); ++c) arrays[c].words = std::move(words[c].words);
  return arrays;
}

std::uint64_t count_in(const TextLines& lines, std::string_view text, std::string_view what) {
  const auto word = trimmed(text);
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || error != std::errc() || end != word.data() + word.size())
    lines.fail(fmt::format("{} is \"{}\", expected a whole number", what, word.substr(0, 40)));
  return value;
}

std::vector<std::pair<std::string, std::string>> values_in(std::string_view comment) {
  std::vector<std::pair<std::string, std::string>> values;
  while (true) {
    const auto begin = comment.find_first_not_of(" \t\r,");
    if (begin == std::string_view::npos) return values;
    comment.remove_prefix(begin);
    const auto end = std::min(comment.find_first_of("= \t\r"), comment.size());
    std::string key(comment.substr(0, end));
    for (char& c : key) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    comment.remove_prefix(end);
    if (!comment.starts_with('=')) {
      values.emplace_back(std::move(key), "T");
      continue;
    }
    comment.remove_prefix(1);
    char close = ' ';
    if (!comment.empty())
      if (const auto quote = std::string_view("\"'{[").find(comment[0]); quote != std::string_view::npos)
        close = "\"'}]"[quote], comment.remove_prefix(1);
    const auto stop =
        std::min(close == ' ' ? comment.find_first_of(" \t\r") : comment.find(close), comment.size());
    values.emplace_back(std::move(key), std::string(comment.substr(0, stop)));
    comment.remove_prefix(std::min(comment.size(), stop + (close == ' ' ? 0 : 1)));
  }
}

}  // namespace chute::read
