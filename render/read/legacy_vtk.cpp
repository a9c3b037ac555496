#include "read/legacy_vtk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

#include "read/number.hpp"

namespace chute::read {
namespace {

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

/// Names are written with %20 for a blank and so on.
std::string decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned value = 0;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(&text[i + 1], &text[i + 3], value, 16).ptr == &text[i + 3]) {
      result += static_cast<char>(value);
      i += 2;
    } else {
      result += text[i];
    }
  }
  return result;
}

template <class T>
double big_endian(const char* bytes) {
  char turned[sizeof(T)];
  std::reverse_copy(bytes, bytes + sizeof(T), turned);
  T value;
  std::memcpy(&value, turned, sizeof(T));
  return static_cast<double>(value);
}

struct Type {
  std::string_view name;
  std::size_t size;
  double (*read)(const char*);
};
constexpr Type types[] = {{"float", 4, big_endian<float>},
                          {"double", 8, big_endian<double>},
                          {"int", 4, big_endian<std::int32_t>},
                          {"unsigned_int", 4, big_endian<std::uint32_t>},
                          {"vtkidtype", 4, big_endian<std::int32_t>},
                          {"long", 8, big_endian<std::int64_t>},
                          {"unsigned_long", 8, big_endian<std::uint64_t>},
                          {"vtktypeint64", 8, big_endian<std::int64_t>},
                          {"vtktypeuint64", 8, big_endian<std::uint64_t>},
                          {"short", 2, big_endian<std::int16_t>},
                          {"unsigned_short", 2, big_endian<std::uint16_t>},
                          {"char", 1, big_endian<signed char>},
                          {"signed_char", 1, big_endian<signed char>},
                          {"unsigned_char", 1, big_endian<unsigned char>}};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : all_(bytes) {}
  PointSet read();

 private:
  std::string_view all_;
  std::size_t at_ = 0;
  bool binary_ = false;
  PointSet result_;
  std::vector<std::vector<double>> cells_;  ///< connectivity, in the order of the file
  std::size_t points_ = 0, tuples_ = 0;     ///< tuples of the data section that is being read
  std::vector<PointArray>* data_ = nullptr;

  static bool blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
  std::string_view line() {
    const auto end = std::min(all_.find('\n', at_), all_.size());
    auto text = all_.substr(at_, end - at_);
    at_ = std::min(end + 1, all_.size());
    while (!text.empty() && blank(text.back())) text.remove_suffix(1);
    return text;
  }
  /// The next word, empty at the end.
  std::string_view word() {
    while (at_ < all_.size() && blank(all_[at_])) ++at_;
    const std::size_t from = at_;
    while (at_ < all_.size() && !blank(all_[at_])) ++at_;
    return all_.substr(from, at_ - from);
  }
  std::string_view look_ahead() {
    const std::size_t before = at_;
    const auto next = word();
    at_ = before;
    return next;
  }
  std::size_t count(std::string_view of) {
    const auto text = word();
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      fail(fmt::format("{}: \"{}\" is no count", of, text));
    // a value takes a bit at least
    if (value > 8 * all_.size()) fail(fmt::format("{} {}: more than the file holds", of, value));
    return value;
  }
  std::vector<double> values(std::size_t number, std::string_view type_name, std::string_view of);
  std::vector<std::string> strings(std::size_t number);
  void field(std::vector<PointArray>& into, bool of_points);
  void cells(bool has_offsets, std::string_view keyword);
  void attribute(const std::string& keyword);
  void take_cells();
  void metadata_lines();
};

std::vector<double> Reader::values(std::size_t number, std::string_view type_name, std::string_view of) {
  std::vector<double> result;
  std::string lower(type_name);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto* type =
      std::find_if(std::begin(types), std::end(types), [&](const Type& t) { return t.name == lower; });
  const bool bits = lower == "bit";
  if (type == std::end(types) && !bits) fail(fmt::format("{}: unknown type \"{}\"", of, type_name));
  if (!binary_) {
    result.reserve(std::min(number, all_.size() / 2 + 1));
    for (std::size_t i = 0; i < number; ++i) {
      const auto text = word();
      if (text.empty()) fail(fmt::format("{}: {} values, but {} are there", of, number, i));
      const auto value = number_in(text);
      if (!value) fail(fmt::format("{}: \"{}\" is not a number", of, text));
      result.push_back(*value);
    }
    return result;
  }
  line();  // the values begin behind the line that announced them
  const std::size_t size = bits ? (number + 7) / 8 : number * type->size;
  if (size > all_.size() - at_)
    fail(fmt::format("{}: {} bytes, but {} are there", of, size, all_.size() - at_));
  result.resize(number);
  for (std::size_t i = 0; i < number; ++i)
    result[i] = bits ? all_[at_ + i / 8] >> (7 - i % 8) & 1 : type->read(&all_[at_ + i * type->size]);
  at_ += size;
  return result;
}

