#include "experiments/experiment.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "common/angle.hpp"
#include "common/atomic_file.hpp"
#include "core/sphere.hpp"

namespace chute::experiments {
namespace {

using namespace std::string_view_literals;
using Kind = Experiment::Kind;
constexpr std::array kind_words{"normal-impact"sv, "oblique-impact"sv, "column"sv, "brake-failure"sv,
                                "pushed-cylinder"sv};

double mass_of(const GrainSpec& grain) {
  return grain.mass ? *grain.mass : sphere_mass(*grain.density, grain.radius);
}
Ball<2> ball_of(const GrainSpec& grain) {
  return {grain.radius, mass_of(grain), {}, {{grain.spin}}, grain.fixed};
}

bool is_impact(Kind kind) { return kind == Kind::normal_impact || kind == Kind::oblique_impact; }

}  // namespace

// Outside the unnamed namespace: the archives find these by the type that they describe.

/// The table [experiment].
struct Table {
  Experiment& of;
};

template <class Archive>
static void describe(Archive& a, GrainSpec& grain) {
  a.required("radius", grain.radius, positive);
  a.value("mass", grain.mass, positive);
  a.value("density", grain.density, positive);
  a.value("spin", grain.spin);
  a.value("fixed", grain.fixed);
  a.check(grain.mass.has_value() != grain.density.has_value(), grain.mass ? "density" : "mass",
          "give either mass or density");
}

template <class Archive>
static void check_angle(const Archive& a, const Experiment& e) {
  a.check(e.psi.has_value() + e.angle.has_value() + e.sine.has_value() == 1, "kind",
          "needs one of psi = 1.5, angle = \"60 deg\" and sin = 0.9: the impact angle");
  if (!e.angle) return;
  const auto theta = parse_angle(*e.angle);
  a.check(
      theta && *theta >= 0 && *theta < std::numbers::pi / 2, "angle",
      fmt::format("\"{}\" is not allowed, write an angle from \"0 deg\" to less than \"90 deg\"", *e.angle));
}

template <class Archive>
static void describe_grains(Archive& a, Experiment& e) {
  a.required_section("i", e.i);
  a.check(!e.i.fixed, "i", "moves: only j can be fixed");
  if (e.kind == Kind::column) return;
  a.section("j", e.j);
  a.check(!e.j || !e.j->fixed || e.j->spin == 0, "j", "a fixed grain does not spin");
}

template <class Archive>
static void describe(Archive& a, Table& table) {
  Experiment& e = table.of;
  a.choice("kind", e.kind, kind_words);
  if (e.kind == Kind::pushed_cylinder) {
    a.required("push", e.push, non_negative);
    a.required("duration", e.duration, positive);
    a.required("block_friction", e.block_friction, non_negative);
    a.value("time_step", e.time_step, positive);
    a.check(!e.push.empty() && e.push.size() == e.duration.size(), "duration",
            "must have as many numbers as push");
    return;
  }
  a.required("velocity", e.velocity, positive);
  const bool oblique = e.kind == Kind::oblique_impact || e.kind == Kind::brake_failure;
  if (oblique) {
    a.value("psi", e.psi, non_negative);
    a.value("angle", e.angle);
    a.value("sin", e.sine, Range{0, 1, false, true});
  }
  if (!is_impact(e.kind)) a.required("count", e.count, between(1, 1e5));
  if (e.kind == Kind::column) a.required("gap_time", e.gap_time, positive);
  a.value("steps_per_contact", e.steps_per_contact, at_least(10));
  describe_grains(a, e);
  if (oblique) check_angle(a, e);  // last: a check before all keys are known takes them for slips of the pen
}

struct Output {
  Experiment& of;
};
template <class Archive>
static void describe(Archive& a, Output& output) {
  a.section("series", output.of.series);
  if (output.of.kind != Kind::pushed_cylinder) a.section("frames", output.of.frames);
}

template <class Archive>
static void describe(Archive& a, Experiment& e) {
  a.value("title", e.title);
  a.choice("units", e.units, scene::units_words);
  Table table{e};
  a.required_section("experiment", table);
  a.required_section("contact", e.contact);
  Output output{e};
  if constexpr (Archive::reading) {
    laws::check_contact_time(e.contact, e.pair(), a);
    a.check(e.kind != Kind::pushed_cylinder || e.units == scene::Units::reduced, "units",
            "of the pushed cylinder are reduced: m = g = r = 1");
    auto made = e.laws();
    a.check(e.kind != Kind::pushed_cylinder || laws::friction(made.shear), "contact",
            "the pushed cylinder wants a tangential law with friction");
    const bool forgets =
        std::visit([]<class Law>(const Law&) { return !laws::NormalWithMemory<Law>; }, made.normal);
    a.check(e.kind != Kind::pushed_cylinder || forgets, "contact",
            "the pushed cylinder wants a normal law without a memory");
    e.series.every = e.kind == Kind::pushed_cylinder
                         ? std::accumulate(e.duration.begin(), e.duration.end(), 0.0) / 1000
                         : e.step() * e.steps_per_contact / 100;
  }
  a.section("output", output);
}

double Experiment::theta() const {
  if (psi) return std::atan(*psi);
  if (sine) return std::asin(*sine);
  return angle ? parse_angle(*angle).value() : 0;
}

laws::Pair Experiment::pair() const {
  if (kind == Kind::pushed_cylinder) return {1, 1};
  Ball<2> other = ball_of(j.value_or(i));
  other.fixed |= kind == Kind::brake_failure;
  return pair_of(ball_of(i), other);
}

double Experiment::reach() const {
  return kind == Kind::pushed_cylinder ? 1 : i.radius + j.value_or(i).radius;
}

BinaryImpact<2> Experiment::impact() const {
  BinaryImpact<2> impact;
  impact.laws = laws();
  impact.i = ball_of(i);
  impact.j = ball_of(j.value_or(i));
  if (!j) impact.j.spin = impact.i.spin;
  impact.normal = {{1, 0}};
  // s = (n_y, −n_x) = (0, −1): v_s > 0. Half of the motion on each grain, unless one is fixed
  const double part = impact.j.fixed ? 1 : 0.5;
  const Vec<2> way{{velocity * std::cos(theta()), velocity * std::sin(theta())}};
  impact.i.velocity = part * way;
  impact.j.velocity = (part - 1) * way;
  impact.steps = steps_per_contact;
  return impact;
}

Column Experiment::column_set_up() const {
  Column column;
  column.laws = laws();
  column.grain = ball_of(i);
  column.count = static_cast<int>(count);
  column.speed = velocity;
  column.gap_time = gap_time;
  column.steps_per_contact = steps_per_contact;
  return column;
}

BrakeFailure Experiment::brake_failure() const {
  BrakeFailure set_up;
  set_up.laws = laws();
  set_up.ball = ball_of(i);
  set_up.ball.velocity = {{velocity, 0}};
  set_up.wall_radius = j.value_or(i).radius;
  set_up.count = static_cast<int>(count);
  set_up.sine = std::sin(theta());
  set_up.steps = steps_per_contact;
  return set_up;
}

PushedCylinder Experiment::cylinder() const {
  PushedCylinder set_up;
  const auto made = laws();
  set_up.normal = made.normal;
  set_up.plane = made.shear;
  set_up.block = made.shear;
  *laws::friction(set_up.block) = block_friction;
  set_up.time_step = time_step;
  return set_up;
}

std::vector<Push> Experiment::pushes() const {
  std::vector<Push> pushes;
  for (std::size_t k = 0; k < push.size(); ++k) pushes.push_back({push[k], duration[k]});
  return pushes;
}

double Experiment::step() const {
  switch (kind) {
    case Kind::normal_impact:
    case Kind::oblique_impact:
      return impact().shortest_time() / steps_per_contact;
    case Kind::column:
      return column_set_up().contact_time() / steps_per_contact;
    case Kind::brake_failure:
      return brake_failure().shortest_time() / steps_per_contact;
    case Kind::pushed_cylinder:
      return time_step;
  }
  return 0;
}

bool is_experiment(std::string_view text, const std::string& name) {
  return parse_toml(text, name).contains("experiment");
}

bool is_experiment(const std::filesystem::path& file) {
  return is_experiment(read_file(file), file.string());
}

Experiment parse_experiment(std::string_view text, const std::string& name,
                            const std::vector<std::string>& settings) {
  toml::table table = parse_toml(text, name);
  for (const auto& setting : settings) set_by_path(table, setting);
  TomlReader reader(table, name);
  Experiment experiment;
  describe(reader, experiment);
  reader.finish();
  return experiment;
}

Experiment read_experiment(const std::filesystem::path& file, const std::vector<std::string>& settings) {
  return parse_experiment(read_file(file), file.string(), settings);
}

std::string to_toml(const Experiment& experiment) {
  TomlWriter writer;
  Experiment copy = experiment;
  describe(writer, copy);
  return writer.text();
}

std::vector<Fact> facts(const Experiment& e) {
  const bool si = e.units == scene::Units::si;
  std::vector<Fact> list;
  if (e.kind != Kind::pushed_cylinder) {
    list.push_back({"m_eff", e.pair().m_eff, si ? "kg" : "m", "reduced mass"});
    list.push_back({"R_eff", e.pair().r_eff, si ? "m" : "d", "reduced radius R_i R_j / (R_i + R_j)"});
  }
  if (e.kind == Kind::oblique_impact || e.kind == Kind::brake_failure)
    list.push_back({"theta", e.theta() * 180 / std::numbers::pi, "deg", "impact angle (1.15)"});
  const laws::NamedPair pair{"", "that pair", e.pair(), e.reach()};
  for (const auto& facts :
       {laws::impact_facts(e.contact, si, {pair}), laws::step_facts(e.contact, si, pair, e.step())})
    list.insert(list.end(), facts.begin(), facts.end());
  if (e.kind == Kind::column)
    list.push_back({"detachment below", 1.0 / static_cast<double>(e.count), "", "t_0/t_n: 1/N"});
  return list;
}

}  // namespace chute::experiments
