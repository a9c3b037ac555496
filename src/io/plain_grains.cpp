#include "io/plain_grains.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <ostream>

#include "common/fields.hpp"

namespace chute::io {
namespace {

/// Values that are put together before they go into the stream.
constexpr std::size_t at_once = 8192;

/// VTK leaves room for numbers that it only knows later: so wide is an attribute, from its quote on.
constexpr std::size_t attribute = 22;

std::string padded(const std::string& value) { return fmt::format("{:<{}}", '"' + value + '"', attribute); }

template <class Value, class Of>
void write_values(std::ostream& out, std::uint64_t count, const Of& of) {
  std::vector<Value> some;
  for (std::uint64_t at = 0; at < count;) {
    some.clear();
    for (; at < count && some.size() < at_once; ++at) some.push_back(static_cast<Value>(of(at)));
    out.write(reinterpret_cast<const char*>(some.data()),
              static_cast<std::streamsize>(some.size() * sizeof(Value)));
  }
}

}  // namespace

double PlainGrains::Column::number(std::uint64_t row, int component) const {
  const int own = component - shift;
  if (own < 0 || static_cast<std::size_t>(own) >= numbers.size()) return 0;
  const auto& span = numbers[static_cast<std::size_t>(own)];
  return span.empty() ? 0 : span[row];
}

std::uint64_t PlainGrains::Column::bytes() const {
  switch (type) {
    case Type::numbers:
      return rows * static_cast<std::uint64_t>(components) * sizeof(double);
    case Type::words:
    case Type::moves:
      return rows * sizeof(std::int32_t);
    case Type::rows:
    case Type::ids:
      return rows * sizeof(std::int64_t);
    case Type::text:
      break;
  }
  return text.size() + 1;
}

void PlainGrains::Column::write(std::ostream& out) const {
  const auto length = static_cast<std::uint32_t>(bytes());
  out.write(reinterpret_cast<const char*>(&length), sizeof length);
  const auto many = static_cast<std::uint64_t>(components);
  switch (type) {
    case Type::numbers:
      return write_values<double>(
          out, rows * many, [&](std::uint64_t at) { return number(at / many, static_cast<int>(at % many)); });
    case Type::words:
      return write_values<std::int32_t>(out, rows, [&](std::uint64_t row) { return words[row]; });
    case Type::moves:
      return write_values<std::int32_t>(out, rows, [&](std::uint64_t row) { return row < first; });
    case Type::rows:
      return write_values<std::int64_t>(out, rows, [&](std::uint64_t row) { return first + row; });
    case Type::ids:
      return write_values<std::int64_t>(out, rows, [&](std::uint64_t row) { return ids[row]; });
    case Type::text:
      out.write(text.c_str(), static_cast<std::streamsize>(text.size() + 1));
  }
}

/// Smallest and largest value, of vectors their length, as VTK writes them.
std::string PlainGrains::range_of(const Column& column) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::uint64_t row = 0; row < column.rows; ++row) {
    double value = 0;
    if (column.type == Column::Type::words) value = column.words[row];
    if (column.type == Column::Type::moves) value = row < column.first;
    if (column.type == Column::Type::rows) value = static_cast<double>(column.first + row);
    if (column.type == Column::Type::ids) value = static_cast<double>(column.ids[row]);
    if (column.type == Column::Type::numbers && column.components == 1) value = column.number(row, 0);
    if (column.components > 1) {
      for (int k = 0; k < column.components; ++k) value += column.number(row, k) * column.number(row, k);
      value = std::sqrt(value);
    }
    low = std::min(low, value), high = std::max(high, value);
  }
  return fmt::format(" RangeMin={} RangeMax={}", padded(fmt::format("{:.11g}", low)),
                     padded(fmt::format("{:.11g}", high)));
}

