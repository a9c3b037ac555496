#include "write/frame_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "common/fields.hpp"

namespace chute::write {
namespace {

using Kind = FrameField::Kind;

/// What chute has a name for, in the order of files.
struct Known {
  std::string_view name;
  Kind kind;
  int components;
  std::string_view stem;  ///< of the columns x, y, z that dumps have in its place
};
constexpr Known known[] = {
    {fields::id.name, Kind::whole, 1, ""},
    {fields::type.name, Kind::whole, 1, ""},
    {"species", Kind::words, 1, ""},
    {fields::material.name, Kind::whole, 1, ""},
    {fields::mass.name, Kind::number, 1, ""},
    {fields::velocity.name, Kind::vector, 3, "v"},
    {fields::angular_velocity.name, Kind::vector, 3, "omega"},
    {fields::angle.name, Kind::number, 1, ""},
    {fields::orientation.name, Kind::quaternion, 4, ""},
    {fields::force.name, Kind::vector, 3, "f"},
};

/// Columns of dumps that are in the places, radii and orientations already.
constexpr std::string_view taken[] = {"x",   "y",   "z",   "xs",    "ys",    "zs",    "xu",    "yu",    "zu",
                                      "xsu", "ysu", "zsu", "quatw", "quati", "quatj", "quatk", "radius"};

bool all_whole(const read::PointArray& array) {
  return std::all_of(array.values.begin(), array.values.end(), [](double v) { return v == std::floor(v); });
}

bool is_component_of(std::string_view name, std::string_view stem) {
  return !stem.empty() && name.size() == stem.size() + 1 && name.starts_with(stem) && name.back() >= 'x' &&
         name.back() <= 'z';
}

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

std::vector<FrameField> fields_of(const read::GrainFrame& frame) {
  std::vector<FrameField> found;
  std::vector<const read::PointArray*> used;
  std::vector<std::string_view> stems;
  for (const auto& one : known) {
    const auto* array = frame.find(one.name);
    if (!array || std::find(used.begin(), used.end(), array) != used.end()) continue;
    Kind kind = one.kind;
    if (!array->words.empty())
      kind = Kind::words;
    else if (kind == Kind::words || (kind == Kind::whole && !all_whole(*array)))
      kind = Kind::number;
    // an array of that name, but of another shape, goes on under its own
    if (array->components != one.components) continue;
    used.push_back(array);
    stems.push_back(one.stem);
    found.push_back({kind, std::string(one.name), array});
  }
  for (const auto& array : frame.arrays) {
    if (std::find(used.begin(), used.end(), &array) != used.end()) continue;
    if (std::find(std::begin(taken), std::end(taken), lower_case(array.name)) != std::end(taken)) continue;
    if (std::any_of(stems.begin(), stems.end(), [&](auto stem) { return is_component_of(array.name, stem); }))
      continue;
    const Kind kind = !array.words.empty() ? Kind::words : array.components == 1 ? Kind::number : Kind::other;
    found.push_back({kind, array.name, &array});
  }
  return found;
}

const FrameField* find_field(const std::vector<FrameField>& fields, std::string_view name) {
  const auto at = std::find_if(fields.begin(), fields.end(), [&](const auto& f) { return f.name == name; });
  return at == fields.end() ? nullptr : &*at;
}

std::string without(std::string text, std::string_view meaningful) {
  for (char& c : text)
    if (std::isspace(static_cast<unsigned char>(c)) || meaningful.find(c) != std::string_view::npos) c = '_';
  return text;
}

std::string text_of(const FrameField& field, std::size_t grain, int component) {
  const double value = field.array->at(grain, component);
  if (field.kind != Kind::words) return fmt::format("{}", value);
  const auto which = static_cast<std::size_t>(value);
  const auto word =
      without(which < field.array->words.size() ? field.array->words[which] : std::string("X"), ",\"");
  return word.empty() ? "X" : word;
}

}  // namespace chute::write
