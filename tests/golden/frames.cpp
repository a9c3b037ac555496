#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "golden.hpp"
#include "read/grain_frame.hpp"
#include "read/network.hpp"
#include "read/surroundings.hpp"
#include "view/frame_renderer.hpp"
#include "view/survey.hpp"
#include "view/time_series.hpp"

namespace chute::golden {
namespace {
using namespace chute::view;

/// What a frame is drawn from, so that a mutant can change any of it.
struct Subject {
  FrameStyle style;
  read::GrainFrame frame;
  std::vector<read::ForceLink> links;
  std::vector<read::GrainFrame> earlier;  ///< for trails, the oldest first
  std::vector<read::WallPiece> walls;
  std::vector<read::Impact> impacts;
  double time = 0;
  Survey survey;
};

std::string data(const std::string& name) {
  return std::string(CHUTE_SOURCE_DIR) + "/golden/data/" + name + ".vtp";
}

/// A contact wherever two grains touch, the stronger the deeper they overlap.
std::vector<read::ForceLink> touching(const read::GrainFrame& f) {
  std::vector<read::ForceLink> found;
  for (std::size_t i = 0; i < f.size(); ++i)
    for (std::size_t k = i + 1; k < f.size(); ++k) {
      const double deep = f.radius[i] + f.radius[k] - (f.centre(i) - f.centre(k)).norm();
      if (deep > 0) found.push_back({f.centre(i), f.centre(k), deep});
    }
  return found;
}

/// Where grains would be after `time` in free flight.
read::GrainFrame moved(read::GrainFrame frame, double time) {
  const auto* velocity = frame.find("velocity");
  for (std::size_t i = 0; i < frame.size(); ++i) {
    frame.x[i] += time * velocity->at(i, 0), frame.y[i] += time * velocity->at(i, 1);
    frame.z[i] += time * velocity->at(i, 2);
  }
  return frame;
}

using Change = std::function<void(Subject&)>;
void nothing(Subject&) {}

/// `furnish` adds to the frame what its file does not hold.
Subject subject(const FrameStyle& style, const std::string& file, const Change& furnish) {
  Subject s;
  s.style = style;
  s.frame = read::read_frame(data(file));
  furnish(s);
  s.time = s.frame.time.value_or(0);
  if (style.chains)
    s.links = file == "frame-discs" ? read::read_network(data("frame-contacts")) : touching(s.frame);
  for (int back = style.trail; back > 0; --back) s.earlier.push_back(moved(s.frame, -0.12 * back));
  Surveyor surveyor(style);
  surveyor.see(s.frame);
  for (const auto& link : s.links) surveyor.see_force(link.force);
  s.survey = surveyor.finish();
  return s;
}

image::Image draw(const Subject& s) {
  std::vector<const read::GrainFrame*> earlier;
  for (const auto& frame : s.earlier) earlier.push_back(&frame);
  return FrameRenderer(s.style, s.survey)
      .draw({.frame = s.frame,
             .time = s.time,
             .links = s.links,
             .earlier = earlier,
             .walls = s.walls,
             .impacts = s.impacts});
}

/// `prepare` changes the subject when all is known of it.
Golden golden_of(const std::string& name, const FrameStyle& style, const std::string& file,
                 const std::vector<std::pair<std::string, Change>>& changes, const Change& prepare = nothing,
                 const Change& furnish = nothing) {
  Golden golden;
  golden.name = name;
  golden.made_by = fmt::format("view::FrameRenderer of data/{}.vtp, {}", file, style.describe());
  const auto prepared = [=] {
    auto s = subject(style, file, furnish);
    prepare(s);
    return s;
  };
  golden.draw = [=] { return draw(prepared()); };
  for (const auto& [what, change] : changes)
    golden.mutants.push_back({what, [=, change = change] {
                                auto s = prepared();
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
/// The strongest of those that lie high, which nothing hides in space.
void remove_upper_chain(Subject& s) {
  double top = 0;
  for (const auto& c : s.links) top = std::max(top, c.from.z());
  const auto seen = [&](const read::ForceLink& c) {
    return std::min(c.from.z(), c.to.z()) > 0.8 * top ? c.force : 0;
  };
  s.links.erase(std::max_element(s.links.begin(), s.links.end(),
                                 [&](const auto& a, const auto& b) { return seen(a) < seen(b); }));
}
void remove_chain(Subject& s) {
  std::size_t strong = 0;
  for (std::size_t i = 0; i < s.links.size(); ++i)
    if (s.links[i].force > s.links[strong].force) strong = i;
  s.links.erase(s.links.begin() + static_cast<std::ptrdiff_t>(strong));
}
void forget_oldest(Subject& s) { s.earlier.erase(s.earlier.begin()); }
void add_series(Subject& s) {
  s.survey.series =
      read_time_series(std::string(CHUTE_SOURCE_DIR) + "/golden/data/frame-series.csv", {"v_x"});
}
void spin(Subject& s) {
  for (auto& array : s.frame.arrays)
    if (array.name == "angle")
      for (double& angle : array.values) angle += 0.2;
}

/// Orientations all over the sphere, and three materials.
void turn_and_mix(Subject& s) {
  read::PointArray orientation{"orientation", 4, {}}, material{"material", 1, {}};
  for (std::size_t i = 0; i < s.frame.size(); ++i) {
    const double t = static_cast<double>(i);
    const Eigen::Quaterniond q(
        Eigen::AngleAxisd(2.4 * t, Eigen::Vector3d(std::sin(t), std::cos(t), 0.5).normalized()));
    orientation.values.insert(orientation.values.end(), {q.w(), q.x(), q.y(), q.z()});
    material.values.push_back(static_cast<double>(i * i % 3));
  }
  s.frame.arrays.push_back(orientation), s.frame.arrays.push_back(material);
}
void turn_grains(Subject& s) {
  for (auto& array : s.frame.arrays)
    if (array.name == "orientation")
      for (std::size_t i = 0; i < s.frame.size(); ++i) {
        double* const q = &array.values[4 * i];
        const Eigen::Quaterniond turned =
            Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX()) * Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
        q[0] = turned.w(), q[1] = turned.x(), q[2] = turned.y(), q[3] = turned.z();
      }
}
/// Another program's grains of eleven species, told by words, of which a few have colours only.
void mix_species(Subject& s) {
  read::PointArray species{"species", 1, {}};
  for (int word = 0; word < 11; ++word) species.words.push_back(fmt::format("S{}_{}", word, word * word));
  for (std::size_t i = 0; i < s.frame.size(); ++i)
    species.values.push_back(std::floor(11 * std::pow(static_cast<double>(i * 7 % 50) / 50, 2)));
  s.frame.own = false, s.frame.arrays.push_back(species);
}
/// In a box that tilts.
void tilt_box(Subject& s) {
  auto& lattice = s.frame.lattice.emplace();
  lattice.origin = {0, 0, -0.5};
  // clang-format off
  lattice.edges << 10, 2,  -1,
                    0, 6, 1.5,
                    0, 0,   8;
  // clang-format on
}

/// Side walls, and a hit on every bead of the bed, each elsewhere.
void enclose_and_hit(Subject& s) {
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < s.frame.size(); ++i) box.extend(s.frame.centre(i));
  const auto &a = box.min(), &b = box.max();
  for (const double y : {a.y() - 0.6, b.y() + 0.6})
    s.walls.push_back({0, {{a.x(), y, a.z()}, {b.x(), y, a.z()}, {b.x(), y, b.z()}, {a.x(), y, b.z()}}});
  const auto* ids = s.frame.find("id");
  for (std::size_t i = 0; i < s.frame.size(); ++i) {
    const double t = static_cast<double>(i);
    const Eigen::Vector3d out = Eigen::Vector3d(std::sin(t) - 0.5, std::cos(t) - 0.5, 2).normalized();
    if (s.frame.is_fixed(i))
      s.impacts.push_back({s.frame.centre(i) + s.frame.radius[i] * out, 0,
                           ids ? std::llround(ids->at(i)) : static_cast<long long>(i)});
  }
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
  style = small();
  style.tilt = true, style.color = "none";
  all.push_back(
      golden_of("frame-plot", style, "frame-discs",
                {{"half a time unit later", [](Subject& s) { s.time += 0.5; }},
                 {"one value 2 % higher", [](Subject& s) { s.survey.series.columns[0].values[4] *= 1.02; }},
                 {"another quantity", [](Subject& s) { s.survey.series.columns[0].name = "v_y"; }}},
                add_series));
  style = small();
  style.trail = 12, style.spin = false, style.map = "cividis", style.background = Background::dark;
  all.push_back(golden_of("frame-trails", style, "frame-discs",
                          {{"trails one frame shorter", forget_oldest}, {"radius 1 % larger", grow}}));
  style = small();
  style.camera.window = {4, 12, 0, 5}, style.range = {0.5, 1.5}, style.color = "velocity:x",
  style.map = "batlow_r";
  all.push_back(golden_of("frame-window", style, "frame-discs",
                          {{"window 1 % wider", [](Subject& s) { (*s.style.camera.window)[1] += 0.08; }},
                           {"colour range 2 % wider", widen},
                           {"no spin marks", [](Subject& s) { s.style.spin = false; }}}));
  style = small();
  style.furniture = false, style.copies = true, style.color = "radius";
  all.push_back(golden_of("frame-bare", style, "frame-discs",
                          {{"without copies", [](Subject& s) { s.style.copies = false; }},
                           {"with colour bar", [](Subject& s) { s.style.furniture = true; }}}));
  style = small();
  style.chains = true, style.background = Background::transparent, style.camera.azimuth = 60;
  style.camera.zoom = 2;
  all.push_back(golden_of(
      "frame-network", style, "frame-spheres",
      {{"one force chain missing", remove_upper_chain}, {"camera turned by 0.1 degrees", turn_camera}}));
  style = small();
  style.trail = 6, style.arrows = true, style.camera.elevation = 35;
  style.camera.zoom = 1.3;
  all.push_back(golden_of("frame-flight", style, "frame-spheres",
                          {{"without trails", [](Subject& s) { s.style.trail = 0, s.earlier.clear(); }},
                           {"without arrows", [](Subject& s) { s.style.arrows = false; }}}));
  style = small();
  style.color = "material", style.outlines = style.floor = style.box = true;
  all.push_back(golden_of("frame-materials", style, "frame-spheres",
                          {{"grains turned by 0.2", turn_grains},
                           {"without outlines", [](Subject& s) { s.style.outlines = false; }},
                           {"without floor", [](Subject& s) { s.style.floor = false; }},
                           {"without box", [](Subject& s) { s.style.box = false; }},
                           {"two materials exchanged",
                            [](Subject& s) { std::swap(s.survey.categories[0], s.survey.categories[1]); }}},
                          nothing, turn_and_mix));
  style = small();
  style.color = "species";
  all.push_back(golden_of("frame-species", style, "frame-discs",
                          {{"two species exchanged",
                            [](Subject& s) { std::swap(s.survey.field.words[0], s.survey.field.words[1]); }},
                           {"another name", [](Subject& s) { s.survey.kind_names[2] = "S2_5000"; }},
                           {"without others", [](Subject& s) { s.survey.other_kinds = false; }},
                           {"on dark ground", [](Subject& s) { s.style.background = Background::dark; }}},
                          nothing, mix_species));
  style = small();
  style.box = true, style.color = "none", style.up = Eigen::Vector3d(0, -0.2, 1), style.camera.azimuth = 15;
  all.push_back(golden_of("frame-lattice", style, "frame-spheres",
                          {{"tilted by 0.3 more", [](Subject& s) { s.survey.lattice->edges(0, 1) += 0.3; }},
                           {"without box", [](Subject& s) { s.style.box = false; }},
                           {"up along z", [](Subject& s) { s.survey.up = Eigen::Vector3d::UnitZ(); }}},
                          nothing, tilt_box));
  style = small();
  style.occlusion = style.impacts = true, style.color = "none", style.spin = false;
  style.cuts = {{2, true, 1.2}}, style.camera.elevation = 50;
  all.push_back(
      golden_of("frame-impacts", style, "frame-spheres",
                {{"without walls", [](Subject& s) { s.walls.clear(); }},
                 {"the front wall 0.1 higher",
                  [](Subject& s) { s.walls[0].corners[2].z() += 0.1, s.walls[0].corners[3].z() += 0.1; }},
                 {"without impacts", [](Subject& s) { s.impacts.clear(); }},
                 {"cut lower", [](Subject& s) { s.style.cuts[0].value -= 0.6; }}},
                nothing, enclose_and_hit));
  style = small();
  style.opacity = 0.25, style.color = "radius", style.chains = true;
  style.outlines = style.floor = true;
  style.camera.elevation = 15;
  all.push_back(golden_of("frame-glass", style, "frame-spheres",
                          {{"opacity 0.3", [](Subject& s) { s.style.opacity = 0.3; }},
                           {"one force chain missing", remove_upper_chain},
                           {"camera turned by 0.1 degrees", turn_camera}}));
  return all;
}

}  // namespace chute::golden
