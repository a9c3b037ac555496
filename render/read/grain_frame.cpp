#include "read/grain_frame.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/fields.hpp"
#include "common/material_names.hpp"
#include "common/toml_reader.hpp"
#include "read/number.hpp"
#include "read/points_file.hpp"

namespace chute::read {
namespace {

using Names = std::span<const std::string_view>;

// What engines call the same thing: chute's name first, then those of LAMMPS, LIGGGHTS, MercuryDPM and YADE.
constexpr std::string_view radius_names[] = {"radius", "Radius", "radii",    "Radii", "r",
                                             "R",      "rad",    "c_radius", "RADIUS"};
constexpr std::string_view diameter_names[] = {"diameter", "Diameter", "d", "D", "diam", "DIAMETER"};
constexpr std::string_view velocity_names[] = {"velocity",  "Velocity", "v",        "V",    "vel",
                                               "linVelVec", "linVel",   "VELOCITY", "velo", "velocities"};
constexpr std::string_view spin_names[] = {
    "angular_velocity", "AngularVelocity", "angularVelocity", "omega", "Omega", "angVelVec", "angVel"};
constexpr std::string_view force_names[] = {"force", "Force", "f", "F", "forceVec", "FORCE"};
constexpr std::string_view mass_names[] = {"mass", "Mass", "m", "MASS"};
constexpr std::string_view type_names[] = {"type", "Type", "TYPE", "speciesType", "atom_type", "atom_types"};
constexpr std::string_view species_names[] = {"species", "element", "symbol", "typelabel"};
constexpr std::string_view id_names[] = {"id", "ID", "Id", "identifier", "Name"};
constexpr Names groups[] = {radius_names, velocity_names, spin_names, force_names,
                            mass_names,   type_names,     id_names,   species_names};

const PointArray* find_one(const std::vector<PointArray>& arrays, std::string_view name) {
  const auto found =
      std::find_if(arrays.begin(), arrays.end(), [&](const auto& a) { return a.name == name; });
  return found == arrays.end() ? nullptr : &*found;
}

/// The name of an array without what writers add to it: a unit in brackets, blanks, `particle_` or `sphere` before a capital, capitals.
std::string plain(std::string_view name) {
  if (const auto unit = name.find_first_of("[("); unit != std::string_view::npos && unit > 0)
    name = name.substr(0, unit);
  name = trimmed(name);
  std::string text;
  for (const char c : name) text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const std::string_view of : {"particle", "grain", "sphere"}) {
    if (!text.starts_with(of) || text.size() <= of.size() + 1) continue;
    const bool parted = std::string_view("_ -.").find(text[of.size()]) != std::string_view::npos;
    const bool capital = std::isupper(static_cast<unsigned char>(name[of.size()])) != 0 &&
                         std::islower(static_cast<unsigned char>(name[of.size() - 1])) != 0;
    if (parted || capital) {
      text.erase(0, of.size() + (parted ? 1 : 0));
      break;
    }
  }
  while (text.ends_with('_')) text.pop_back();
  return text;
}

bool is_plain(Names names, std::string_view name) {
  const auto text = plain(name);
  return std::any_of(names.begin(), names.end(), [&](std::string_view n) { return plain(n) == text; });
}

const PointArray* find_any(const std::vector<PointArray>& arrays, Names names) {
  for (auto name : names)
    if (const auto* array = find_one(arrays, name)) return array;
  for (auto name : names)
    for (const auto& array : arrays)
      if (plain(array.name) == plain(name)) return &array;
  return nullptr;
}

/// LAMMPS and tables write a vector as three scalars, whose names are a stem and x, y, z.
struct Vector {
  std::string_view name;
  Names names;
  std::string_view stems[3];

