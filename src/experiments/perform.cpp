#include "experiments/perform.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cmath>

#include "common/column_texts.hpp"
#include "common/error.hpp"
#include "common/toml_reader.hpp"
#include "io/csv.hpp"
#include "measure/outputs.hpp"
#include "run/record.hpp"
#include "run/run_directory.hpp"
#include "run/version.hpp"

namespace chute::experiments {
namespace {

using Kind = Experiment::Kind;
using Engine2 = soft::SoftEngine<2>;

struct UnitsOf {
  std::string speed, time, length, spin;
  explicit UnitsOf(scene::Units units) {
    if (units == scene::Units::si)
      speed = "m/s", time = "s", length = "m", spin = "1/s";
    else
      speed = "sqrt(gd)", time = "sqrt(d/g)", length = "d", spin = "sqrt(g/d)";
  }
};

std::string units_text(const Experiment& e) {
  return std::string(scene::units_words[static_cast<std::size_t>(e.units)]);
}

/// Watches an engine: a row of the series every so many steps, and frames as every run has them.
class Recorder {
 public:
  using Row = std::function<std::vector<double>(const Engine2&)>;
  Recorder(const Experiment& e, const Recording& record, std::vector<std::string> columns, Row row,
           Outcome& into)
      : row_(std::move(row)),
        into_(into),
        run_(std::make_shared<measure::RunContext>()),
        due_(e.series.from, e.series.every, e.step()) {
    into_.columns = std::move(columns);
    into_.columns.insert(into_.columns.begin(), "time");
    run_->facts.units = units_text(e);
    run_->time_step = e.step();
    run_->files = record;
    measure::FramesOutput frames;
    frames.frames = e.frames;
    if (!e.frames) return;
    frames_ = std::move(frames.make(*run_).front());
    frames_due_ = run_->schedule(e.frames->from, e.frames->every);
  }

  void operator()(const Engine2& engine, double time) {
    if (due_.index_at(engine.step()) >= 0) {
      auto row = row_(engine);
      row.insert(row.begin(), time);
      into_.series.push_back(std::move(row));
    }
    if (frames_due_.index_at(engine.step()) < 0) return;
    frames_->look({engine, {}, {}});
    frames_->write({});
  }

