#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

namespace chute {

/// Columns of numbers of a CSV file, in the order of `names`: its first line names its columns, these among them, lines with # are
/// comments. For small tables that a scene names; the figures' tables are read in render/read. InputError with the line of
/// what is no number.
std::vector<std::vector<double>> read_csv_columns(const std::filesystem::path& file,
                                                  const std::vector<std::string_view>& names);

}  // namespace chute
