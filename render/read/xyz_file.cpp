#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "common/error.hpp"
#include "common/fields.hpp"
#include "read/number.hpp"
#include "read/text_frames.hpp"
#include "read/text_rows.hpp"

// The format: the specification of extended XYZ at https://github.com/libAtoms/extxyz; `Origin` as OVITO writes it.
namespace chute::read {
namespace {

/// A property: neighbouring columns under one name.
struct Property {
  std::string name;
  int columns = 1;
  RowColumn::Kind kind = RowColumn::Kind::numbers;
};

constexpr int most_columns = 100;  // of a property; the elements of a tensor, and room above that

/// `species:S:1:pos:R:3`.
std::vector<Property> properties_in(const TextLines& lines, std::string_view text) {
  std::vector<std::string_view> words;
  for (;;) {
    const auto end = text.find(':');
    words.push_back(text.substr(0, end));
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  if (words.size() % 3 != 0) lines.fail("Properties: expected name:type:columns, again and again");
  std::vector<Property> properties;
  for (std::size_t i = 0; i < words.size(); i += 3) {
    Property p{std::string(words[i]), 1, RowColumn::Kind::numbers};
    if (words[i + 1] == "S" || words[i + 1] == "L")  // L is T or F
      p.kind = RowColumn::Kind::words;
    else if (words[i + 1] != "R" && words[i + 1] != "I")
      lines.fail(
          fmt::format("Properties: {} is of type \"{}\", expected R, I, S or L", p.name, words[i + 1]));
    const auto columns = count_in(lines, words[i + 2], "Properties: the number of columns");
    if (columns < 1 || columns > most_columns)
      lines.fail(
          fmt::format("Properties: {} has {} columns, expected 1 to {}", p.name, columns, most_columns));
    p.columns = static_cast<int>(columns);
    properties.push_back(std::move(p));
  }
  return properties;
}

std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> values;
  for (auto word = take_word(text); !word.empty(); word = take_word(text)) {
    const auto value = number_in(word);
    if (!value) return {};
    values.push_back(*value);
  }
  return values;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool is_place(const Property& property) {
  const auto name = lower(property.name);
  return (name == "pos" || name == "position" || name == "positions") && property.columns == 3;
}

}  // namespace

PointSet parse_xyz(const FileBytes& piece, const std::function<bool(std::string_view)>& wanted) {
  TextLines lines(piece);
  PointSet set;
  set.format = PointSet::Format::xyz;
  const auto count = count_in(lines, lines.needed("the number of atoms"), "the number of atoms");
  std::vector<Property> properties;
  std::optional<std::array<bool, 3>> periodic;
  std::optional<Eigen::Vector3d> origin;
  for (const auto& [key, value] : values_in(lines.needed("the line of comment"))) {
    const auto numbers = numbers_in(value);
    if (key == "properties") {
      properties = properties_in(lines, value);
    } else if (key == "lattice") {
      if (numbers.size() != 9) lines.fail("Lattice: expected nine numbers, three for each edge");
      set.lattice.emplace().edges =
          Eigen::Map<const Eigen::Matrix3d>(numbers.data());  // an edge after the other
    } else if (key == "origin" && numbers.size() == 3) {
      origin = Eigen::Map<const Eigen::Vector3d>(numbers.data());
    } else if (key == "pbc") {
      std::string_view rest = value;
      for (auto& flag : periodic.emplace()) {
        const auto word = take_word(rest);
        flag = word == "T" || word == "1" || word == "True" || word == "true";
      }
    } else if (key == "time" && numbers.size() == 1) {
      set.field_arrays.push_back({std::string(fields::time_value), 1, numbers});
    } else if (!numbers.empty()) {
      set.field_arrays.push_back({key, static_cast<int>(numbers.size()), numbers});
    } else if (value != "T") {
      set.field_texts.emplace_back(key == fields::units ? "xyz_units" : key, value);
    }
  }
  if (set.lattice) {
    set.lattice->periodic = periodic.value_or(std::array{true, true, true});  // as the specification says
    set.lattice->origin = origin.value_or(Eigen::Vector3d::Zero());
  }
  if (properties
          .empty()) {  // plain XYZ: a word or a number for the species, and the place; further columns have no names
    properties = {{"species", 1, RowColumn::Kind::words}, {"pos", 3, RowColumn::Kind::numbers}};
  }
  const auto place = std::find_if(properties.begin(), properties.end(), is_place);
  if (place == properties.end()) lines.fail("Properties: no place, pos:R:3");

  std::vector<RowColumn> columns;
  for (const auto& property : properties) {
    set.point_names.push_back(property.name);
    const bool kept = wanted(property.name) || &property == &*place;
    for (int c = 0; c < property.columns; ++c) columns.push_back({property.name, kept, property.kind});
  }
  auto rows = read_rows(lines, count, columns);
  std::size_t column = 0;
  for (const auto& property : properties) {
    const auto first = column;
    column += static_cast<std::size_t>(property.columns);
    if (&property == &*place) {
      set.x = std::move(rows[first].values), set.y = std::move(rows[first + 1].values);
      set.z = std::move(rows[first + 2].values);
      continue;
    }
    if (!columns[first].wanted) continue;
    if (property.columns == 1) {
      set.point_arrays.push_back(std::move(rows[first]));
      continue;
    }
    if (property.kind == RowColumn::Kind::words)
      continue;  // several words a grain: nothing is drawn from them
    PointArray joined{property.name, property.columns, {}};
    joined.values.reserve(count * static_cast<std::size_t>(property.columns));
    for (std::uint64_t i = 0; i < count; ++i)
      for (int c = 0; c < property.columns; ++c)
        joined.values.push_back(rows[first + static_cast<std::size_t>(c)].values[i]);
    set.point_arrays.push_back(std::move(joined));
  }
  return set;
}

}  // namespace chute::read
