#include "common/column_texts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/column_units.hpp"
#include "common/experiment_columns.hpp"

namespace chute {
namespace {
using namespace column_units;

constexpr const char* blocks =
    "standard error from the scatter of ten blocks of the time window (standard deviation of their means over √10)";
constexpr const char* starts_error =
    "standard error of the mean over the steady starts; of a single start, from twelve stretches of its time, "
    "enlarged where neighbouring stretches are correlated";

std::vector<ColumnText> layer_columns() {
  return {
      column("h", length, "height above the centres of the bed; of profiles the middle of a layer"),
      column("grains", none, "mean number of grains whose centre lies in the layer"),
      column("eta", none, "area fraction (3D: volume fraction) of the grains whose centre lies in the layer"),
      column("eta_exact", none, "the same of the parts of grains that lie in the layer"),
      column("v_*", speed,
             "mean velocity: x downhill, away from the bed y in the plane and z in space, y then across"),
      column("sigma_*", speed,
             "standard deviation of that velocity component in the layer, in time and from grain to grain"),
      column(
          "temperature", temperature,
          "mean of the squared deviations from the layer's mean velocity, over the dimensions, of a mass of 1"),
      column("omega", spin, "mean spin, > 0 when rolling downhill"),
      column("half_shear", spin,
             "half of dv_x/dh, from the layers above and below; ω of grains that roll on one another"),
      column(
          "kinetic_*", stress,
          "kinetic stress: momentum along the first letter carried along the second by fluctuations; > 0 is pressure"),
      column("contact_*", stress, "contact stress, of forces times branches; > 0 is pressure"),
      column("density", density, "mass of the moving grains per volume"),
      column("coordination", none, "mean number of contacts of a grain")};
}

/// The first column of tables that go with the run's clock: `time`, or what the method counts.
std::vector<ColumnText> behind_clock(const char* meaning, std::vector<ColumnText> others) {
  std::vector<ColumnText> all{
      {"time", fmt::format("{}; shakes, sweeps or updates where the method counts those", meaning), time.si,
       time.reduced},
      column("shakes", none, "the same in shakes made, of packings"),
      column("sweeps", none, "the same in Monte Carlo sweeps made"),
      column("updates", none, "the same in updates of a lattice made")};
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

std::vector<TableText> run_tables() {
  return {
      {"series.csv",
       "an output time",
       "",
       {column("time", time, "since the start; shakes, sweeps or updates where the method counts those"),
        column("shakes", none, "shakes made, of packings"),
        column("sweeps", none, "Monte Carlo sweeps made"),
        column("updates", none, "updates of a lattice made"),
        column(
            "x", length,
            "mean place of the moving grains along the incline, counted on through the periods; > 0 downhill"),
        column("v_*", speed, "mean velocity of the moving grains: x > 0 downhill"),
        column("omega", spin,
               "mean spin, > 0 when rolling downhill (angular_velocity in VTK files counts anticlockwise)"),
        column("contacts", none, "pairs that touch now, those with the bed among them"),
        column("translation", energy, "½ Σ m v² of the moving grains"),
        column("rotation", energy, "½ Σ I ω²"),
        column("elastic", energy, "stored in contacts now"),
        column("gravity_work", energy, "what gravity put in since the start, Σ m g·(way)"),
        column("normal_loss", energy, "taken by normal contact forces since the start"),
        column("shear_loss", energy, "taken by friction since the start"),
        column("wall_work", energy, "what moving walls put in since the start"),
        column("projection_work", energy,
               "potential energy put in by moving pressed hard grains out of each other"),
        column("energy_in", energy, "[inflow], [outflow]: energy that grains brought which came in"),
        column("energy_out", energy,
               "energy that grains took away which left, that of their contacts among it"),
        column(
            "residual", energy,
            "what the account does not explain: works − change of the stored energies − losses; < 0: energy came from nowhere"),
        column("angle", degree, "of an incline that is tilted"),
        column("grains", none, "[inflow], [outflow]: moving grains now, those of the start + entered − left"),
        column("entered", none, "grains that came in since the start"),
        column("left", none, "grains that left since the start"),
        column("waiting", none, "grains that should have come in by now and found no room"),
        column("mass_in", mass, "of all that came in"),
        column("mass_out", mass, "of all that left"),
        column("momentum_in_*", momentum, "of all that came in, when they did"),
        column("momentum_out_*", momentum, "of all that left, when they did"),
        column("sliding_share", none, "contact dynamics: share of the pressed contacts that slide"),
        column("iterations", none, "of the solver in the last step"),
        column("residual_of_solver", none, "in the last step, in the unit of engine.tolerance"),
        column("mean_iterations", none, "of all steps so far"),
        column("most_iterations", none, "of a step so far"),
        column("worst_residual", none, "of a step so far"),
        column("unconverged", none, "steps that used up engine.iterations"),
        column("collisions", none, "collisions so far"),
        column("collisions_put_off", none, "of these such as a step had no room for"),
        column("deepest_overlap", none, "of pressed hard grains so far, in diameters"),
        column("packing_fraction", none, "φ of the bulk; empty where nothing bounds it sideways"),
        column("mean_height", length, "of the moving grains' centres"),
        column("tracer", length, "height of the largest grain's centre; of equal ones, of the first"),
        column("sweeps_made", none, "in all shakes"),
        column("acceptance", none, "share of trial moves that were made"),
        column("trial_length", none, "δ, in mean diameters"),
        column("coordination", none, "contacts of a grain"),
        column(
            "partners", none,
            "how many others a grain that is not round touches: grains, beads, walls, each in however many places"),
        column("events", none, "rolls and drops of a grain in the last shake"),
        column("loosened_fraction", none,
               "φ after the moves at random, before grains were laid, in the last shake"),
        column(
            "surface_angle", angle,
            "of a drum: from the horizontal, of the line across the one from its axis to the middle of all grains"),
        column(
            "core", none,
            "of a drum: distance from their middle of grains smaller than the mean one, over that of larger ones; rms"),
        column("mass", none, "grains on the lattice"),
        column("moving", none, "of these such as move, of a lattice gas"),
        column("momentum_*", none,
               "of a lattice gas, in grains times lattice steps per update: x > 0 downhill"),
        column(
            "flux", none,
            "lattice gas: movers that crossed the end of the lattice in the last update, > 0 along x; voids: grains that left, per update"),
        column("dissipated", none, "energy that a lattice gas lost so far"),
        column("slope", none, "of a pile: its height over its length"),
        column("height", none, "of a pile at its wall"),
        column("topplings", none, "of a pile so far"),
        column("last_avalanche", none, "topplings after the last grain that was added"),
        column("left", none, "grains that left through the orifice so far"),
        column("refilled", none, "grains that came from above so far"),
        column("surface", none, "of voids: height of the highest grain"),
        column("temperature", energy, "DSMC: m⟨(v − u)²⟩/D about the mean velocity of all"),
        column("temperature_rotation", energy, "DSMC: ⟨I ω²⟩ a degree of freedom"),
        column("a_2", none, "DSMC: fourth cumulant of the velocities, 0 of a Maxwellian"),
        column("densest", none, "DSMC: largest packing fraction of a cell now"),
        column("speeds_raised", none, "DSMC: approaches so far that were faster than their cell expected"),
        column("stopped", none,
               "DSMC: flights so far that ended because a grain bounced too often in a step")}},
      {"profiles.csv", "a layer", blocks, layer_columns()},
      {"profiles_fine.csv", "a fine layer", blocks, layer_columns()},
      {"fields.csv", "a height", blocks, layer_columns()},
      {"impact_histograms.csv",
       "a bin",
       blocks,
       {column("pair", none, "whom moving grains hit: grain-grain, grain-bed, all"),
        column("quantity", none, "gamma, v_n, or mean_v_n: the mean |v_n| at each γ"),
        column("x", none, "middle of the bin, in the unit of the quantity; γ modulo π in rad"),
        column("value", none, "probability density, integral 1; of mean_v_n a velocity")}},
      {"pairs.csv",
       "a distance",
       blocks,
       {column("r", none, "distance of centres over the sum of the radii"),
        column("g", none, "pair distribution function")}},
      {"pressure.csv",
       "the one row",
       blocks,
       {column("phi", none, "packing fraction"), column("g_contact", none, "g at contact, extrapolated"),
        column("Z", none, "β P/n of hard grains of one size")}},
      {"velocities.csv", "a sample of a grain", "",
       behind_clock("of the sample",
                    {column("grain", none, "its id"), column("v_*", speed, "its velocity: x > 0 downhill")})},
      {"velocity_histograms.csv",
       "a bin of a component",
       "",
       {column("component", none, "x, y or z"), column("v", speed, "middle of the bin"),
        column("density", per_speed, "probability density")}},
      {"diffusion.csv", "a length of time", blocks,
       behind_clock("length of the pieces",
                    {column("pieces", none, "how many"),
                     column("square_x", square, "mean square of the way along, about the mean drift"),
                     column("square_y", square, "mean square of the way across")})},
      {"diffusion_coefficients.csv",
       "the one row",
       blocks,
       {column("v_x", speed, "mean drift"), column("D_x", spread, "(4.65)"), column("D_y", spread, "(4.66)"),
        column("from_x", time,
               "from which length of pieces on the mean square over 2t stays within a quarter of D_x"),
        column("from_y", time, "the same of D_y"), column("longest", time, "piece")}},
      {"beads.csv",
       "a visit of a grain to a bead",
       "",
       {column("grain", none, "its id"), column("bead", none, "the bead's id"),
        column("time", time, "of the first impact"),
        column("v_n_first", speed, "normal velocity before the first impact, < 0 on approach"),
        column("v_n_last", speed, "after the last; 0 where the grain rolled off"),
        column("rolled", none, "1: it rolled off"), column("hits", none, "impacts"),
        column("stay", time, "from the first onset to that on the next new bead"),
        column("contact", time, "to the end of the last contact")}},
      {"trapping.csv",
       "a grain",
       "",
       {column("grain", none, "its id"), column("stopped", none, "1: it came to rest"),
        column("time", time, "when; or the end of the run"), column("x", length, "where, in the domain"),
        column("y", length, "where, across"), column("way", length, "downhill, so far")}},
      {"trapping_rate.csv",
       "the one row",
       "√stopped over way (Poisson)",
       {column("grains", none, "that moved at trapping.from"), column("stopped", none, "of these"),
        column("way", length, "downhill of all together"), column("rate", rate, "stops a length of way")}},
      {"starting.csv",
       "a grain",
       "",
       {column("grain", none, "its id"), column("rested", none, "1: it lay still for 50 √(d/g)"),
        column("started", none, "1: it then left its place"), column("time", time, "when"),
        column("angle", degree, "of the incline then")}},
      {"bed_neighbours.csv",
       "a pair of neighbouring beads",
       "",
       {column("delta_x", length, "distance of their surfaces")}},
      {"bed_vertices.csv",
       "a Voronoi vertex of the bed",
       "",
       {column("delta_x", length, "distance from the nearest beads' surfaces")}},
      {"forces.csv",
       "a bin",
       blocks,
       {column("force", none, "normal force over the mean of its instant (and layer)"),
        column("density", none, "probability density")}},
      {"moments.csv", "a time", "",
       behind_clock("since the start", {column("temperature", energy, "⟨m c²⟩/D about the mean velocity"),
                                        column("a_2", none, "fourth cumulant, 0 of a Maxwellian")})},
      {"segregation.csv", "an instant", "",
       behind_clock(
           "since the start",
           {column(
                "index_*", none,
                "of a material: 2 (mean of u of its grains − that of all others), with u the part of all grains' volume (2D: area) below "
                "a grain, weighted by it; 1: all of it lies above all others, −1 below, 0: mixed"),
            column("height_*", length, "mean height of the centres of the material's grains")})},
      {"species.csv",
       "a layer",
       blocks,
       {column("h", length, "height above the centres of the bed, the middle of a layer"),
        column("grains_*", none, "mean number of the material's grains whose centre lies in the layer"),
        column("eta_*", none, "their area fraction (3D: volume fraction)"),
        column("v_*", speed,
               "their mean velocity, as in profiles.csv; the material's name follows on the direction"),
        column("temperature_*", temperature,
               "as in profiles.csv, about the mean velocity of that material")}},
      {"heights.csv",
       "a grain",
       blocks,
       {column("grain", none, "its id"), column("height", length, "mean of its centre")}},
      {"across.csv",
       "a strip",
       blocks,
       {column("y", length, "middle of a strip along the flow, across it"),
        column("x", length, "middle of a strip across the flow, > 0 downhill"),
        column("grains", none, "mean number of grains whose centre lies in the strip"),
        column(
            "v_*", speed,
            "their mean velocity: x downhill, away from the bed y in the plane and z in space, y then across"),
        column("temperature", temperature,
               "mean of the squared deviations from it, over the dimensions, of a mass of 1")}},
      {"history.csv", "a layer at a time", "",
       behind_clock("since the start",
                    {column("h", length, "middle of the layer, above the centres of the bed"),
                     column("grains", none, "mean number of grains whose centre lies in the layer"),
                     column("v_x", speed, "their mean velocity, > 0 downhill"),
                     column("sigma_x", speed, "its standard deviation from grain to grain"),
                     column("gravity_power", power,
                            "with powers: what gravity does on the grains of the layer, "
                            "per time and volume (2D: area)"),
                     column("carried_power", power,
                            "what contacts bring in from the layers beside; < 0: take there. "
                            "Over all layers its sum is 0"),
                     column("dissipation", power,
                            "what contacts in the layer take from the motion: their losses, and "
                            "what their springs store. gravity_power + carried_power - "
                            "dissipation is what the grains' motion gains")})},
      {"discharge.csv", "a time", "",
       behind_clock("since the start", {column("out", none, "grains below the opening"),
                                        column("out_mass", mass, "mass of these")})},
      {"surface.csv", "a strip across x at a time", "",
       behind_clock(
           "since the start",
           {column("x", length, "middle of the strip"),
            column(
                "height", length,
                "of the highest point of the grains whose centre lies in it, above the bed's centres; in space the "
                "mean of that of its squares")})},
      {"slopes.csv", "a time", "",
       behind_clock(
           "since the start",
           {column(
                "angle_left", degree,
                "by which the surface falls from its highest place towards smaller x, against the bed: of a line "
                "through its strips between output.surface.low and high of the greatest height"),
            column("angle_right", degree, "the same towards larger x"),
            column("top", length, "x of the highest place"),
            column("height", length, "of that, above the bed's centres")})},
      {"avalanches.csv",
       "a size",
       "",
       {column("size", none, "topplings after one grain was added"),
        column("count", none, "avalanches so large")}},
      {"sweep.csv",
       "a place of the grid, behind the columns of the axes",
       starts_error,
       {column("verdict", none, "that most of its starts have"),
        column("runs", none, "where they are, in the sweep's folder"), column("starts", none, "how many"),
        column("stopped", none, "of these"), column("steady", none, "of these"),
        column("accelerating", none, "of these"), column("runaway", none, "of these"),
        column("unsettled", none, "of these"),
        column("v_x", speed, "mean over the steady starts, > 0 downhill"),
        column("v_x_median", speed, "median over all that still move; error from the median deviation"),
        column("omega", spin, "mean over the steady starts, > 0 when rolling downhill"),
        column("kinetic", temperature, "energy of motion per mass, mean over the steady starts")}},
      {"starts.csv",
       "a start, with the columns of the axes",
       "standard error from twelve stretches of the time, enlarged where neighbouring stretches are correlated",
       {column("verdict", none, "what became of it"),
        column("run", none, "where it is, in the sweep's folder"), column("seed", none, "of its run"),
        column("start", none, "number of the grain in its run"),
        column("from", time, "from when on its means count"),
        column("v_x", speed, "way over time, > 0 downhill"),
        column("omega", spin, "mean spin, > 0 when rolling downhill"),
        column("kinetic", temperature, "energy of motion per mass")}},
      {"boundaries.csv",
       "a place of the grid, behind the columns of the axes",
       "half of the bracket that is left",
       {column("AB", none, "where A, stopping, ends, in the unit of the key; empty: not within the range"),
        column("BC", none, "where B, a steady state that forgets its start, ends")}},
      {"figure",
       "a point of a figure",
       "as the figure's comments say",
       {column("panel", none, "of the figure"), column("series", none, "name of the curve"),
        column("x", none, "as the comment \"x:\" says"), column("y", none, "as the comment \"y:\" says")}},
      {"frames/*.vtp",
       "a grain, beads of the bed behind the moving ones",
       "",
       {column("id", none, "the same in all frames"), column("type", none, "0 fixed, 1 moving"),
        column("material", none, "species"), column("radius", length, "R"), column("mass", mass, "m"),
        column("velocity", speed, "x downhill, away from the bed y in the plane and z in space"),
        column("angular_velocity", spin,
               "anticlockwise in the plane: < 0 when rolling downhill (omega in tables is > 0 then)"),
        column("angle", angle, "turned since the start, anticlockwise"),
        column("orientation", none, "in space: quaternion w, x, y, z"),
        column("force", force, "sum of all contact forces and gravity"),
        column(
            "body", none,
            "where grains are not round and the points are their spheres: the grain, as contacts name it")}},
      {"contacts/*.vtp",
       "a contact, a line between the centres of a and b",
       "",
       {column("a", none, "id of a moving grain"), column("b", none, "id of the other; wall k is −1 − k"),
        column("point", length, "where they touch"), column("normal", none, "unit vector from a to b"),
        column("branch", length, "from a's centre to b's"), column("overlap", length, "of soft grains"),
        column("force", force, "on a; of hard grains the impulse over the time between frames"),
        column("normal_force", force, "> 0 pushes apart"),
        column("shear_force", force, "along the tangent (in the plane the normal turned by +90°)"),
        column("state", none, "1 sticks, 2 slides, 0 where the method does not say"),
        column("normal_impulse", impulse, "of a step"), column("shear_impulse", impulse, "of a step"),
        column("mobilisation", none, "|F_s|/(μ F_n)")}},
      {"impacts.vtp",
       "an impact, where the surfaces met",
       "",
       {column("time", time, "of its begin"),
        column("gamma", angle, "from the incline's normal, > 0 on the downhill side of the bead"),
        column("phi", angle, "azimuth about the normal; 0 in the plane"),
        column("v_n", speed, "normal velocity, < 0 on approach"),
        column("v_t", speed, "translation along the surface"),
        column("flight", time, "since the grain last lost touch"),
        column("gamma_before", angle, "of the same grain's impact before"),
        column("rolling", none, "1: the same two parted less than 4 contact times ago"),
        column("bead", none, "id of the grain that was hit"),
        column("grain", none, "id of the grain that hit")}},
  };
}

std::vector<TableText> all_tables() {
  auto all = run_tables();
  auto more = experiment_tables();
  all.insert(std::ranges::find(all, "figure", &TableText::file), std::make_move_iterator(more.begin()),
             std::make_move_iterator(more.end()));
  return all;
}

bool stands_for(const std::string& pattern, std::string_view name) {
  if (!pattern.ends_with('*')) return pattern == name;
  return name.starts_with(std::string_view(pattern).substr(0, pattern.size() - 1));
}

std::string units_of(const ColumnText& c) {
  return c.si.empty() ? "" : c.si == c.reduced ? c.si : c.si + "; " + c.reduced;
}

}  // namespace

const std::vector<TableText>& table_texts() {
  static const auto tables = all_tables();
  return tables;
}

std::optional<ColumnText> column_text(const TableText& table, std::string_view name) {
  constexpr std::string_view suffix = "_err";
  const bool error = !table.error.empty() && name.ends_with(suffix);
  const auto of = error ? name.substr(0, name.size() - suffix.size()) : name;
  for (const auto& column : table.columns)
    if (stands_for(column.name, of)) {
      auto found = column;
      found.name = std::string(name);
      if (error) found.meaning = fmt::format("of {}: {}", of, table.error);
      return found;
    }
  return {};
}

const TableText* find_table_text(std::string_view file, const std::vector<std::string>& columns) {
  const auto known = [&](const TableText& table) {
    return std::ranges::count_if(columns, [&](const auto& c) { return column_text(table, c).has_value(); });
  };
  const TableText* best = nullptr;  // of those of this name, such as series.csv of runs and of experiments
  for (const auto& table : table_texts())
    if ((table.file == file || table.file.starts_with(std::string(file) + " of ")) &&
        (!best || known(table) > known(*best)))
      best = &table;
  if (best) return best;
  for (const auto& table : table_texts())
    if (known(table) == static_cast<std::ptrdiff_t>(columns.size())) return &table;
  return nullptr;
}

std::string with_column_comments(std::string_view file, const std::string& csv, bool is_si) {
  const auto& tables = table_texts();
  const auto table = std::ranges::find(tables, file, &TableText::file);
  if (table == tables.end()) return csv;
  std::size_t header = 0;
  while (header < csv.size() && csv[header] == '#')
    header = std::min(csv.find('\n', header), csv.size() - 1) + 1;
  const auto names = "," + csv.substr(header, csv.find('\n', header) - header) + ",";
  // Whether a column is there, or for `v_*` any; the pattern's errors are told once, below.
  const auto is_there = [&](const ColumnText& column) {
    const bool any = column.name.ends_with('*');
    return names.find("," + column.name.substr(0, column.name.size() - any) + (any ? "" : ",")) != names.npos;
  };
  std::string lines;
  for (const auto& column : table->columns) {
    if (!is_there(column)) continue;
    const auto& unit = is_si ? column.si : column.reduced;
    lines += fmt::format("# {}{}{}: {}\n", column_comment, column.name, unit.empty() ? "" : " (" + unit + ")",
                         column.meaning);
  }
  if (names.find("_err,") != names.npos && !table->error.empty())
    lines += fmt::format("# {}*_err: {}\n", column_comment, table->error);
  return csv.substr(0, header) + lines + csv.substr(header);
}

std::vector<std::string> column_lines(std::string_view file, const std::vector<std::string>& columns) {
  const auto& tables = table_texts();
  const auto table = std::ranges::find(tables, file, &TableText::file);
  std::vector<std::string> lines;
  if (table == tables.end()) return lines;
  for (const auto& name : columns)
    if (const auto text = column_text(*table, name)) {
      const auto unit = units_of(*text);
      lines.push_back(fmt::format("{}{} of {}{}: {}", column_comment, name, file,
                                  unit.empty() ? "" : " (" + unit + ")", text->meaning));
    }
  return lines;
}

std::string column_tables() {
  std::string text;
  for (const auto& table : table_texts()) {
    text += fmt::format(
        "\n**`{}`**: a row is {}.{}\n\n| column | meaning | unit (SI; reduced) |\n|---|---|---|\n",
        table.file, table.rows, table.error.empty() ? "" : " `…_err`: " + table.error + ".");
    for (const auto& c : table.columns) {
      auto meaning = c.meaning;
      for (std::size_t at = 0; (at = meaning.find('|', at)) != meaning.npos; at += 2)
        meaning.insert(at, "\\");
      text += fmt::format("| `{}` | {} | {} |\n", c.name, meaning, units_of(c));
    }
  }
  return text;
}

}  // namespace chute
