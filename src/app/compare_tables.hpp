#pragma once
#include <cstddef>
#include <filesystem>
#include <string>

namespace chute::app {

/// Two CSV tables compared cell by cell; comments do not count.
struct TableComparison {
  std::string shape;                ///< what differs in columns and rows, empty if nothing
  std::size_t cells = 0, over = 0;  ///< compared; beyond the tolerance, texts that differ among them
  double worst = 0;                 ///< largest |a − b| / (atol + rtol |a|), infinite of texts and gaps
  std::string worst_at;             ///< "line 12, v_x: 0.54 and 0.55"
  bool same() const { return shape.empty() && over == 0; }
  std::string summary() const;
};

/// Numbers a (expected) and b are the same if |a − b| ≤ atol + rtol |a|; gaps are the same as gaps. InputError if a file is
/// no table.
TableComparison compare_tables(const std::filesystem::path& expected, const std::filesystem::path& actual,
                               double rtol, double atol);

}  // namespace chute::app
