#include "common/experiment_columns.hpp"

#include "common/column_units.hpp"

namespace chute {
using namespace column_units;

std::vector<TableText> experiment_tables() {
  // The cylinder's units are m = g = r = 1 (thesis 3.2).
  constexpr Unit weight{"mg", "mg"}, gravity{"g", "g"}, turning{"g/r", "g/r"},
      fall_time{"sqrt(r/g)", "sqrt(r/g)"}, fall_speed{"sqrt(gr)", "sqrt(gr)"}, roll{"sqrt(g/r)", "sqrt(g/r)"};
  return {
      {"result.csv",
       "a result of an experiment, whose meaning a comment tells",
       "half of the range over which it was averaged; empty where nothing was: the motion is computed, without chance",
       {column("name", none, "of the result"), column("unit", none, "of its value; empty for pure numbers"),
        column("value", none, "in that unit; signs as the comment says")}},
      {"series.csv of impacts",
       "a time in the contact of two grains",
       "",
       {column("time", time, "since the surfaces met"), column("overlap", length, "of the two; > 0 in touch"),
        column("F_n", force, "normal force; > 0 pushes apart"),
        column("F_s", force, "shear force on j along s = (n_y, -n_x), with n from i to j"),
        column("v_n", speed, "relative velocity of j along n; < 0 on approach"),
        column("v_s", speed, "relative velocity of the surfaces along s, with the spins"),
        column("omega_*", spin, "spin of i and of j, anticlockwise")}},
      {"series.csv of column",
       "a time since the column met the wall",
       "",
       {column("time", time, "since the surfaces met"), column("contacts", none, "pairs that touch now"),
        column("momentum", none,
               "mean velocity of the grains over that before; 1 at first, < 0 when they fly off"),
        column("energy", none, "mean energy of motion over that before")}},
      {"series.csv of brake-failure",
       "a time since the ball met the wall",
       "",
       {column("time", time, "since the surfaces met"),
        column("x", length, "of the ball's centre, along the wall"), column("y", length, "away from it"),
        column("v_x", speed, "of the ball along the wall"),
        column("v_y", speed, "away from it: < 0 on approach"),
        column("omega", spin, "of the ball, anticlockwise"),
        column("overlap", length, "largest with a grain of the wall"),
        column("contacts", none, "grains of the wall that it touches now")}},
      {"series.csv of pushed-cylinder",
       "a time since the block pushes",
       "",
       {column("time", fall_time, "since the first push began"),
        column("F_s^p", weight, "friction at the plane, > 0 against the push (3.26)"),
        column("F_s^b", weight, "friction at the block, > 0 while it presses the cylinder down (3.27)"),
        column("dv/dt", gravity, "acceleration along the plane, > 0 with the push"),
        column("domega/dt", turning, "of the spin, > 0 as the cylinder rolls forward"),
        column("v", fall_speed, "velocity along the plane, > 0 with the push"),
        column("omega", roll, "spin, > 0 as the cylinder rolls forward")}},
  };
}

}  // namespace chute