std::vector<std::string> Reader::strings(std::size_t number) {
  std::vector<std::string> result;
  line();
  for (std::size_t i = 0; i < number; ++i) {
    if (!binary_) {
      if (at_ == all_.size()) fail("a text is missing");
      result.push_back(decoded(line()));
      continue;
    }
    // the two highest bits say in how many bytes the length is written
    if (at_ == all_.size()) fail("a text is missing");
    const auto first = static_cast<unsigned char>(all_[at_]);
    const std::size_t bytes = std::size_t{1} << (3 - (first >> 6));
    std::uint64_t length = first & 63;
    if (bytes > all_.size() - at_) fail("a text is cut short");
    for (std::size_t k = 1; k < bytes; ++k) length = length << 8 | static_cast<unsigned char>(all_[at_ + k]);
    at_ += bytes;
    if (length > all_.size() - at_) fail("a text is cut short");
    result.emplace_back(all_.substr(at_, length));
    at_ += length;
  }
  return result;
}

void Reader::field(std::vector<PointArray>& into, bool of_points) {
  const std::string name(word());
  const std::size_t arrays = count("FIELD " + name);
  for (std::size_t i = 0; i < arrays; ++i) {
    if (upper(look_ahead()) == "METADATA") word(), metadata_lines();
    PointArray array;
    array.name = decoded(word());
    if (array.name.empty()) fail(fmt::format("FIELD {}: {} arrays, but {} are there", name, arrays, i));
    if (array.name == "NULL_ARRAY") continue;
    const std::size_t components = count(array.name), tuples = count(array.name);
    if (components > 1000) fail(fmt::format("array \"{}\": {} components", array.name, components));
    const std::string type(word());
    array.components = static_cast<int>(components);
    if (type == "string") {
      const auto texts = strings(components * tuples);
      if (!of_points && !texts.empty()) result_.field_texts.emplace_back(array.name, texts[0]);
      continue;
    }
    array.values = values(components * tuples, type, fmt::format("array \"{}\"", array.name));
    into.push_back(std::move(array));
  }
}

/// What VTK knows of an array, behind the word METADATA and up to an empty line.
void Reader::metadata_lines() {
  line();
  while (at_ < all_.size() && !line().empty()) {
  }
}

void Reader::cells(bool has_offsets, std::string_view keyword) {
  const std::size_t first = count(keyword), second = count(keyword);
  if (!has_offsets) {  // number of cells and of integers: each cell is its length and its points
    const auto list = values(second, "int", keyword);
    std::size_t i = 0;
    for (std::size_t cell = 0; cell < first; ++cell) {
      const double length = i < list.size() ? list[i] : -1;
      if (!(length >= 0) || length > static_cast<double>(list.size() - i - 1))
        fail(fmt::format("{}: broken list", keyword));
      const auto from = list.begin() + static_cast<std::ptrdiff_t>(i) + 1;
      cells_.emplace_back(from, from + static_cast<std::ptrdiff_t>(length));
      i += 1 + static_cast<std::size_t>(length);
    }
    return;
  }
  std::vector<double> parts[2];
  for (int k = 0; k < 2; ++k) {
    const auto name = upper(word());
    if (name != (k ? "CONNECTIVITY" : "OFFSETS"))
      fail(fmt::format("{}: \"{}\" where offsets and points belong", keyword, name));
    const std::string type(word());
    parts[k] = values(k ? second : first, type, keyword);
  }
  for (std::size_t i = 0; i + 1 < first; ++i) {
    const double from = parts[0][i], to = parts[0][i + 1];
    if (!(from >= 0 && from <= to && to <= static_cast<double>(second)))
      fail(fmt::format("{}: broken offsets", keyword));
    cells_.emplace_back(parts[1].begin() + static_cast<std::ptrdiff_t>(from),
                        parts[1].begin() + static_cast<std::ptrdiff_t>(to));
  }
}

