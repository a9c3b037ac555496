#pragma once
#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "io/vtk_files.hpp"

namespace chute::io {

/// The grains as a VTK file that is not compressed: the bytes of grains_vtp(…, Packing::plain), but written piece by piece
/// straight from what the view points to, which must stay valid meanwhile. So a checkpoint of 10⁷ grains needs no copy of
/// them in memory.
class PlainGrains {
 public:
  PlainGrains(const GrainsView& grains, const RunFacts& facts);

  std::uint64_t size() const { return head_.size() + appended_ + tail.size(); }  ///< in bytes
  void write(std::ostream& out) const;

 private:
  /// An array of the file: numbers, counts that follow from the row, or a text.
  struct Column {
    enum class Type { numbers, words, rows, ids, moves, text } type = Type::numbers;
    std::string name{};
    std::uint64_t rows = 0;
    int components = 1, shift = 0;  ///< the first `shift` components are 0, as those beyond the spans
    std::vector<std::span<const double>> numbers{};
    std::span<const int> words{};
    std::span<const std::int64_t> ids{};
    std::uint64_t first = 0;  ///< rows: counted from here; moves: 1 below here, 0 from here on
    std::string text{};

    double number(std::uint64_t row, int component) const;
    std::uint64_t bytes() const;
    void write(std::ostream& out) const;
  };
  static constexpr std::string_view tail = "\n  </AppendedData>\n</VTKFile>\n";

  std::vector<Column> columns_;  // in the file's order
  std::uint64_t appended_ = 0;
  std::string head_;
  std::vector<double> numbers_;  // those of the facts

  void add(Column column, const char* indent, bool counted, bool ranged);
  static std::string range_of(const Column& column);
};

}  // namespace chute::io
