#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/fields.hpp"
#include "write/box.hpp"
#include "write/frame_fields.hpp"
#include "write/frame_file.hpp"

namespace chute::write {
namespace {

using Kind = FrameField::Kind;

/// Edges as LAMMPS's restricted ones: the first along x, the second in the plane of x and y.
bool is_restricted(const Eigen::Matrix3d& edges) {
  return edges(1, 0) == 0 && edges(2, 0) == 0 && edges(2, 1) == 0;
}

std::string bounds_of(const Box& box) {
  const auto& [origin, edges, periodic] = box.lattice;
  std::string flags;
  for (std::size_t k = 0; k < 3; ++k)
    flags += periodic[k] ? " pp" : box.fitted[k] ? " ss" : " ff";  // ss: shrinks to the grains
  if (!is_restricted(edges)) {
    std::string text = fmt::format("ITEM: BOX BOUNDS abc origin{}\n", flags);
    for (int e = 0; e < 3; ++e)
      text += fmt::format("{} {} {} {}\n", edges(0, e), edges(1, e), edges(2, e), origin[e]);
    return text;
  }
  const auto& high = box.high;
  const double xy = edges(0, 1), xz = edges(0, 2), yz = edges(1, 2);
  if (xy == 0 && xz == 0 && yz == 0) {
    std::string text = fmt::format("ITEM: BOX BOUNDS{}\n", flags);
    for (int k = 0; k < 3; ++k) text += fmt::format("{} {}\n", origin[k], high[k]);
    return text;
  }
  // The bounds of a tilted box enclose it.
  std::string text = fmt::format("ITEM: BOX BOUNDS xy xz yz{}\n", flags);
  text += fmt::format("{} {} {}\n", origin[0] + std::min({0.0, xy, xz, xy + xz}),
                      high[0] + std::max({0.0, xy, xz, xy + xz}), xy);
  text += fmt::format("{} {} {}\n", origin[1] + std::min(0.0, yz), high[1] + std::max(0.0, yz), xz);
  return text + fmt::format("{} {} {}\n", origin[2], high[2], yz);
}

/// The names of a field's columns.
std::vector<std::string> columns_of(const FrameField& field) {
  const auto name = without(field.name);
  if (field.kind == Kind::quaternion) return {"quatw", "quati", "quatj", "quatk"};
  if (field.kind == Kind::vector) {
    const std::string stem = name == fields::velocity.name           ? "v"
                             : name == fields::angular_velocity.name ? "omega"
                                                                     : "f";
    return {stem + "x", stem + "y", stem + "z"};
  }
  if (field.components() == 1) return {name};
  std::vector<std::string> names;
  for (int c = 0; c < field.components(); ++c) names.push_back(fmt::format("{}[{}]", name, c + 1));
  return names;
}

/// What numbers of a field that counts from 0 are raised by, for them to begin with 1.
double raise_of(const FrameField* field, bool from_one) {
  if (!from_one || !field || field->kind != Kind::whole || field->array->values.empty()) return 0;
  const auto& values = field->array->values;
  return std::max(0.0, 1 - *std::min_element(values.begin(), values.end()));
}

}  // namespace

std::string lammps_dump(const read::GrainFrame& frame, const FrameFacts& facts) {
  const auto all = fields_of(frame);
  std::string text;
  // LAMMPS's lj units are other ones than m = g = d = 1, but have no names for their quantities either.
  if (!frame.units.empty()) text += fmt::format("ITEM: UNITS\n{}\n", frame.units == "SI" ? "si" : "lj");
  const auto time = facts.time;
  const bool counts = !frame.clock.empty();  // steps, sweeps …
  if (time && !counts) text += fmt::format("ITEM: TIME\n{}\n", *time);
  const auto step =
      time && counts && *time >= 0 ? static_cast<std::uint64_t>(std::llround(*time)) : facts.number;
  text += fmt::format("ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\n", step, frame.size());
  text += bounds_of(box_of(frame, true));

  const auto* id = find_field(all, fields::id.name);
  const auto* type = find_field(all, fields::type.name);
  const double raise_id = raise_of(id, facts.from_one), raise_type = raise_of(type, facts.from_one);
  // LAMMPS's own order: id and type, the place, the rest
  text += "ITEM: ATOMS id type x y z radius";
  for (const auto& field : all)
    if (&field != id && &field != type)
      for (const auto& name : columns_of(field)) text += " " + name;
  text += "\n";
  for (std::size_t i = 0; i < frame.size(); ++i) {
    text +=
        id ? fmt::format("{}", id->array->at(i) + raise_id) : fmt::format("{}", i + (facts.from_one ? 1 : 0));
    text += type && type->kind != Kind::words ? fmt::format(" {}", type->array->at(i) + raise_type)
            : type                            ? fmt::format(" {}", text_of(*type, i, 0))
                                              : std::string(" 1");
    text += fmt::format(" {} {} {} {}", frame.x[i], frame.y[i], frame.z[i], frame.radius[i]);
    for (const auto& field : all) {
      if (&field == id || &field == type) continue;
      for (int c = 0; c < field.components(); ++c) text += " ", text += text_of(field, i, c);
    }
    text += "\n";
  }
  return text;
}

}  // namespace chute::write