void Reader::attribute(const std::string& keyword) {
  if (!data_) fail(fmt::format("{} before POINT_DATA or CELL_DATA", keyword));
  const std::string name = decoded(word());
  PointArray array{name, 1, {}};
  std::string type;
  if (keyword == "SCALARS") {
    type = word();
    const auto next = look_ahead();
    if (!next.empty() && std::isdigit(static_cast<unsigned char>(next[0])))
      array.components = static_cast<int>(count(name));
    if (upper(look_ahead()) == "LOOKUP_TABLE") word(), word();
  } else if (keyword == "LOOKUP_TABLE") {
    values(4 * count(keyword), binary_ ? "unsigned_char" : "float", keyword);
    return;
  } else if (keyword == "COLOR_SCALARS") {
    array.components = static_cast<int>(count(name));
    type = binary_ ? "unsigned_char" : "float";
  } else {
    if (keyword == "TEXTURE_COORDINATES") array.components = static_cast<int>(count(name));
    if (keyword == "VECTORS" || keyword == "NORMALS") array.components = 3;
    if (keyword == "TENSORS") array.components = 9;
    if (keyword == "TENSORS6") array.components = 6;
    type = word();
  }
  array.values =
      values(tuples_ * static_cast<std::size_t>(array.components), type, fmt::format("array \"{}\"", name));
  data_->push_back(std::move(array));
}

void Reader::take_cells() {
  result_.cells_in_all = cells_.size();
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (cells_[i].size() < 2) continue;
    for (const double p : cells_[i])
      if (!(p >= 0 && p < static_cast<double>(points_)))
        fail("a line or polygon has a corner that is not there");
    result_.cells.push_back({i, {cells_[i].begin(), cells_[i].end()}});
  }
}

PointSet Reader::read() {
  const auto head = line();
  double version = 0;
  const auto number = head.substr(std::min(head.size(), std::string_view("# vtk DataFile Version ").size()));
  std::from_chars(number.data(), number.data() + number.size(), version);
  line();  // a title
  auto form = upper(line());
  while (form.empty() && at_ < all_.size()) form = upper(line());
  if (form != "ASCII" && form != "BINARY") fail("the third line says neither ASCII nor BINARY");
  binary_ = form == "BINARY";
  bool has_points = false;
  for (auto next = word(); !next.empty(); next = word()) {
    const std::string keyword = upper(next);
    if (keyword == "DATASET") {
      const std::string type = upper(word());
      if (type != "POLYDATA" && type != "UNSTRUCTURED_GRID")
        throw NotTaken(fmt::format("DATASET {}, expected POLYDATA or UNSTRUCTURED_GRID", type));
    } else if (keyword == "FIELD") {
      field(data_ ? *data_ : result_.field_arrays, data_ != nullptr);
    } else if (keyword == "POINTS") {
      points_ = count(keyword);
      const std::string type(word());
      const auto xyz = values(3 * points_, type, keyword);
      for (std::size_t i = 0; i < points_; ++i) {
        result_.x.push_back(xyz[3 * i]), result_.y.push_back(xyz[3 * i + 1]),
            result_.z.push_back(xyz[3 * i + 2]);
      }
      has_points = true;
    } else if (keyword == "VERTICES" || keyword == "LINES" || keyword == "POLYGONS" ||
               keyword == "TRIANGLE_STRIPS" || keyword == "CELLS") {
      cells(version >= 5, keyword);
    } else if (keyword == "CELL_TYPES") {
      values(count(keyword), "int", keyword);
    } else if (keyword == "POINT_DATA" || keyword == "CELL_DATA") {
      tuples_ = count(keyword);
      data_ = keyword == "POINT_DATA" ? &result_.point_arrays : &result_.cell_arrays;
    } else if (keyword == "METADATA") {
      metadata_lines();
    } else if (keyword == "SCALARS" || keyword == "VECTORS" || keyword == "NORMALS" || keyword == "TENSORS" ||
               keyword == "TENSORS6" || keyword == "TEXTURE_COORDINATES" || keyword == "GLOBAL_IDS" ||
               keyword == "PEDIGREE_IDS" || keyword == "COLOR_SCALARS" || keyword == "LOOKUP_TABLE") {
      attribute(keyword);
    } else {
      throw NotTaken(fmt::format("damaged or cut short: \"{}\" is not understood", next.substr(0, 40)));
    }
  }
  if (!has_points) fail("no POINTS");
  take_cells();
  return std::move(result_);
}

}  // namespace

PointSet parse_legacy_vtk(std::string_view bytes) { return Reader(bytes).read(); }

}  // namespace chute::read
