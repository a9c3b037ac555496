#include "read/grain_frame.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/fields.hpp"
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

const PointArray* find_any(const std::vector<PointArray>& arrays, Names names) {
  for (auto name : names)
    if (const auto* array = find_one(arrays, name)) return array;
  return nullptr;
}

/// LAMMPS may write a vector as three scalars.
void join_components(GrainFrame& frame, std::string_view name, Names names, const std::string& stem) {
  if (find_any(frame.arrays, names)) return;
  const PointArray* parts[3];
  for (int c = 0; c < 3; ++c) {
    parts[c] = find_one(frame.arrays, stem + "xyz"[c]);
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
  std::vector<std::string_view> there;
  for (const auto& array : frame.arrays) there.push_back(array.name);
  throw InputError(
      fmt::format("{}: no array of radii or diameters (arrays: {}); give a radius for all grains",
                  frame.file.string(), there.empty() ? "none" : fmt::format("{}", fmt::join(there, ", "))));
}

void check(const GrainFrame& frame) {
  const auto fail = [&](const std::string& what) { throw InputError(frame.file.string() + ": " + what); };
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const double position[3] = {frame.x[i], frame.y[i], frame.z[i]};
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(position[c])) fail(fmt::format("point {}: {} is not a finite number", i, "xyz"[c]));
    if (!(frame.radius[i] > 0) || !std::isfinite(frame.radius[i]))
      fail(fmt::format("point {}: radius {} is not allowed, must be > 0", i, frame.radius[i]));
  }
}

}  // namespace

const PointArray* GrainFrame::find(std::string_view name) const {
  if (const auto* array = find_one(arrays, name)) return array;
  for (const Names group : groups)
    if (std::find(group.begin(), group.end(), name) != group.end()) return find_any(arrays, group);
  return nullptr;
}

bool GrainFrame::is_fixed(std::size_t grain) const {
  const auto* type = find_one(arrays, fields::type.name);
  return type && type->components == 1 && type->at(grain) == 0;
}

GrainFrame parse_frame(std::string bytes, const std::filesystem::path& path, std::optional<double> radius) {
  VtkPoints points = parse_vtk(std::move(bytes), path);
  GrainFrame frame;
  frame.file = path;
  if (points.x.empty()) throw InputError(path.string() + ": no points");
  frame.x = std::move(points.x), frame.y = std::move(points.y), frame.z = std::move(points.z);
  frame.arrays = std::move(points.point_arrays);
  for (const auto& [name, text] : points.field_texts)
    if (name == fields::units) frame.units = text;
  for (std::string_view name : {fields::time_value, std::string_view("TIME"), std::string_view("Time")})
    if (const auto* time = find_one(points.field_arrays, name); time && !time->values.empty() && !frame.time)
      frame.time = time->values[0];
  if (const auto* domain = find_one(points.field_arrays, fields::domain);
      domain && domain->values.size() == 6)
    std::copy(domain->values.begin(), domain->values.end(), frame.domain.begin());
  if (const auto* gravity = find_one(points.field_arrays, fields::gravity);
      gravity && gravity->values.size() == 3)
    std::copy(gravity->values.begin(), gravity->values.end(), frame.gravity.begin());
  join_components(frame, fields::velocity.name, velocity_names, "v");
  join_components(frame, fields::angular_velocity.name, spin_names, "omega");
  join_components(frame, fields::force.name, force_names, "f");
  frame.radius = radii(frame, radius);
  check(frame);
  const auto [low, high] = std::minmax_element(frame.z.begin(), frame.z.end());
  frame.dimensions = *low == *high && frame.period(2) == 0 ? 2 : 3;
  return frame;
}

GrainFrame read_frame(const std::filesystem::path& path, std::optional<double> radius) {
  return parse_frame(read_file(path), path, radius);
}

}  // namespace chute::read