 private:
  Row row_;
  Outcome& into_;
  std::shared_ptr<measure::RunContext> run_;  // shared: a watch is copied
  measure::Schedule due_, frames_due_;
  std::shared_ptr<measure::Observer> frames_;
};

/// Overlap and forces of a pair, its relative velocity along n and s, and the spins.
std::vector<double> pair_row(const Engine2& engine) {
  const auto& g = engine.state();
  const auto way = g.place(1) - g.place(0);
  const auto n = (1 / norm(way)) * way;
  const auto dv = g.speed(1) - g.speed(0);
  const double v_n = dot(dv, n), turning = g.radius[0] * g.spin[0][0] + g.radius[1] * g.spin[0][1];
  const auto contacts = engine.contacts();
  const bool touch = !contacts.empty();
  return {touch ? contacts[0].overlap : 0,
          touch ? contacts[0].normal_force : 0,
          touch ? contacts[0].shear_force : 0,
          v_n,
          dv[0] * n[1] - dv[1] * n[0] + turning,
          g.spin[0][0],
          g.spin[0][1]};
}

/// d ln(1 − e_n) / d ln v of the normal law: 0, −1/5, 1/5 in the elastic limits of (3.1), (3.5), (3.6).
double loss_exponent(const laws::ContactLaws& laws, double v, laws::Pair pair) {
  const double step = 1.02, a = laws::normal_impact(laws, v / step, pair).restitution,
               b = laws::normal_impact(laws, v * step, pair).restitution;
  return std::log((1 - b) / (1 - a)) / (2 * std::log(step));
}

Outcome impact(const Experiment& e, const Recording& record) {
  Outcome made;
  auto set_up = e.impact();
  const UnitsOf in(e.units);
  if (record)
    set_up.watch =
        Recorder(e, record, {"overlap", "F_n", "F_s", "v_n", "v_s", "omega_i", "omega_j"}, pair_row, made);
  const auto done = collide(set_up);
  const auto law = laws::normal_impact(set_up.laws, set_up.approach(), set_up.pair());
  const auto add = [&](const char* name, double value, const std::string& unit, const char* meaning) {
    made.results.push_back({name, value, unit, meaning});
  };
  add("e_n", done.restitution(), "", "normal restitution (1.29)");
  add("e_n law", law.restitution, "", "the same from the closed form of the law, or its exact integration");
  add("exponent", loss_exponent(set_up.laws, set_up.approach(), set_up.pair()), "",
      "d ln(1 - e_n)/d ln v of the law at this velocity");
  add("t_n", done.contact_time, in.time, "contact time, to within a step");
  add("e", done.total_restitution(), "", "total restitution (3.9), root of the energies' ratio");
  add("normal_loss", done.normal_loss / done.energy_before, "",
      "part of the energy that the normal force took");
  add("shear_loss", done.shear_loss / done.energy_before, "", "part that the tangential force took");
  if (e.kind == Kind::oblique_impact) {
    const auto before = set_up.j.velocity - set_up.i.velocity, after = done.j.velocity - done.i.velocity;
    add("psi_i", done.psi_before, "", "v_s/|v_n| before (1.32), with the spins");
    add("psi_f", done.psi_after, "", "v_s after over |v_n| before (1.33)");
    if (done.psi_before > 0)
      add("e_t", -done.psi_after / done.psi_before, "", "tangential restitution, -v_s after over before");
    add("braking", norm(before) - dot(after, before) / norm(before), in.speed,
        "-Delta v_x: what the relative velocity lost along itself");
    add("v_bf", 2 * e.reach() * std::cos(e.theta()) / law.contact_time, in.speed,
        "brake failure above this velocity (2.16, corrected)");
  }
  add("v_x i", done.i.velocity[0], in.speed, "of i along the first n");
  add("v_y i", done.i.velocity[1], in.speed, "of i across it");
  add("omega_i", done.i.spin[0], in.spin, "spin of i, anticlockwise");
  add("v_x j", done.j.velocity[0], in.speed, "of j along the first n");
  add("v_y j", done.j.velocity[1], in.speed, "of j across it");
  add("omega_j", done.j.spin[0], in.spin, "spin of j");
  made.time = done.contact_time;
  return made;
}

Outcome column(const Experiment& e, const Recording& record) {
  Outcome made;
  auto set_up = e.column_set_up();
  const auto mean = [N = e.count, v_0 = e.velocity](const Engine2& engine) -> std::vector<double> {
    double momentum = 0, energy = 0;
    for (std::size_t k = 0; k < engine.state().moving; ++k) {
      const double v = engine.state().velocity[0][k] / v_0;
      momentum += v, energy += v * v;
    }
    const auto n = static_cast<double>(N);
    return {static_cast<double>(engine.contacts().size()), momentum / n, energy / n};
  };
  if (record) set_up.watch = Recorder(e, record, {"contacts", "momentum", "energy"}, mean, made);
  const auto done = hit_wall(set_up);
  const auto pair = laws::normal_impact(set_up.laws, e.velocity, e.pair());
  made.results = {
      {"e_tot", done.total_restitution, "", "of the column's momentum (2.15)"},
      {"e", done.energy_restitution, "", "root of the ratio of the kinetic energies"},
      {"e_n", pair.restitution, "", "restitution of two grains"},
      {"duration", done.duration / pair.contact_time, "t_n", "from the first contact to the last"}};
  made.time = done.duration;
  return made;
}

Outcome brake_failure(const Experiment& e, const Recording& record) {
  Outcome made;
  auto set_up = e.brake_failure();
  const UnitsOf in(e.units);
  const auto row = [](const Engine2& engine) -> std::vector<double> {
    const auto& g = engine.state();
    double overlap = 0;
    const auto contacts = engine.contacts();
    for (const auto& c : contacts) overlap = std::max(overlap, c.overlap);
    return {g.position[0][0],
            g.position[1][0],
            g.velocity[0][0],
            g.velocity[1][0],
            g.spin[0][0],
            overlap,
            static_cast<double>(contacts.size())};
  };
  if (record)
    set_up.watch = Recorder(e, record, {"x", "y", "v_x", "v_y", "omega", "overlap", "contacts"}, row, made);
  const auto done = skim(set_up);
  const double t_n = laws::normal_impact(set_up.laws, set_up.approach(), set_up.pair()).contact_time;
  made.results = {
      {"braking", e.velocity - done.ball.velocity[0], in.speed,
       "-Delta v_x: what the ball lost along the wall"},
      {"kick", done.ball.velocity[1], in.speed, "velocity away from the wall"},
      {"touched", static_cast<double>(done.touched), "", "grains of the wall that it touched; hard ones: 1"},
      {"deepest", done.deepest / set_up.wall_radius, "r", "largest overlap over a wall grain's radius"},
      {"omega", done.ball.spin[0], in.spin, "spin afterwards, anticlockwise"},
      {"duration", done.duration / t_n, "t_n", "from the first contact to the end of the last"},
      {"v_bf", 2 * e.reach() * std::cos(e.theta()) / t_n, in.speed,
       "brake failure above this velocity (2.16, corrected)"}};
  made.time = done.duration;
  return made;
}

Outcome pushed_cylinder(const Experiment& e, const Recording& record) {
  Outcome made;
  const auto pushes = e.pushes();
  // The means below are over every step, however many of them the series has.
  const auto states = push(e.cylinder(), pushes, 1);
  const auto every =
      record ? static_cast<std::size_t>(std::max<std::int64_t>(1, std::llround(e.series.every / e.time_step)))
             : 1;
  made.columns = {"time", "F_s^p", "F_s^b", "dv/dt", "domega/dt", "v", "omega"};
  for (std::size_t k = 0; k < states.size(); k += every) {
    const auto& s = states[k];
    made.series.push_back(
        {s.time, s.plane_force, s.block_force, s.acceleration, s.spin_up, s.velocity, s.spin});
  }
  auto laws = e.laws();
  double begin = 0;
  for (std::size_t k = 0; k < pushes.size(); ++k) {
    const auto theory = steady_cylinder(pushes[k].force, e.block_friction, *laws::friction(laws.shear));
    const double end = begin + pushes[k].duration;
    const auto add = [&](const char* name, double CylinderState::*member, double expected) {
      const auto found = steady(states, end - 0.25 * pushes[k].duration, end, member);
      made.results.push_back({fmt::format("{} {}", name, k + 1), found.mean, "",
                              fmt::format("mean of the last quarter at F_p = {}; +- {:.4g}; theory {:.6g}",
                                          pushes[k].force, found.swing, expected)});
      made.errors[made.results.back().name] = found.swing;
    };
    add("F_s^p", &CylinderState::plane_force, theory.plane_force);
    add("F_s^b", &CylinderState::block_force, theory.block_force);
    add("dv/dt", &CylinderState::acceleration, theory.acceleration);
    add("domega/dt", &CylinderState::spin_up, theory.spin_up);
    begin = end;
  }
  made.time = begin;
  return made;
}

/// Which table of column_texts.hpp its series is.
std::string series_name(Kind kind) {
  switch (kind) {
    case Kind::column:
      return "series.csv of column";
    case Kind::brake_failure:
      return "series.csv of brake-failure";
    case Kind::pushed_cylinder:
      return "series.csv of pushed-cylinder";
    default:
      return "series.csv of impacts";
  }
}

void write_files(const Experiment& e, const Outcome& outcome, io::RunFiles& files) {
  const auto comment =
      fmt::format("{}; units: {}; chute {} ({})", e.title, units_text(e), run::version, run::commit);
  const bool is_si = e.units == scene::Units::si;
  io::Csv series({"what happened, per time since the surfaces met", comment},
                 {outcome.columns.begin(), outcome.columns.end()});
  for (const auto& row : outcome.series) series.row(std::vector<io::Csv::Cell>(row.begin(), row.end()));
  files.write("series.csv", with_column_comments(series_name(e.kind), series.text(), is_si));
  std::vector<std::string> comments{"what the experiment gave", comment};
  for (const auto& r : outcome.results) comments.push_back(fmt::format("{}: {}", r.name, r.meaning));
  io::Csv result(comments, {"name", "unit", "value", "value_err"});
  for (const auto& r : outcome.results) {
    const auto error = outcome.errors.find(r.name);
    result.row({r.name, r.unit},
               {r.value, error == outcome.errors.end() ? io::Csv::Cell() : io::Csv::Cell(error->second)});
  }
  files.write("result.csv", with_column_comments("result.csv", result.text(), is_si));
}

}  // namespace

double Outcome::operator[](const std::string& name) const {
  std::vector<std::string> known;
  for (const auto& r : results) {
    if (r.name == name) return r.value;
    known.push_back(r.name);
  }
  const auto hint = nearest(name, known);
  throw InputError(fmt::format("\"{}\" is no result of this experiment{}, known: {}", name,
                               hint.empty() ? "" : fmt::format(", did you mean \"{}\"?", hint),
                               fmt::join(known, ", ")));
}

Outcome perform(const Experiment& e, const Recording& record) {
  Outcome outcome = e.kind == Kind::column            ? column(e, record)
                    : e.kind == Kind::brake_failure   ? brake_failure(e, record)
                    : e.kind == Kind::pushed_cylinder ? pushed_cylinder(e, record)
                                                      : impact(e, record);
  outcome.steps = std::llround(outcome.time / e.step());
  return outcome;
}

Outcome run_experiment(const Experiment& e, const run::RunOptions& options) {
  run::RunRecord record;
  record.command = options.command_line;
  record.time_step = e.step();
  const auto begin = std::chrono::steady_clock::now();
  run::RunDirectory directory(options.directory, options.existing);
  directory.claim(record);
  try {
    const auto files = std::make_shared<io::RunFiles>(directory.path());
    Outcome outcome = perform(e, files);
    files->write("scene.toml", to_toml(e));
    write_files(e, outcome, *files);
    files->commit();
    record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    record.steps = outcome.steps;
    record.time = outcome.time;
    record.end = "finished";
    record.files = files->sums();
    run::write_record(directory.file("run.json"), record);
    directory.finish();
    return outcome;
  } catch (...) {
    directory.put_back();
    throw;
  }
}

}  // namespace chute::experiments
