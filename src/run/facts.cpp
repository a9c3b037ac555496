#include "run/facts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "run/engine_factory.hpp"
#include "scene/contact.hpp"

namespace chute::run {

namespace {

using Add = std::function<void(std::string name, double value, std::string unit, std::string meaning)>;

/// What the normal law comes to: stiffness, damping, and an impact of the reference pair.
void normal_facts(const scene::Scene& scene, const laws::Contact& contact, bool si, const Add& add) {
  const bool many = scene.interacting(), bed = many && scene.bed.kind != scene::Bed::Kind::none;
  const laws::Pair pair = scene.reference_pair();
  const double R = scene.mean_diameter() / 2, r = scene.bed.diameter / 2;
  const laws::Pair on_bed(scene.mean_mass(), R * r / (R + r));
  const double v = scene::impact_velocity(scene.contact);
  const auto impact = laws::normal_impact(contact, v, pair);
  const bool hertz = has_hertz_spring(scene.contact.normal);
  const bool kono = scene.contact.normal.law == scene::NormalSpec::Law::hertz_kuwabara_kono;
  const std::string time = si ? "s" : "sqrt(d/g)", speed = si ? "m/s" : "sqrt(gd)";
  const std::string at =
      scene.contact.normal.at_velocity ? fmt::format(" at {:.4g} {}", v, speed) : std::string();

  add("t_n", impact.contact_time, time,
      (many ? "contact time of two mean grains" : "contact time of the grain with the bed") + at);
  if (bed)
    add("t_n bed", laws::normal_impact(contact, v, on_bed).contact_time, time,
        "contact time of a mean grain with the bed" + at);
  std::visit(
      [&](const auto& normal) {
        add("k_n", normal.stiffness(pair), si ? (hertz ? "N/m^1.5" : "N/m") : (hertz ? "mg/d^1.5" : "mg/d"),
            "normal stiffness of that pair");
        if (normal.damping(pair) > 0)
          add("gamma_n", normal.damping(pair),
              si ? (kono ? "kg/(m^0.5 s)" : "kg/s") : (kono ? "m sqrt(g)/d" : "m sqrt(g/d)"),
              "normal damping of that pair");
      },
      contact.normal);
  add("e_n", impact.restitution, "", "restitution of that pair" + at);
  if (bed)
    add("e_n bed", laws::normal_impact(contact, v, on_bed).restitution, "",
        "restitution of a mean grain with the bed" + at);
  if (scene.contact.normal.at_velocity)
    for (const double part : {0.1, 0.01})
      add(fmt::format("e_n {:.3g}", part * v), laws::normal_impact(contact, part * v, pair).restitution, "",
          fmt::format("restitution of that pair at {:.4g} {}", part * v, speed));
}

/// What the tangential law comes to, for that impact and that time step.
void shear_facts(const laws::Contact& contact, laws::Pair pair, const laws::NormalImpact& impact, double dt,
                 bool linear, bool si, const Add& add) {
  // Slip decays at γ_s (1/m_eff + R²/I for each grain): 7/2 for solid spheres. The integration wants this
  // ≪ 1.
  const auto decay = [&](double viscosity) {
    add("gamma_s dt 7/2m", viscosity * 3.5 / pair.m_eff * dt, "",
        "decay of slip in one step; above about 1 the integration is unstable");
  };
  // (3.15) with m_eff and solid spheres
  const auto half_period = [&](double stiffness, const char* meaning) {
    const double t_s = std::numbers::pi / std::sqrt(3.5 * stiffness / pair.m_eff);
    add("k_s", stiffness, si ? "N/m" : "mg/d", meaning);
    add("t_s/t_n", t_s / impact.contact_time, "", "tangential half period (3.15) over the contact time");
  };
  std::visit(
      [&]<class Law>(const Law& law) {
        if constexpr (requires { law.effective_viscosity(pair); })
          decay(law.effective_viscosity(pair));
        else if constexpr (requires { law.stiffness_at(impact.deepest, pair); })
          half_period(law.stiffness_at(impact.deepest, pair),
                      linear ? "tangential stiffness of that pair"
                             : "tangential stiffness at the deepest overlap of that impact");
      },
      contact.shear);
  if (const auto* saw = std::get_if<laws::SawTooth>(&contact.shear))
    add("zeta_0/dt", saw->length / dt, si ? "m/s" : "sqrt(gd)",
        "slip that crosses a tooth in one step; slips have to be much slower");
}

}  // namespace

std::vector<Fact> facts(const scene::Scene& scene) {
  const bool si = scene.units == scene::Units::si;
  const auto unit = [&](const char* in_si, const char* reduced) { return std::string(si ? in_si : reduced); };
  const double d = scene.mean_diameter(), d_bed = scene.bed.diameter, m = scene.mean_mass();
  const laws::Pair pair = scene.reference_pair();
  const auto contact = scene.contact.laws(pair);
  const double dt = time_step(scene);
  const auto impact = laws::normal_impact(contact, scene::impact_velocity(scene.contact), pair);
  const double chord = scene.interacting() ? d : (d + d_bed) / 2;  // R_i + R_j
  const double steps = std::ceil(scene.duration / dt);

  std::vector<Fact> list;
  const Add add = [&](std::string name, double value, std::string in, std::string meaning) {
    list.push_back({std::move(name), value, std::move(in), std::move(meaning)});
  };
  add("theta", scene.incline.theta() * 180 / std::numbers::pi, "deg", "inclination");
  add("m", m, unit("kg", "m"), "mass of a mean grain");
  normal_facts(scene, contact, si, add);
  add("dt", dt, unit("s", "sqrt(d/g)"), "time step");
  add("t_n/dt", impact.contact_time / dt, "", "steps per contact; 50 is usual, under 20 is rough");
  shear_facts(contact, pair, impact, dt, scene.contact.tangential.law != scene::ShearSpec::Law::mindlin, si,
              add);
  if (scene.bed.kind != scene::Bed::Kind::none) {
    const double gap = scene.bed.kind == scene::Bed::Kind::row ? scene.bed.gap : scene.bed.gap_max;
    add("Phi", d / d_bed, "", "size ratio R/r");
    add("gamma_max", std::asin(std::min(1.0, (1 + gap) / (1 + d / d_bed))), "rad",
        "largest impact angle on the bed (4.21)");
  }
  const bool hertz = has_hertz_spring(scene.contact.normal);
  const double stiffness = std::visit([&](const auto& law) { return law.stiffness(pair); }, contact.normal);
  const double half_period =
      hertz ? impact.contact_time : std::numbers::pi * std::sqrt(pair.m_eff / stiffness);
  add("v_bf", 2 * chord * std::cos(std::asin(0.999)) / half_period, unit("m/s", "sqrt(gd)"),
      "brake failure above this velocity at sin(vartheta) = 0.999 (2.16, corrected)");
  add("steps", steps, "", "time steps of the run");
  // measured on one core of a 2020s server, 300 grains; a single grain is bound by the cost of a step
  const double seconds = steps * (0.25e-6 + static_cast<double>(scene.grains.count) / 120e6);
  add("cost", seconds, "s", "rough time on one core");
  return list;
}

}  // namespace chute::run
