#include "read/text_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "common/error.hpp"
#include "read/byte_stream.hpp"
#include "read/number.hpp"
#include "read/text_rows.hpp"

namespace chute::read {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view item = "ITEM:";

std::optional<std::uint64_t> whole_number(std::string_view text) {
  const auto word = trimmed(text);
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || error != std::errc() || end != word.data() + word.size()) return {};
  return value;
}

/// A frame that ends with its file, or is cut short by it.
struct CutShort {
  std::string what;
};

class Finder {
 public:
  explicit Finder(const fs::path& path) : path_(path), lines_(path) {}

  std::vector<TextPiece> pieces(PointSet::Format format) {
    std::vector<TextPiece> found;
    try {
      while (auto piece = format == PointSet::Format::dump ? dump_piece() : xyz_piece())
        found.push_back(std::move(*piece));
    } catch (const CutShort& cut) {
      // While it is being written, a file ends anywhere; so does one whose writer was killed.
      if (found.empty()) fail(cut.what);
      found.back().cut_after = fmt::format("{}:{}: {}", path_.string(), lines_.number(), cut.what);
    }
    if (found.empty()) throw InputError(path_.string() + ": no frame");
    return found;
  }

 private:
  fs::path path_;
  Lines lines_;
  std::string units_;

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", path_.string(), lines_.number(), what));
  }
  [[noreturn]] void fail_before(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", path_.string(), lines_.number() - 1, what));
  }

  std::string_view needed(std::string_view what) {
    std::string_view line;
    if (!lines_.next(line)) throw CutShort{fmt::format("cut short: {} is missing", what)};
    return line;
  }

  void skip_rows(std::uint64_t count) {
    std::uint64_t there = lines_.skip(count > 2 ? count - 2 : 0);
    std::size_t words = 0;
    for (std::string_view line; there < count && lines_.next(line); ++there) {
      const std::size_t before = words;
      words = 0;
      while (!take_word(line).empty()) ++words;
      // a last line without an end, and with fewer columns than the row before: its writer was in the middle of it
      if (lines_.last_has_no_end() && words < before) break;
    }
    if (there < count) throw CutShort{fmt::format("cut short: {} of {} rows are there", there, count)};
  }

  std::optional<TextPiece> dump_piece() {
    TextPiece piece;
    std::optional<double> step, time;
    std::optional<std::uint64_t> count;
    bool begun = false;
    for (;;) {
      const auto from = lines_.position(), number = lines_.number();
      std::string_view line;
      if (!lines_.next(line)) {
        if (begun) throw CutShort{"cut short: a frame without atoms"};
        return {};
      }
      if (trimmed(line).empty()) continue;
      if (lines_.last_has_no_end()) throw CutShort{"cut short in the head of a frame"};
      if (!line.starts_with(item)) fail_before("expected ITEM: …, the head of a frame");
      if (!begun) begun = true, piece.from = from, piece.first_line = number;
      const std::string name(trimmed(line.substr(item.size())));
      if (name == "UNITS") {
        units_ = trimmed(needed("the unit"));
      } else if (name == "TIMESTEP") {
        step = number_in(needed("the time step"));
        if (!step) fail_before("the time step is not a number");
      } else if (name == "TIME") {
        time = number_in(needed("the time"));
        if (!time) fail_before("the time is not a number");
      } else if (name == "NUMBER OF ATOMS" || name == "NUMBER OF ENTRIES") {
        const bool entries = name == "NUMBER OF ENTRIES";  // contacts, of a dump local
        const char* what = entries ? "the number of entries" : "the number of atoms";
        count = whole_number(needed(what));
        if (!count) fail_before(fmt::format("{} is not a whole number", what));
      } else if (name.starts_with("BOX BOUNDS")) {
        for (int c = 0; c < 3; ++c) needed("an edge of the box");
      } else if (name == "ATOMS" || name.starts_with("ATOMS ") || name == "ENTRIES" ||
                 name.starts_with("ENTRIES ")) {
        if (!count)
          fail_before(name[0] == 'A' ? "atoms without their number" : "entries without their number");
        skip_rows(*count);
        piece.size = lines_.position() - piece.from;
        piece.time = time ? time : step;
        piece.units = units_;
        return piece;
      } else {
        fail_before(fmt::format("ITEM: {} is no part of a dump of atoms", name.substr(0, 40)));
      }
    }
  }

  std::optional<TextPiece> xyz_piece() {
    TextPiece piece;
    std::string_view line;
    do {
      piece.from = lines_.position(), piece.first_line = lines_.number();
      if (!lines_.next(line)) return {};
    } while (trimmed(line).empty());
    const auto count = whole_number(line);
    if (!count && lines_.last_has_no_end()) throw CutShort{"cut short in the head of a frame"};
    if (!count) fail_before("expected the number of atoms of the next frame");
    for (const auto& [key, value] : values_in(needed("the line of comment")))
      if (key == "time") piece.time = number_in(value);
    skip_rows(*count);
    piece.size = lines_.position() - piece.from;
    return piece;
  }
};

}  // namespace

std::optional<PointSet::Format> text_format(std::string_view begin) {
  if (begin.starts_with(item)) return PointSet::Format::dump;
  // the number of atoms alone in a line; a comment; a row of a word or a number and three numbers at least
  std::string_view rows[3];
  for (auto& row : rows) {
    const auto end = begin.find('\n');
    row = begin.substr(0, end);
    begin.remove_prefix(end == std::string_view::npos ? begin.size() : end + 1);
  }
  const auto count = whole_number(rows[0]);
  if (!count) return {};
  for (const auto& [key, value] : values_in(rows[1]))
    if (key == "properties" || key == "lattice") return PointSet::Format::xyz;
  if (*count == 0) return {};
  take_word(rows[2]);
  for (int c = 0; c < 3; ++c)
    if (!number_in(take_word(rows[2]))) return {};
  return PointSet::Format::xyz;
}

std::optional<PointSet::Format> text_format_of(const fs::path& path) {
  constexpr std::size_t enough = 1U << 16U;  // for three lines
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return {};
  try {
    ByteStream stream(path);
    return text_format(stream.next().substr(0, enough));
  } catch (const InputError&) {
    return {};  // whoever reads it says what is wrong
  }
}

std::vector<TextPiece> find_pieces(const fs::path& path) {
  const auto format = text_format_of(path);
  if (!format) throw InputError(path.string() + ": neither a dump of atoms nor an XYZ file");
  return Finder(path).pieces(*format);
}

}  // namespace chute::read
