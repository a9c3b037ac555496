#include <fmt/format.h>

#include <cmath>

#include "golden.hpp"
#include "read/contacts.hpp"
#include "read/grain_frame.hpp"
#include "view/frame_renderer.hpp"
#include "view/survey.hpp"

namespace chute::golden {
namespace {
using namespace chute::view;

/// What a frame is drawn from, so that a mutant can change any of it.
struct Subject {
  FrameStyle style;
  read::GrainFrame frame;
  std::vector<read::Contact> contacts;
  double time = 0;
  Survey survey;
};

std::string data(const std::string& name) {
  return std::string(CHUTE_SOURCE_DIR) + "/golden/data/" + name + ".vtp";
}

Subject subject(const FrameStyle& style, const std::string& file) {
  Subject s;
  s.style = style;
  s.frame = read::read_frame(data(file));
  s.time = s.frame.time.value_or(0);
  if (style.chains) s.contacts = read::read_contacts(data("frame-contacts"));
  Surveyor surveyor(style);
  surveyor.see(s.frame);
  for (const auto& contact : s.contacts) surveyor.see_force(contact.force);
  s.survey = surveyor.finish();
  return s;
}

image::Image draw(const Subject& s) {
  return FrameRenderer(s.style, s.survey).draw(s.frame, s.time, s.contacts);
}

using Change = std::function<void(Subject&)>;

Golden golden_of(const std::string& name, const FrameStyle& style, const std::string& file,
                 const std::vector<std::pair<std::string, Change>>& changes) {
  Golden golden;
  golden.name = name;
  golden.made_by = fmt::format("view::FrameRenderer of data/{}.vtp, {}", file, style.describe());
  golden.draw = [=] { return draw(subject(style, file)); };
  for (const auto& [what, change] : changes)
    golden.mutants.push_back({what, [=, change = change] {
                                auto s = subject(style, file);
                                change(s);
                                return draw(s);
                              }});
  return golden;
}

void grow(Subject& s) {
  for (double& r : s.frame.radius) r *= 1.01;
}
void widen(Subject& s) { s.survey.high *= 1.02, s.survey.low *= 1.02; }
void reverse(Subject& s) { s.style.map = s.survey.diverging ? "rdbu_r" : "viridis_r"; }
/// The moving grain that is highest, which nothing hides.
void remove_one(Subject& s) {
  const auto& height = s.survey.up_axis == 1 ? s.frame.y : s.frame.z;
  std::size_t top = 0;
  for (std::size_t i = 0; i < height.size(); ++i)
    if (height[i] > height[top]) top = i;
  s.frame.x[top] += 1000;
}
/// One digit of the label, and the arrow.
void steepen(Subject& s) {
  s.survey.slope += std::acos(-1.0) / 180;
  s.survey.gravity = {std::sin(s.survey.slope), -std::cos(s.survey.slope), 0};
}
void turn_camera(Subject& s) { s.style.camera.azimuth += 0.1; }
void remove_chain(Subject& s) {
  std::size_t strong = 0;
  for (std::size_t i = 0; i < s.contacts.size(); ++i)
    if (s.contacts[i].force > s.contacts[strong].force) strong = i;
  s.contacts.erase(s.contacts.begin() + static_cast<std::ptrdiff_t>(strong));
}
void spin(Subject& s) {
  for (auto& array : s.frame.arrays)
    if (array.name == "angle")
      for (double& angle : array.values) angle += 0.2;
}

FrameStyle small() {
  FrameStyle style;
  style.width = 400, style.height = 300;
  return style;
}

}  // namespace

std::vector<Golden> frame_goldens() {
  std::vector<Golden> all;
  auto style = small();
  style.tilt = style.copies = true;
  all.push_back(golden_of("frame-discs", style, "frame-discs",
                          {{"radius 1 % larger", grow},
                           {"colour range 2 % wider", widen},
                           {"colour map reversed", reverse},
                           {"one grain missing", remove_one},
                           {"spin marks turned by 0.2", spin}}));
  style = small();
  style.chains = true, style.background = Background::dark;
  all.push_back(golden_of("frame-chains", style, "frame-discs",
                          {{"one force chain missing", remove_chain}, {"radius 1 % larger", grow}}));
  style = small();
  style.arrows = true, style.background = Background::transparent, style.color = "angular_velocity";
  all.push_back(golden_of("frame-arrows", style, "frame-discs",
                          {{"colour map reversed", reverse},
                           {"colour range 2 % wider", widen},
                           {"slope of 19 for 18 degrees", steepen},
                           {"one grain missing", remove_one}}));
  style = small();
  style.tilt = true;
  all.push_back(golden_of("frame-spheres", style, "frame-spheres",
                          {{"camera turned by 0.1 degrees", turn_camera},
                           {"radius 1 % larger", grow},
                           {"colour range 2 % wider", widen},
                           {"one grain missing", remove_one}}));
  style = small();
  style.occlusion = true, style.background = Background::dark, style.map = "batlow";
  all.push_back(golden_of(
      "frame-occlusion", style, "frame-spheres",
      {{"occlusion off", [](Subject& s) { s.style.occlusion = false; }}, {"one grain missing", remove_one}}));
  all.back().tolerance = image::occlusion;
  return all;
}

}  // namespace chute::golden
