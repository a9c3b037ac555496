#include <fmt/format.h>

#include <array>

#include "write/frame_fields.hpp"
#include "write/frame_file.hpp"

namespace chute::write {
namespace {

using Kind = FrameField::Kind;

std::string columns_text(const FrameField& field) {
  const auto name = without(field.name, ",\"#");
  if (field.components() == 1) return "," + name;
  constexpr std::array<const char*, 4> quaternion{"w", "x", "y", "z"}, vector{"x", "y", "z", ""};
  std::string names;
  for (int c = 0; c < field.components(); ++c) {
    const auto k = static_cast<std::size_t>(c);
    names += field.kind == Kind::quaternion ? fmt::format(",{}_{}", name, quaternion[k])
             : field.components() == 3      ? fmt::format(",{}_{}", name, vector[k])
                                            : fmt::format(",{}_{}", name, c);
  }
  return names;
}

std::string comments_of(const read::GrainFrame& frame, const FrameFacts& facts, bool one_time) {
  std::string text = "# a row is a grain; names, units and signs: chute info --columns\n";
  if (!frame.units.empty()) text += fmt::format("# units: {}\n", frame.units);
  if (one_time && facts.time)
    text += fmt::format("# {} = {}\n", frame.clock.empty() ? "time" : frame.clock, *facts.time);
  for (int axis = 0; axis < 3; ++axis)
    if (frame.period(axis) > 0)
      text += fmt::format("# periodic along {}: {} to {}\n", "xyz"[axis], frame.domain.min()[axis],
                          frame.domain.max()[axis]);
  if (const auto& g = frame.gravity; g.norm() > 0)
    text += fmt::format("# gravity: {} {} {}\n", g[0], g[1], g[2]);
  return text;
}

std::string table(const read::GrainFrame& frame, const FrameFacts& facts, bool head, bool timed) {
  const auto all = fields_of(frame);
  std::string text;
  if (head) {
    text = comments_of(frame, facts, !timed);
    text += timed ? "frame,time,x,y,z,radius" : "x,y,z,radius";
    for (const auto& field : all) text += columns_text(field);
    text += "\n";
  }
  const auto begin =
      timed ? fmt::format("{},{},", facts.number, facts.time ? fmt::format("{}", *facts.time) : "")
            : std::string();
  for (std::size_t i = 0; i < frame.size(); ++i) {
    text += begin + fmt::format("{},{},{},{}", frame.x[i], frame.y[i], frame.z[i], frame.radius[i]);
    for (const auto& field : all)
      for (int c = 0; c < field.components(); ++c) text += ",", text += text_of(field, i, c);
    text += "\n";
  }
  return text;
}

}  // namespace

std::string csv_frame(const read::GrainFrame& frame, const FrameFacts& facts) {
  return table(frame, facts, true, false);
}
std::string csv_rows(const read::GrainFrame& frame, const FrameFacts& facts, bool head) {
  return table(frame, facts, head, true);
}

}  // namespace chute::write
