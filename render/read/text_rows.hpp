#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "read/point_set.hpp"

/// What dumps and XYZ files have in common: rows of columns, and values in a line of comment.
namespace chute::read {

/// A text in lines, of which errors tell the number in the file.
class TextLines {
 public:
  explicit TextLines(const FileBytes& piece)
      : path_(piece.path), rest_(piece.bytes), next_(piece.first_line) {}

  /// False at the end. Without the line's end.
  bool next(std::string_view& line);
  /// The next line, which must be there: InputError that says that `what` is missing.
  std::string_view needed(std::string_view what);
  std::uint64_t number() const { return next_ - 1; }  ///< of the line that came last
  std::size_t left() const { return rest_.size(); }   ///< bytes
  /// Throws InputError `FILE:LINE: …` about the line that came last.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::filesystem::path path_;
  std::string_view rest_;
  std::uint64_t next_;
};

/// The next word between blanks, which is taken from the text; empty at the end.
std::string_view take_word(std::string_view& text);

/// One column of numbers, or of words.
struct RowColumn {
  std::string name;
  bool wanted = true;
  enum class Kind { by_first_row, numbers, words } kind = Kind::by_first_row;
};

/// Reads `count` rows. One array of one component for each column that is wanted, the others have no values. InputError for a row with fewer
/// words than columns, one that is not there, or a word where the first row had a number. Before anything is stored, `count` is held
/// against the bytes that are left.
std::vector<PointArray> read_rows(TextLines& lines, std::uint64_t count,
                                  const std::vector<RowColumn>& columns);

/// A whole number ≥ 0; fails in the name of the last line else.
std::uint64_t count_in(const TextLines& lines, std::string_view text, std::string_view what);

/// `key=value key="several values" flag` …: keys in lower case, values without their quotes, `T` for a flag alone.
std::vector<std::pair<std::string, std::string>> values_in(std::string_view comment);

}  // namespace chute::read