  /// Which component an array of this name is, by one of the stems; -1 of none.
  int component(std::string_view array) const {
    const auto text = plain(array);
    for (const auto stem : stems)
      if (text.size() == stem.size() + 1 && text.starts_with(stem))
        if (const auto c = std::string_view("xyz").find(text.back()); c != std::string_view::npos)
          return static_cast<int>(c);
    return -1;
  }
};
const Vector vectors[] = {
    {fields::velocity.name, velocity_names, {"v", "v_", "velocity_"}},
    {fields::angular_velocity.name, spin_names, {"omega", "omega_", "angular_velocity_"}},
    {fields::force.name, force_names, {"f", "f_", "force_"}}};

bool has(Names names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> split(const std::string& names) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= names.size();) {
    const auto end = std::min(names.find(',', from), names.size());
    parts.emplace_back(trimmed(std::string_view(names).substr(from, end - from)));
    from = end + 1;
  }
  return parts;
}

/// Whether the file's array `name` is one of those asked for, or may be a component of it.
bool is_wanted(std::string_view name, const std::vector<std::string>& wanted, const Meanings& meanings) {
  for (const auto& one : meanings.said()) {
    const auto parts = split(*one.array);
    if (*one.array == name || std::find(parts.begin(), parts.end(), name) != parts.end()) return true;
  }
  if (wanted.empty() || is_plain(radius_names, name) || is_plain(diameter_names, name) ||
      is_plain(type_names, name) || is_plain(species_names, name))
    return true;
  return std::any_of(wanted.begin(), wanted.end(), [&](const std::string& one) {
    const bool alias = std::any_of(std::begin(groups), std::end(groups),
                                   [&](Names group) { return has(group, one) && is_plain(group, name); });
    const bool part = std::any_of(std::begin(vectors), std::end(vectors),
                                  [&](const Vector& v) { return v.name == one && v.component(name) >= 0; });
    return name == one || alias || part;
  });
}

void join_components(GrainFrame& frame, const Vector& vector) {
  if (find_any(frame.arrays, vector.names)) return;
  const PointArray* parts[3] = {};
  for (const auto& array : frame.arrays)
    if (const int c = vector.component(array.name); c >= 0 && !parts[c]) parts[c] = &array;
  for (int c = 0; c < 3; ++c)
    if ((!parts[c] && c < 2) || (parts[c] && (parts[c]->components != 1 || !parts[c]->words.empty()))) return;
  PointArray joined{std::string(vector.name), 3, {}};
  for (std::size_t i = 0; i < frame.size(); ++i)
    for (const auto* part : parts) joined.values.push_back(part ? part->at(i) : 0.0);
  frame.arrays.push_back(std::move(joined));
}

std::string there_are(const GrainFrame& frame) {
  return frame.names.empty() ? "none" : fmt::format("{}", fmt::join(frame.names, ", "));
}

/// The file's array that was said to be something, or its components joined under the name that was said.
const PointArray* find_said(GrainFrame& frame, const std::string& name) {
  if (const auto* array = find_one(frame.arrays, name)) return array;
  std::vector<const PointArray*> parts;
  for (const auto& part : split(name)) parts.push_back(find_one(frame.arrays, part));
  if (parts.size() < 2 || parts.size() > 3) return nullptr;
  for (const auto* part : parts)
    if (!part || part->components != 1) return nullptr;
  PointArray joined{name, static_cast<int>(parts.size()), {}};
  for (std::size_t i = 0; i < frame.size(); ++i)
    for (const auto* part : parts) joined.values.push_back(part->at(i));
  frame.arrays.push_back(std::move(joined));
  return &frame.arrays.back();
}

