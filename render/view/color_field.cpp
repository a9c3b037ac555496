#include "view/color_field.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "common/error.hpp"
#include "common/fields.hpp"
#include "common/toml_reader.hpp"

namespace chute::view {
namespace {

const fields::Field* known(std::string_view name) {
  for (const auto& field : fields::grain_fields)
    if (field.name == name) return &field;
  return nullptr;
}

/// Other engines' `v` is chute's `velocity`.
std::string canonical(std::string_view name, const read::GrainFrame& frame) {
  const auto* array = frame.find(name);
  for (const auto& field : fields::grain_fields)
    if (array && frame.find(field.name) == array) return std::string(field.name);
  return std::string(name);
}

bool differ(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) != values.end();
}

/// Our own `type` only says what is glued; another program's is a species.
bool is_kind(const read::PointArray& array, const read::GrainFrame& frame) {
  if (!array.words.empty() || array.name == fields::material.name) return true;
  return !frame.own && (&array == frame.find(fields::type.name) || &array == frame.find("species"));
}

/// A letter or a command is mathematics, a word is text.
std::string symbol(std::string_view label) {
  const bool is_word = label.size() > 2 && label.find_first_of("\\_^") == std::string_view::npos;
  return is_word ? escaped(label) : fmt::format("${}$", label);
}

}  // namespace

std::string escaped(std::string_view name) {
  std::string text;
  for (char c : name) {
    if (c == '\\' || c == '$' || c == '%' || c == '#' || c == '&' || c == '_') text += '\\';
    text += c;
  }
  return text;
}

std::vector<double> ColorField::values(const read::GrainFrame& frame) const {
  if (is_none()) return std::vector<double>(frame.size(), 0.0);
  if (array == fields::radius.name && part == Part::scalar) return frame.radius;
  const auto* source = frame.find(array);
  if (!source) throw InputError(fmt::format("{}: no array \"{}\" to colour by", frame.file.string(), array));
  if (component >= source->components || (part == Part::scalar && source->components != 1))
    throw InputError(fmt::format("{}: array \"{}\" has another number of components than before",
                                 frame.file.string(), array));
  std::vector<double> result(frame.size());
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (part == Part::magnitude) {
      double length = 0;  // hypot, for squares leave what doubles can hold
      for (int c = 0; c < source->components; ++c) length = std::hypot(length, source->at(i, c));
      result[i] = length;
    } else {
      result[i] = sign * source->at(i, component);
    }
  }
  if (!source->words.empty()) {  // each file counts its own
    std::vector<double> numbers;
    for (const auto& word : source->words) {
      const auto found = std::find(words.begin(), words.end(), word);
      numbers.push_back(found == words.end() ? std::numeric_limits<double>::quiet_NaN()
                                             : static_cast<double>(found - words.begin()));
    }
    for (double& value : result)
      if (std::isfinite(value)) value = numbers[static_cast<std::size_t>(value)];
  }
  return result;
}

std::string ColorField::title(const std::string& units) const {
  if (forces) return units == "reduced" ? "$F_n / mg$" : units == "SI" ? "$F_n$ (N)" : "force";
  if (is_none()) return "";
  const auto* field = known(array);
  const bool is_part =
      part == Part::component && component < 3 && !(array == "angular_velocity" && component == 2);
  const std::string index = is_part ? std::string(1, "xyz"[component]) : std::to_string(component);
  if (!field) return escaped(array) + (part != Part::component ? "" : fmt::format(" $_{{{}}}$", index));
  std::string label(field->label);
  if (is_part) label += "_" + index;
  if (part == Part::magnitude && field->is_signed) label = "|" + label + "|";
  if (units == "reduced" && field->reduced == "rad") return symbol(label) + " (rad)";
  if (units == "reduced" && !field->reduced.empty()) return fmt::format("${} / {}$", label, field->reduced);
  if (units == "SI" && !field->si_unit.empty()) return fmt::format("{} ({})", symbol(label), field->si_unit);
  return symbol(label);
}

bool ColorField::is_signed() const {
  if (part == Part::magnitude) return false;
  const auto* field = known(array);
  return field && (field->is_signed || (part == Part::component));
}

std::string color_array(std::string_view text) { return std::string(text.substr(0, text.rfind(':'))); }

ColorField find_field(std::string_view text, const read::GrainFrame& frame) {
  if (text == "none") return {};
  if (text == "chains") {
    ColorField field;
    field.forces = true;
    return field;
  }
  if (text.empty()) {
    if (frame.own && !frame.clock.empty()) return {};  // where no time passes there is no speed
    if (const auto* v = frame.find(fields::velocity.name); v && v->components == 3)
      return {std::string(fields::velocity.name), ColorField::Part::magnitude, 0};
    for (const std::string_view name : {std::string_view("species"), fields::type.name})
      if (const auto* kinds = frame.find(name);
          kinds && !frame.own && kinds->components == 1 && differ(kinds->values))
        return {canonical(name, frame), ColorField::Part::scalar, 0, true};
    return {};
  }
  const auto colon = text.rfind(':');
  const std::string_view name = text.substr(0, colon);
  const std::string_view part = colon == std::string_view::npos ? std::string_view() : text.substr(colon + 1);
  const auto* array = frame.find(name);
  if (!array && name == fields::radius.name && part.empty())
    return {std::string(name), ColorField::Part::scalar, 0};
  if (!array) {
    std::vector<std::string> there = frame.names;
    for (const auto& a : frame.arrays)
      if (std::find(there.begin(), there.end(), a.name) == there.end()) there.push_back(a.name);
    const auto hint = nearest(name, there);
    throw InputError(fmt::format("{}: no array \"{}\" to colour by{}, there are: {}", frame.file.string(),
                                 name, hint.empty() ? "" : fmt::format(", did you mean \"{}\"?", hint),
                                 fmt::join(there, ", ")));
  }
  ColorField field{canonical(name, frame), ColorField::Part::scalar, 0};
  field.kinds = array->components == 1 && is_kind(*array, frame);
  if (array->components == 1 && part.empty()) return field;
  const bool own_spin = frame.own && frame.dimensions == 2 && field.array == fields::angular_velocity.name &&
                        array->components == 3;
  if (array->components > 1 && (part == "magnitude" || (part.empty() && array->components <= 3))) {
    field.part = ColorField::Part::magnitude;
    // in the plane everything turns about the same axis: the sign is what tells
    if (part.empty() && field.array == fields::angular_velocity.name && frame.dimensions == 2 &&
        array->components == 3) {
      field.part = ColorField::Part::component, field.component = 2;
      field.sign = own_spin ? -1 : 1;
    }
    return field;
  }
  field.part = ColorField::Part::component;
  const auto letter = part.size() == 1 ? std::string_view("xyz").find(part[0]) : std::string_view::npos;
  const auto digit = part.size() == 1 ? std::string_view("0123456789").find(part[0]) : std::string_view::npos;
  field.component = static_cast<int>(std::min<std::size_t>(std::min(letter, digit), 99));
  if (std::min(letter, digit) == std::string_view::npos || array->components == 1 ||
      field.component >= array->components)
    throw InputError(fmt::format("{}: \"{}\" has {} component{}, allowed after it: {}", frame.file.string(),
                                 name, array->components, array->components == 1 ? "" : "s",
                                 array->components == 1   ? "nothing"
                                 : array->components <= 3 ? ":x, :y, :z, :magnitude"
                                                          : "one digit, from :0, or :magnitude"));
  if (own_spin && field.component == 2) field.sign = -1;
  return field;
}

}  // namespace chute::view
