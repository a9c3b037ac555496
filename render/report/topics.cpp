#include "report/topics.hpp"

#include <fmt/format.h>

namespace chute::report {
namespace {

const Quantity energy{"", "energy", "J", "mgd"};
const Quantity height{"h", "$h$", "m", "d"};
const Quantity stress{"", "stress", "N/m", "mg/d", "Pa", "mg/d^2"};

Frame one(Quantity quantity, bool log_y = false) { return {{quantity}, quantity, log_y}; }

}  // namespace

std::string Quantity::title(const std::string& units, int dimensions) const {
  const auto& flat = units == "SI" ? si_unit : reduced_unit;
  const auto& solid = units == "SI" ? si_in_space : reduced_in_space;
  const auto& unit = dimensions == 3 && !solid.empty() ? solid : flat;
  if (unit.empty()) return label;
  return fmt::format("{} (${}$)", label, units == "SI" ? fmt::format("\\mathrm{{{}}}", unit) : unit);
}

const std::vector<Topic>& topics() {
  // clang-format off
  static const std::vector<Topic> all{
      {"motion", "Motion in time", "series.csv",
       "Means over the moving grains: velocity down the incline, and spin, positive when rolling downhill.",
       "output.series = { every = … }",
       {"time", "$t$", "s", "\\sqrt{d/g}"},
       {one({"v_x", "$\\bar{v}_x$", "m/s", "\\sqrt{gd}"}),
        one({"omega", "$\\bar{\\omega}$", "rad/s", "\\sqrt{g/d}"})}},
      {"energy", "Energy in time", "series.csv",
       "What the grains have, and what came in and was lost since the start.",
       "output.series = { every = … }",
       {"time", "$t$", "s", "\\sqrt{d/g}"},
       {{{{"translation", "translation", "J", "mgd"}, {"rotation", "rotation", "J", "mgd"}, {"elastic", "elastic", "J", "mgd"}}, energy},
        {{{"gravity_work", "work of gravity", "J", "mgd"}, {"wall_work", "work of walls", "J", "mgd"},
          {"normal_loss", "normal loss", "J", "mgd"}, {"shear_loss", "tangential loss", "J", "mgd"}}, energy}}},
      {"profiles", "Profiles over the height", "profiles.csv",
       "Time averages over layers at height h above the centres of the bed, with standard errors.",
       "output.profiles = { from = … }",
       height,
       {one({"eta", "packing fraction $\\eta$", "", ""}),
        one({"v_x", "$v_x$", "m/s", "\\sqrt{gd}"}),
        one({"temperature", "temperature $T$", "m^2/s^2", "gd"}),
        one({"omega", "spin $\\omega$", "rad/s", "\\sqrt{g/d}"})}, plot::Kind::both},
      {"stress", "Stresses over the height", "profiles.csv",
       "Contact and kinetic stress of the layers, with standard errors.",
       "output.profiles = { from = … }",
       height,
       {{{{"contact_yy", "contact $\\sigma_{yy}$", "", ""}, {"contact_xy", "contact $\\sigma_{xy}$", "", ""}}, stress},
        {{{"kinetic_yy", "kinetic $\\sigma_{yy}$", "", ""}, {"kinetic_xy", "kinetic $\\sigma_{xy}$", "", ""}}, stress}}, plot::Kind::both},
      {"fields", "Fields over the height", "fields.csv",
       "Coarse-grained with a smooth kernel, so that they know no bins.",
       "output.fields = { from = … }",
       height,
       {one({"density", "density $\\rho$", "", ""}), one({"v_x", "$v_x$", "m/s", "\\sqrt{gd}"})}},
      {"pairs", "Pair distribution", "pairs.csv",
       "How often pairs of grains are r apart, in units of the distance at which they touch.",
       "output.pairs = { every = … }",
       {"r", "$r$", "", ""}, {one({"g", "$g(r)$", "", ""})}},
      {"diffusion", "How grains spread", "diffusion.csv",
       "Mean square of the way in a time, after the mean drift.",
       "output.diffusion = { every = …, longest = … }",
       {"time", "$t$", "s", "\\sqrt{d/g}"},
       {{{{"square_x", "along", "", ""}, {"square_y", "across", "", ""}}, {"", "mean square", "m^2", "d^2"}, true}}, plot::Kind::both, true},
      {"avalanches", "Avalanches", "avalanches.csv",
       "How often avalanches of each size came.",
       "output.avalanches = { from = … }",
       {"size", "size", "", ""}, {one({"count", "how often", "", ""}, true)}, plot::Kind::dots, true},
  };
  // clang-format on
  return all;
}

}  // namespace chute::report
