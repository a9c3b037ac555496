#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "app/verbs.hpp"
#include "common/error.hpp"
#include "theory/rolling.hpp"

namespace chute::app {
namespace {

using theory::Line;
using theory::Version;

struct Arguments {
  double size_ratio = 0;
  std::optional<double> gap, gap_max, sine, degrees;
  double radius = Line{}.radius, gravity = Line{}.gravity, inertia = Line{}.inertia;
};

void must_hold(bool good, const char* option, double value, const char* what) {
  if (!good) throw InputError(fmt::format("{} {}: {}", option, value, what));
}

/// The line, with the mean gap: (4.52). InputError names the option that makes it impossible.
Line line_of(const Arguments& a) {
  must_hold(a.size_ratio > 0, "--size-ratio", a.size_ratio, "must be positive");
  must_hold(!a.gap || *a.gap >= 0, "--gap", a.gap.value_or(0), "must not be negative");
  must_hold(a.radius > 0, "--radius", a.radius, "must be positive");
  must_hold(a.gravity > 0, "--gravity", a.gravity, "must be positive");
  must_hold(a.inertia >= 0, "--inertia", a.inertia, "must not be negative");
  Line line;
  line.size_ratio = a.size_ratio;
  line.gap = a.gap.value_or(a.gap_max.value_or(0) / 2);
  line.radius = a.radius, line.gravity = a.gravity, line.inertia = a.inertia;
  must_hold(!a.gap_max || *a.gap_max >= std::max(0.0, line.gap), "--gap-max", a.gap_max.value_or(0),
            "must not be negative, nor below the mean gap");
  if (const double widest = a.gap_max.value_or(line.gap); widest >= line.size_ratio)
    throw InputError(fmt::format("--gap{} {}: the ball falls through, a gap must be below the size ratio {}",
                                 a.gap_max ? "-max" : "", widest, line.size_ratio));
  return line;
}

double angle_of(const Arguments& a) {
  if (a.sine.has_value() == a.degrees.has_value())
    throw InputError("give the inclination once: --sin 0.094 or --angle 5.4 (degrees)");
  const double theta = a.sine ? std::asin(*a.sine) : *a.degrees * std::numbers::pi / 180;
  if (!(theta > 0 && theta < std::numbers::pi / 2))
    throw InputError(
        fmt::format("{}: must incline the line: above 0 and below {}",
                    a.sine ? fmt::format("--sin {}", *a.sine) : fmt::format("--angle {}", *a.degrees),
                    a.sine ? "1" : "90 degrees"));
  return theta;
}

/// A quantity as printed in the thesis and as corrected; NaN: there is none.
struct Quantity {
  const char *name, *unit, *equations;
  double printed, corrected;
};

std::string number(double v) { return std::isfinite(v) ? fmt::format("{:.6g}", v) : "none"; }

void show(const Arguments& a) {
  const Line line = line_of(a);
  const double theta = angle_of(a), widest = a.gap_max.value_or(line.gap);
  const auto both = [](auto&& of) { return std::array{of(Version::printed), of(Version::corrected)}; };
  const auto velocity = both([&](Version v) {
    const auto passage = theory::steady_passage(line, theta, v);
    return passage ? passage->mean_velocity : NAN;
  });
  const auto linear = both([&](Version v) { return theory::linear_velocity(line, theta, v); });
  const auto ratio = both([&](Version v) { return theory::impact_ratio(line, v); });
  const auto ordered = both([&](Version v) { return theory::boundary_ab(line, v); });
  const auto disordered = both([&](Version v) { return theory::boundary_ab(line, widest, v); });
  const auto lift_off = both([&](Version v) { return theory::lift_off_angle(line, v); });

  fmt::print(
      "# a ball that rolls down a line of beads, e_n = 0 and endless friction (thesis 4.2.5): size ratio {}, "
      "{} gap {}{},\n# sin theta {:.6g}, bead radius {} m, gravity {} m/s^2, I/(mR^2) {}\n",
      line.size_ratio, a.gap_max ? "mean" : "every", line.gap,
      a.gap_max ? fmt::format(", largest gap {}", widest) : "", std::sin(theta), line.radius, line.gravity,
      line.inertia);
  fmt::print("gamma_max = {:.6g} rad  # (4.21)\n", theory::largest_angle(line));
  fmt::print("# {:<20} {:<12} {:<12} {:<5} {}\n", "quantity", "printed", "corrected", "unit", "equations");
  for (const auto& q :
       {Quantity{"mean_velocity", "m/s", "(4.47) to (4.51)", velocity[0], velocity[1]},
        Quantity{"linear_velocity", "m/s", "(4.55)", linear[0], linear[1]},
        Quantity{"e_t", "", "(4.44)", ratio[0], ratio[1]},
        Quantity{"theta_AB", "rad", "(4.63), (4.64): all gaps the same", ordered[0], ordered[1]},
        Quantity{"theta_AB_disordered", "rad", "(4.58) to (4.62): mean and largest gap", disordered[0],
                 disordered[1]},
        Quantity{"theta_lift_off", "rad", "above it the ball leaves the beads", lift_off[0], lift_off[1]}})
    fmt::print("{:<22} {:<12} {:<12} {:<5} {}\n", q.name, number(q.printed), number(q.corrected), q.unit,
               q.equations);
  fmt::print(
      "# corrected: (4.38) to (4.44) keep the energy while the spin adjusts in the impact; what is kept is the "
      "angular\n"
      "# momentum about the contact. (4.47) has the arc; the way along the line is 2r(1+eps). Both enter the mean\n"
      "# velocity, the first alone e_t, theta_AB and the lift-off; (4.55), with rg(1+eps) for rg in both columns, is\n"
      "# expanded again from both.\n");
  if (!std::isfinite(velocity[1]))
    fmt::print("# mean_velocity none: the ball stops; it keeps rolling above theta_AB only\n");
  else if (theta > lift_off[1])
    fmt::print("# theta is above theta_lift_off: a real ball would leave the beads\n");
}

}  // namespace

void add_theory(CLI::App& app) {
  auto* verb = app.add_subcommand(
      "theory", "Closed forms for one ball on a line of beads: mean velocity, boundary of stopping");
  auto a = std::make_shared<Arguments>();
  verb->add_option("--size-ratio", a->size_ratio, "R/r of ball and beads")->required();
  verb->add_option("--sin", a->sine, "sine of the inclination");
  verb->add_option("--angle", a->degrees, "or the inclination in degrees");
  verb->add_option("--gap", a->gap,
                   "eps: neighbouring beads are 2 eps r apart; of a disordered line the mean");
  verb->add_option("--gap-max", a->gap_max,
                   "largest gap of a disordered line; --gap then is half of it by default");
  verb->add_option("--radius", a->radius, "r of the beads, m")->capture_default_str();
  verb->add_option("--gravity", a->gravity, "m/s^2")->capture_default_str();
  verb->add_option("--inertia", a->inertia, "I/(mR^2): 0.4 a solid sphere, 0.5 a disc")
      ->capture_default_str();
  verb->footer("Example: chute theory --size-ratio 2.25 --gap-max 0.2 --sin 0.094");
  verb->callback([a] { show(*a); });
}

}  // namespace chute::app