void take_meanings(GrainFrame& frame, const Meanings& meanings) {
  for (const auto& [key, text, components] : meanings.said()) {
    const auto& what = key;  // C++20's lambdas take no structured bindings in clang 14
    const auto& name = text;
    const auto fail = [&](const std::string& why) {
      const auto hint = nearest(*name, frame.names);
      throw InputError(
          fmt::format("{}: {} \"{}\": {}{}; arrays: {}", frame.file.string(), what, *name, why,
                      hint.empty() || hint == *name ? "" : fmt::format(", did you mean \"{}\"?", hint),
                      there_are(frame)));
    };
    const auto* array = find_said(frame, *name);
    if (!array) fail("no such array");
    if (std::find(components.begin(), components.end(), array->components) == components.end())
      fail(fmt::format("it has {} components, expected {}", array->components,
                       components[1] ? fmt::format("{} or {}", components[0], components[1])
                                     : fmt::format("{}", components[0])));
    if (!array->words.empty() && what != fields::type.name) fail("it holds words, expected numbers");
    const bool angle = what == fields::orientation.name && array->components == 1;
    frame.said.emplace_back(angle ? fields::angle.name : what, *name);
  }
}

std::vector<double> radii(const GrainFrame& frame, const Meanings& meanings) {
  if (meanings.radius) return std::vector<double>(frame.size(), *meanings.radius);
  const auto usable = [](const PointArray* array) {
    return array && array->components == 1 && array->words.empty();
  };
  const auto halves = [](std::vector<double> values) {
    for (double& value : values) value /= 2;
    return values;
  };
  if (!meanings.radius_array.empty()) return find_one(frame.arrays, meanings.radius_array)->values;
  if (!meanings.diameter_array.empty())
    return halves(find_one(frame.arrays, meanings.diameter_array)->values);
  if (const auto* array = find_any(frame.arrays, radius_names); usable(array)) return array->values;
  if (const auto* array = find_any(frame.arrays, diameter_names); usable(array)) return halves(array->values);
  throw InputError(fmt::format(
      "{}: no array of radii or diameters (arrays: {}); say which it is, or a radius for all grains, with --radius or --diameter",
      frame.file.string(), there_are(frame)));
}

/// Codes in the plane write vectors of two components.
void fill_vectors(GrainFrame& frame) {
  for (const std::string_view name : {fields::velocity.name, fields::force.name}) {
    auto* array = const_cast<PointArray*>(std::as_const(frame).find(name));
    if (!array || array->components != 2) continue;
    PointArray full{array->name, 3, {}};
    full.values.reserve(3 * frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i)
      for (const double part : {array->at(i, 0), array->at(i, 1), 0.0}) full.values.push_back(part);
    *array = std::move(full);
  }
}

void take_lattice(GrainFrame& frame, const Lattice& lattice) {
  frame.lattice = lattice;
  for (int edge = 0; edge < 3; ++edge)
    if (const int axis = lattice.axis_of(edge);
        axis >= 0 && lattice.periodic[static_cast<std::size_t>(edge)]) {
      frame.domain.min()[axis] = lattice.origin[axis];
      frame.domain.max()[axis] = lattice.origin[axis] + lattice.edges(axis, edge);
    }
}

/// A grain without a place or a size cannot be drawn: what an unstable step threw out, deleted and reserved places.
void leave_out_lost(GrainFrame& frame) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (frame.centre(i).allFinite() && frame.radius[i] > 0 && std::isfinite(frame.radius[i]))
      kept.push_back(i);
  frame.left_out = frame.size() - kept.size();
  if (frame.left_out == 0) return;
  if (kept.empty())
    throw InputError(
        fmt::format("{}: none of its {} points has a place and a radius > 0 (point 0: x = {}, radius = {})",
                    frame.file.string(), frame.size(), frame.x[0], frame.radius[0]));
  const auto keep = [&](std::vector<double>& values, std::size_t components) {
    std::vector<double> rest;
    rest.reserve(kept.size() * components);
    for (const std::size_t i : kept)
      for (std::size_t c = 0; c < components; ++c) rest.push_back(values[i * components + c]);
    values = std::move(rest);
  };
  for (auto* values : {&frame.x, &frame.y, &frame.z, &frame.radius}) keep(*values, 1);
  for (auto& array : frame.arrays) keep(array.values, static_cast<std::size_t>(array.components));
}