void PlainGrains::add(Column column, const char* indent, bool counted, bool ranged) {
  using Type = Column::Type;
  const bool text = column.type == Type::text;
  const char* type = column.type == Type::numbers                            ? "Float64"
                     : column.type == Type::rows || column.type == Type::ids ? "Int64"
                     : text                                                  ? "String"
                                                                             : "Int32";
  head_ +=
      fmt::format("{}<{} type=\"{}\" Name=\"{}\"", indent, text ? "Array" : "DataArray", type, column.name);
  if (column.components > 1) head_ += fmt::format(" NumberOfComponents=\"{}\"", column.components);
  if (counted) head_ += fmt::format(" NumberOfTuples=\"{}\"", column.rows);
  head_ += " format=\"appended\"";
  if (!text)
    head_ += ranged ? range_of(column) : fmt::format(" RangeMin={} RangeMax={}", padded(""), padded(""));
  head_ += fmt::format(" offset={}/>\n", padded(fmt::format("{}", appended_)));
  appended_ += sizeof(std::uint32_t) + column.bytes();
  columns_.push_back(std::move(column));
}

PlainGrains::PlainGrains(const GrainsView& grains, const RunFacts& facts) {
  using Type = Column::Type;
  const std::uint64_t n = grains.size();
  numbers_ = {grains.time};
  numbers_.insert(numbers_.end(), facts.domain.begin(), facts.domain.end());
  numbers_.insert(numbers_.end(), facts.gravity.begin(), facts.gravity.end());
  const auto fact = [&](std::string_view name, std::size_t at, std::size_t count) {
    add({.name = std::string(name), .rows = count, .numbers = {std::span(numbers_).subspan(at, count)}},
        "      ", true, true);
  };
  const auto text = [&](std::string_view name, const std::string& says) {
    add({.type = Type::text, .name = std::string(name), .rows = 1, .text = says}, "      ", true, false);
  };
  head_ =
      "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\" header_type=\"UInt32\">\n  <PolyData>\n"
      "    <FieldData>\n";
  fact(fields::time_value, 0, 1);
  text(fields::units, facts.units);
  if (facts.clock != "time") text(fields::clock, facts.clock);
  fact(fields::domain, 1, facts.domain.size());
  fact(fields::gravity, 1 + facts.domain.size(), facts.gravity.size());
  head_ += "    </FieldData>\n    <Piece";
  for (const auto& [name, count] :
       {std::pair{"Points", n}, {"Verts", n}, {"Lines", 0}, {"Strips", 0}, {"Polys", 0}})
    head_ += fmt::format(" NumberOf{}={}", name, padded(fmt::format("{}", count)));
  head_ += ">\n      <PointData>\n";
  constexpr const char* within = "        ";
  add({.type = grains.id.empty() ? Type::rows : Type::ids,
       .name = std::string(fields::id.name),
       .rows = n,
       .ids = grains.id},
      within, false, true);
  add({.type = Type::moves, .name = std::string(fields::type.name), .rows = n, .first = grains.moving},
      within, false, true);
  for (const auto& field : grains.fields) {
    Column column{.name = std::string(field.what.file->name), .rows = n};
    if (!field.words.empty()) {
      column.type = Type::words, column.words = field.words;
    } else {
      const int own = static_cast<int>(field.numbers.size());
      const bool turn = field.what.kind == FieldKind::turn;
      column.components = turn || field.what.kind == FieldKind::vector ? 3 : own;
      column.shift = turn ? 3 - own : 0;
      column.numbers = field.numbers;
    }
    add(std::move(column), within, false, true);
  }
  add({.name = std::string(fields::force.name),
       .rows = n,
       .components = 3,
       .numbers = {grains.force.begin(), grains.force.end()}},
      within, false, true);
  head_ += "      </PointData>\n      <CellData>\n      </CellData>\n      <Points>\n";
  Column points{.name = "Points", .rows = n, .components = 3};
  for (std::size_t k = 0; k < static_cast<std::size_t>(grains.dimensions); ++k)
    points.numbers.push_back(grains.position[k]);
  add(std::move(points), within, false, true);
  head_ += "      </Points>\n";
  for (const auto& [name, count] : {std::pair{"Verts", n}, {"Lines", 0}, {"Strips", 0}, {"Polys", 0}}) {
    head_ += fmt::format("      <{}>\n", name);
    add({.type = Type::rows, .name = "connectivity", .rows = count}, within, false, false);
    add({.type = Type::rows, .name = "offsets", .rows = count, .first = 1}, within, false, false);
    head_ += fmt::format("      </{}>\n", name);
  }
  head_ += "    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n   _";
}

void PlainGrains::write(std::ostream& out) const {
  out << head_;
  for (const auto& column : columns_) column.write(out);
  out << tail;
}

}  // namespace chute::io
