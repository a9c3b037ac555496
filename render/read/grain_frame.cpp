#include "read/grain_frame.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <span>
#include <utility>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/fields.hpp"
#include "read/number.hpp"
#include "read/vtk_points.hpp"

namespace chute::read {
namespace {

using Names = std::span<const std::string_view>;

// What engines call the same thing: chute's name first, then those of LAMMPS, LIGGGHTS, MercuryDPM and YADE.
constexpr std::string_view radius_names[] = {"radius", "Radius", "radii",    "Radii", "r",
                                             "R",      "rad",    "c_radius", "RADIUS"};
constexpr std::string_view diameter_names[] = {"diameter", "Diameter", "d", "D", "diam", "DIAMETER"};
constexpr std::string_view velocity_names[] = {"velocity", "Velocity",  "v",      "V",
                                               "vel",      "linVelVec", "linVel", "VELOCITY"};
constexpr std::string_view spin_names[] = {
    "angular_velocity", "AngularVelocity", "angularVelocity", "omega", "Omega", "angVelVec", "angVel"};
constexpr std::string_view force_names[] = {"force", "Force", "f", "F", "forceVec", "FORCE"};
constexpr std::string_view mass_names[] = {"mass", "Mass", "m", "MASS"};
constexpr std::string_view type_names[] = {"type", "Type", "TYPE"};
constexpr std::string_view id_names[] = {"id", "ID", "Id", "identifier", "Name"};
constexpr Names groups[] = {radius_names, velocity_names, spin_names, force_names,
                            mass_names,   type_names,     id_names};

const PointArray* find_one(const std::vector<PointArray>& arrays, std::string_view name) {
  const auto found =
      std::find_if(arrays.begin(), arrays.end(), [&](const auto& a) { return a.name == name; });
  return found == arrays.end() ? nullptr : &*found;
}

/// The name of an array without what writers add to it: a unit in brackets, blanks, `particle_`, capitals.
std::string plain(std::string_view name) {
  if (const auto unit = name.find_first_of("[("); unit != std::string_view::npos && unit > 0)
    name = name.substr(0, unit);
  std::string text;
  for (const char c : trimmed(name)) text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const std::string_view of : {"particle", "grain"})
    if (text.starts_with(of) && text.size() > of.size() + 1 &&
        std::string_view("_ -.").find(text[of.size()]) != std::string_view::npos)
      text.erase(0, of.size() + 1);
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

/// LAMMPS may write a vector as three scalars, whose names are a stem and x, y, z.
struct Vector {
  std::string_view name;
  Names names;
  std::string_view stem;
};
const Vector vectors[] = {{fields::velocity.name, velocity_names, "v"},
                          {fields::angular_velocity.name, spin_names, "omega"},
                          {fields::force.name, force_names, "f"}};

bool has(Names names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

PointArray* find_any(std::vector<PointArray>& arrays, Names names) {
  return const_cast<PointArray*>(find_any(std::as_const(arrays), names));
}

/// Whether the file's array `name` is one of those asked for, or may be a component of it.
bool is_wanted(std::string_view name, const std::vector<std::string>& wanted) {
  if (wanted.empty() || is_plain(radius_names, name) || is_plain(diameter_names, name) ||
      has(type_names, name))
    return true;
  return std::any_of(wanted.begin(), wanted.end(), [&](const std::string& one) {
    const bool alias = std::any_of(std::begin(groups), std::end(groups),
                                   [&](Names group) { return has(group, one) && is_plain(group, name); });
    const bool part = std::any_of(std::begin(vectors), std::end(vectors), [&](const Vector& v) {
      return v.name == one && name.size() == v.stem.size() + 1 && name.starts_with(v.stem);
    });
    return name == one || alias || part;
  });
}

void join_components(GrainFrame& frame, const Vector& vector) {
  const auto& [name, names, stem] = vector;
  if (find_any(frame.arrays, names)) return;
  const PointArray* parts[3];
  for (int c = 0; c < 3; ++c) {
    parts[c] = find_one(frame.arrays, std::string(stem) + "xyz"[c]);
    if ((!parts[c] && c < 2) || (parts[c] && parts[c]->components != 1)) return;
  }
  PointArray joined{std::string(name), 3, {}};
  for (std::size_t i = 0; i < frame.size(); ++i)
    for (const auto* part : parts) joined.values.push_back(part ? part->at(i) : 0.0);
  frame.arrays.push_back(std::move(joined));
}

std::vector<double> radii(const GrainFrame& frame, std::optional<double> given) {
  const std::size_t count = frame.size();
  if (given) return std::vector<double>(count, *given);
  if (const auto* array = find_any(frame.arrays, radius_names); array && array->components == 1)
    return array->values;
  if (const auto* array = find_any(frame.arrays, diameter_names); array && array->components == 1) {
    auto values = array->values;
    for (double& value : values) value /= 2;
    return values;
  }
  throw InputError(fmt::format(
      "{}: no array of radii or diameters (arrays: {}); give a radius for all grains", frame.file.string(),
      frame.names.empty() ? "none" : fmt::format("{}", fmt::join(frame.names, ", "))));
}

/// Codes in the plane write vectors of two components.
void fill_vectors(GrainFrame& frame) {
  for (const Names names : {Names(velocity_names), Names(force_names)}) {
    auto* array = find_any(frame.arrays, names);
    if (!array || array->components != 2) continue;
    PointArray full{array->name, 3, {}};
    full.values.reserve(3 * frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i)
      for (const double part : {array->at(i, 0), array->at(i, 1), 0.0}) full.values.push_back(part);
    *array = std::move(full);
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

}  // namespace

const PointArray* GrainFrame::find(std::string_view name) const {
  if (const auto* array = find_one(arrays, name)) return array;
  for (const Names group : groups)
    if (has(group, name)) return find_any(arrays, group);
  return nullptr;
}

bool GrainFrame::is_fixed(std::size_t grain) const {
  const auto* type = own ? find_one(arrays, fields::type.name) : nullptr;
  return type && type->components == 1 && type->at(grain) == 0;
}

GrainFrame parse_frame(std::vector<FileBytes> parts, std::optional<double> radius,
                       const std::vector<std::string>& wanted) {
  const auto path = parts.front().path;
  VtkPoints points =
      parse_vtk(std::move(parts), [&](std::string_view name) { return is_wanted(name, wanted); });
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
  frame.own = !frame.units.empty() || find_one(points.field_arrays, fields::gravity) ||
              find_one(points.field_arrays, fields::domain);
  if (frame.size() == 0) {
    frame.dimensions = 2;
    return frame;
  }
  for (const Vector& vector : vectors) join_components(frame, vector);
  frame.radius = radii(frame, radius);
  fill_vectors(frame);
  leave_out_lost(frame);
  const auto [low, high] = std::minmax_element(frame.z.begin(), frame.z.end());
  frame.dimensions = *low == *high && frame.period(2) == 0 ? 2 : 3;
  return frame;
}

GrainFrame read_frame(const std::filesystem::path& path, std::optional<double> radius,
                      const std::vector<std::string>& wanted) {
  return parse_frame(read_parts(path), radius, wanted);
}

}  // namespace chute::read
