#pragma once
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace chute::read {

/// What a column of a table holds.
struct ColumnSummary {
  enum class Type { number, time, text } type = Type::text;  ///< time: dates and times of day after ISO 8601
  std::size_t gaps = 0;                                      ///< rows without a value; of texts, empty ones
  std::size_t different = 0;                                 ///< cells that differ
  /// Of numbers, and of times as seconds since 1970 in universal time; not a number where nothing is known.
  double low = std::numeric_limits<double>::quiet_NaN(), high = std::numeric_limits<double>::quiet_NaN();
  std::string low_text, high_text;  ///< as they stand in the table
};

/// A CSV file: comment lines, one header line, rows of cells as text.
struct Table {
  std::filesystem::path file;
  std::vector<std::string> comments;           ///< without the `#` and the blanks after it
  std::vector<std::string> header;             ///< column names
  std::vector<std::vector<std::string>> rows;  ///< each as long as `header`
  std::vector<std::size_t> lines;              ///< of each row in the file, from 1
  char separator =
      ',';  ///< of cells, a blank for any number of them; behind others than commas numbers may have decimal commas

  bool has(std::string_view name) const;
  /// A column as numbers; an empty cell, N/A, NA, NaN, null or a dash is NaN ("not known"). InputError `FILE:LINE: …` for an unknown column
  /// or a cell that is no number.
  std::vector<double> column(std::string_view name) const;
  /// The same, but dates and times of day, too, as seconds since the begin of 1970.
  std::vector<double> values(std::string_view name) const;
  bool is_time(std::string_view name) const { return summary(name).type == ColumnSummary::Type::time; }
  /// Whether `column` can read it.
  bool is_number(std::string_view name) const;
  /// A column as it stands.
  std::vector<std::string> text(std::string_view name) const;
  ColumnSummary summary(std::string_view name) const;
  /// Index of a column; InputError if there is none of that name.
  std::size_t index(std::string_view name) const;
};

/// Reads comma-separated values (RFC 4180), or such with `;`, tabs or blanks between cells where these, and no comma, divide the header
/// and the first row into as many cells: numbers may then have decimal commas. Lines that start with `#` are comments, the first
/// other line is the header, or, where that is of numbers, the last comment before it that names as many columns (numpy.savetxt); a
/// byte order mark, empty lines and a separator at the ends of lines are skipped; cells may stand in double quotes, with a quote in
/// them doubled, and line breaks. What is not UTF-8 is Latin-1. InputError `FILE:LINE: …` for a row with more or fewer cells than the
/// header, a quote that does not end, numbers in place of names, a column named twice; `FILE: …` if there is no header.
Table read_table(const std::filesystem::path& path);

/// The same from text; `name` stands for the file in messages.
Table parse_table(std::string_view text, const std::filesystem::path& name);

}  // namespace chute::read
