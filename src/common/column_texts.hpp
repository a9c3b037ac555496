#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What every column and every array in chute's files means: `chute info --columns` and the README. One source; a test holds it
/// to what runs write.
namespace chute {

struct ColumnText {
  std::string name;         ///< of the column; `kinetic_*` stands for all that begin so
  std::string meaning;      ///< with its sign
  std::string si, reduced;  ///< unit; empty for pure numbers
};

struct TableText {
  std::string file;   ///< name in a run or sweep; behind " of " the kind of run, where names are the same
  std::string rows;   ///< what a row is
  std::string error;  ///< how `X_err` of a column X is made; empty: there is none
  std::vector<ColumnText> columns;
};

const std::vector<TableText>& table_texts();

/// What a column of a table of that file name means; of X_err, made from that of X. Nothing if it is not known.
std::optional<ColumnText> column_text(const TableText& table, std::string_view column);
/// The table of that file name, of several the one that knows most of these columns; or else the first that knows all, for files
/// that were renamed.
const TableText* find_table_text(std::string_view file, const std::vector<std::string>& columns);

/// A table's text with what its columns mean, their units and how errors were made as comment lines before the header; as it
/// was if its file name is not known. Columns that are not known, such as a sweep's axes, have no line.
std::string with_column_comments(std::string_view file, const std::string& csv, bool is_si);
/// Such lines, without the #, of those of these columns that the table of that file name knows, with both units; for
/// files that are made of such columns.
std::vector<std::string> column_lines(std::string_view file, const std::vector<std::string>& columns);
/// What such a line begins with, behind the #.
inline constexpr std::string_view column_comment = "column ";

/// All of it as tables in Markdown.
std::string column_tables();

}  // namespace chute