/// The names of chute's materials, grain by grain, as others have them in an array of species.
void name_materials(GrainFrame& frame, std::string_view text) {
  const auto* material = find_one(frame.arrays, fields::material.name);
  if (!frame.own || !material || material->components != 1) return;
  PointArray species{"species", 1, material->values, fields::names_in(text)};
  for (double& value : species.values)
    if (!(value >= 0 && value < static_cast<double>(species.words.size())))
      value = std::numeric_limits<double>::quiet_NaN();
  frame.arrays.push_back(std::move(species));
}

}  // namespace

const PointArray* GrainFrame::find(std::string_view name) const {
  for (const auto& [what, array] : said)
    if (what == name) return find_one(arrays, array);
  if (const auto* array = find_one(arrays, name)) return array;
  for (const Names group : groups)
    if (has(group, name)) return find_any(arrays, group);
  return nullptr;
}

Eigen::Vector3d GrainFrame::shortest(Eigen::Vector3d way) const {
  if (lattice) return lattice->shortest(way);
  for (int c = 0; c < 3; ++c)
    if (const double length = period(c); length > 0) way[c] -= length * std::round(way[c] / length);
  return way;
}

bool GrainFrame::is_fixed(std::size_t grain) const {
  const auto* type = own ? find_one(arrays, fields::type.name) : nullptr;
  return type && type->components == 1 && type->at(grain) == 0;
}

GrainFrame parse_frame(std::vector<FileBytes> parts, const Meanings& meanings,
                       const std::vector<std::string>& wanted) {
  const auto path = parts.front().path;
  PointSet points = parse_points(std::move(parts),
                                 [&](std::string_view name) { return is_wanted(name, wanted, meanings); });
  GrainFrame frame;
  frame.file = path;
  frame.x = std::move(points.x), frame.y = std::move(points.y), frame.z = std::move(points.z);
  frame.arrays = std::move(points.point_arrays), frame.names = std::move(points.point_names);
  for (const auto& [name, text] : points.field_texts) {
    if (name == fields::units) frame.units = text;
    if (name == fields::clock) frame.clock = text;
  }
  for (std::string_view name : {fields::time_value, std::string_view("TIME"), std::string_view("Time")})
    if (const auto* time = find_one(points.field_arrays, name); time && !time->values.empty() && !frame.time)
      frame.time = time->values[0];
  if (const auto* domain = find_one(points.field_arrays, fields::domain);
      domain && domain->values.size() == 6)
    for (int c = 0; c < 3; ++c) {
      frame.domain.min()[c] = domain->values[2 * static_cast<std::size_t>(c)];
      frame.domain.max()[c] = domain->values[2 * static_cast<std::size_t>(c) + 1];
    }
  if (const auto* gravity = find_one(points.field_arrays, fields::gravity);
      gravity && gravity->values.size() == 3)
    frame.gravity = Eigen::Map<const Eigen::Vector3d>(gravity->values.data());
  frame.own = points.format == PointSet::Format::vtk &&
              (!frame.units.empty() || find_one(points.field_arrays, fields::gravity) ||
               find_one(points.field_arrays, fields::domain));
  if (points.lattice) take_lattice(frame, *points.lattice);
  if (frame.size() == 0) {
    frame.dimensions = 2;
    return frame;
  }
  for (const Vector& vector : vectors) join_components(frame, vector);
  for (const auto& [name, text] : points.field_texts)
    if (name == fields::materials) name_materials(frame, text);
  take_meanings(frame, meanings);
  frame.radius = radii(frame, meanings);
  fill_vectors(frame);
  leave_out_lost(frame);
  const auto [low, high] = std::minmax_element(frame.z.begin(), frame.z.end());
  // Others give their planes a thickness, and periods along it.
  frame.dimensions = *low == *high && (frame.period(2) == 0 || !frame.own) ? 2 : 3;
  return frame;
}

GrainFrame read_frame(const std::filesystem::path& path, const Meanings& meanings,
                      const std::vector<std::string>& wanted) {
  return parse_frame(read_parts(path), meanings, wanted);
}

}  // namespace chute::read
