#include <fmt/format.h>

#include <algorithm>

#include "common/fields.hpp"
#include "write/box.hpp"
#include "write/frame_fields.hpp"
#include "write/frame_file.hpp"

namespace chute::write {
namespace {

using Kind = FrameField::Kind;

std::string property_of(const FrameField& field) {
  const auto name = without(field.name, ":\"=");
  const char type = field.kind == Kind::words ? 'S' : field.kind == Kind::whole ? 'I' : 'R';
  return fmt::format(":{}:{}:{}", name, type, field.components());
}

/// The first column: the file's own species, or what chute's types say.
std::string species_of(const read::GrainFrame& frame, const FrameField* type, std::size_t grain) {
  if (type && type->kind == Kind::words) return text_of(*type, grain, 0);
  if (frame.own) return frame.is_fixed(grain) ? "bed" : "grain";
  return type ? fmt::format("type{}", text_of(*type, grain, 0)) : "grain";
}

}  // namespace

std::string xyz_frame(const read::GrainFrame& frame, const FrameFacts& facts) {
  auto all = fields_of(frame);
  const auto* words = find_field(all, "species");
  if (!words) words = find_field(all, fields::type.name);
  const auto box = box_of(frame, false);
  const auto& edges = box.lattice.edges;
  const auto& origin = box.lattice.origin;
  std::string text = fmt::format("{}\nLattice=\"", frame.size());
  for (int e = 0; e < 3; ++e)
    text += fmt::format("{}{} {} {}", e ? " " : "", edges(0, e), edges(1, e), edges(2, e));
  text += fmt::format("\" Origin=\"{} {} {}\" pbc=\"", origin[0], origin[1], origin[2]);
  for (std::size_t k = 0; k < 3; ++k)
    text += fmt::format("{}{}", k ? " " : "", box.lattice.periodic[k] ? 'T' : 'F');
  text += "\" Properties=species:S:1:pos:R:3:radius:R:1";
  const bool own_words = words && words->name == "species" && words->kind == Kind::words;
  for (const auto& field : all)
    if (!(own_words && &field == words)) text += property_of(field);
  if (facts.time) text += fmt::format(" Time={}", *facts.time);
  if (!frame.clock.empty()) text += fmt::format(" clock={}", frame.clock);
  if (!frame.units.empty()) text += fmt::format(" units={}", frame.units);
  if (const auto& g = frame.gravity; g.norm() > 0)
    text += fmt::format(" gravity=\"{} {} {}\"", g[0], g[1], g[2]);
  text += "\n";
  for (std::size_t i = 0; i < frame.size(); ++i) {
    text += fmt::format("{} {} {} {} {}", species_of(frame, words, i), frame.x[i], frame.y[i], frame.z[i],
                        frame.radius[i]);
    for (const auto& field : all) {
      if (own_words && &field == words) continue;
      for (int c = 0; c < field.components(); ++c) text += " ", text += text_of(field, i, c);
    }
    text += "\n";
  }
  return text;
}

}  // namespace chute::write
