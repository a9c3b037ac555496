#include "run/facts.hpp"

#include <cmath>
#include <numbers>

#include "run/engine_factory.hpp"

namespace chute::run {

std::vector<Fact> facts(const scene::Scene& scene) {
  const bool si = scene.units == scene::Units::si;
  const auto unit = [&](const char* in_si, const char* reduced) { return std::string(si ? in_si : reduced); };
  const double d = scene.mean_diameter(), d_bed = scene.bed.diameter, m = scene.mean_mass();
  const auto law = std::get<laws::SpringDashpot>(scene.contact.laws().normal);
  const double dt = time_step(scene), m_eff = scene.reference_mass(), t_n = law.contact_time(m_eff);
  const bool many = scene.grains.count > 1;
  const double chord = many ? d : (d + d_bed) / 2;  // R_i + R_j
  const double steps = std::ceil(scene.duration / dt);

  std::vector<Fact> list;
  const auto add = [&](const char* name, double value, std::string in, const char* meaning) {
    list.push_back({name, value, std::move(in), meaning});
  };
  add("theta", scene.incline.theta() * 180 / std::numbers::pi, "deg", "inclination");
  add("m", m, unit("kg", "m"), "mass of a mean grain");
  add("t_n", t_n, unit("s", "sqrt(d/g)"),
      many ? "contact time of two mean grains (3.3)" : "contact time of the grain with the bed (3.3)");
  if (many && scene.bed.kind != scene::Bed::Kind::none)
    add("t_n bed", law.contact_time(m), unit("s", "sqrt(d/g)"), "contact time of a mean grain with the bed");
  add("dt", dt, unit("s", "sqrt(d/g)"), "time step");
  add("t_n/dt", t_n / dt, "", "steps per contact; 50 is usual, under 20 is rough");
  add("gamma_n", law.damping(m_eff), unit("kg/s", "m sqrt(g/d)"), "normal damping of that pair");
  add("e_n", law.restitution(m_eff), "", "restitution of that pair (3.2)");
  if (many && scene.bed.kind != scene::Bed::Kind::none)
    add("e_n bed", law.restitution(m), "", "restitution of a mean grain with the bed");
  if (scene.contact.tangential.law != scene::ShearSpec::Law::frictionless) {
    const auto& shear = scene.contact.tangential;
    const laws::RegularisedCoulomb coulomb{shear.viscosity, shear.friction, shear.mass_scaling};
    // Slip decays at γ_s (1/m_eff + R²/I for each grain): 7/2 for solid spheres. The integration wants this ≪ 1.
    add("gamma_s dt 7/2m", coulomb.effective_viscosity(m_eff) * 3.5 / m_eff * dt, "",
        "decay of slip in one step; above about 1 the integration is unstable");
  }
  if (scene.bed.kind != scene::Bed::Kind::none) {
    const double gap = scene.bed.kind == scene::Bed::Kind::row ? scene.bed.gap : scene.bed.gap_max;
    add("Phi", d / d_bed, "", "size ratio R/r");
    add("gamma_max", std::asin(std::min(1.0, (1 + gap) / (1 + d / d_bed))), "rad",
        "largest impact angle on the bed (4.21)");
  }
  add("v_bf", 2 * chord / std::numbers::pi * std::cos(std::asin(0.999)) * std::sqrt(law.stiffness(m_eff) / m_eff),
      unit("m/s", "sqrt(gd)"), "brake failure above this velocity at sin(vartheta) = 0.999 (2.16, corrected)");
  add("steps", steps, "", "time steps of the run");
  // measured on one core of a 2020s server, 300 grains; a single grain is bound by the cost of a step
  const double seconds = steps * (0.25e-6 + static_cast<double>(scene.grains.count) / 120e6);
  add("cost", seconds, "s", "rough time on one core");
  return list;
}

}  // namespace chute::run
