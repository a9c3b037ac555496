#include <cmath>

#include "scene/contact_spec.hpp"

/// From the words and numbers of a scene to the laws.
namespace chute::scene {
namespace {

laws::Hertz hertz(const NormalSpec& n, double stiffness) {
  return n.young ? laws::Hertz::from_material(*n.young, *n.poisson)
                 : laws::Hertz::from_stiffness(stiffness, n.mass_scaling);
}

/// Hertz's spring with the asked damping: as given, or such that the reference pair has the asked
/// restitution.
template <class Law, class Make>
Law damped_hertz(const NormalSpec& n, double stiffness, bool attraction, laws::Pair reference,
                 const Make& make) {
  const laws::Hertz elastic = hertz(n, stiffness);
  if (!n.restitution) return make(elastic, *n.damping);
  const double v = *n.at_velocity;
  const auto restitution = [&](double damping) {
    return laws::normal_impact({make(elastic, damping), {}, attraction}, v, reference).restitution;
  };
  const double guess = 0.1 * reference.m_eff / elastic.contact_time(v, reference);
  return make(elastic, laws::damping_for(restitution, *n.restitution, guess));
}

/// The same where the contact time is given: at equal restitution t_n ∝ k_n^{-2/5}, with any of these
/// dampings.
template <class Law, class Make>
Law damped_hertz(const NormalSpec& n, bool attraction, laws::Pair reference, const Make& make) {
  if (!n.contact_time) return damped_hertz<Law>(n, n.stiffness.value_or(0), attraction, reference, make);
  const double v = *n.at_velocity, scale = reference.m_eff / (std::pow(*n.contact_time, 2.5) * std::sqrt(v));
  const Law trial = damped_hertz<Law>(n, scale, attraction, reference, make);
  const double t_n = laws::normal_impact({trial, {}, attraction}, v, reference).contact_time;
  return damped_hertz<Law>(n, scale * std::pow(t_n / *n.contact_time, 2.5), attraction, reference, make);
}

laws::Normal normal_law(const ContactSpec& contact, laws::Pair reference) {
  const NormalSpec& n = contact.normal;
  switch (n.law) {
    case NormalSpec::Law::spring_dashpot: {
      if (n.damping) return laws::SpringDashpot::from_damping(*n.stiffness, *n.damping, n.mass_scaling);
      if (n.stiffness)
        return laws::SpringDashpot::from_restitution(*n.stiffness, *n.restitution, contact.attraction);
      const auto trial = laws::SpringDashpot::from_restitution(1, *n.restitution, contact.attraction);
      const double t_n = laws::normal_impact({trial, {}, contact.attraction}, 1, reference).contact_time;
      const double stiffness = std::pow(t_n / *n.contact_time, 2);  // t_n ∝ k_n^{-1/2} at equal restitution
      return laws::SpringDashpot::from_restitution(stiffness, *n.restitution, contact.attraction);
    }
    case NormalSpec::Law::hertz: {
      if (!n.contact_time) return hertz(n, n.stiffness.value_or(0));
      const double t_n = laws::Hertz::from_stiffness(1).contact_time(*n.at_velocity, reference);
      return laws::Hertz::from_stiffness(std::pow(t_n / *n.contact_time, 2.5));
    }
    case NormalSpec::Law::hertz_linear_damping:
      return damped_hertz<laws::HertzLinearDamping>(
          n, contact.attraction, reference, [&](const laws::Hertz& elastic, double damping) {
            return laws::HertzLinearDamping(elastic, damping, n.mass_scaling);
          });
    case NormalSpec::Law::hertz_kuwabara_kono: {
      if (n.relaxation)
        return laws::HertzKuwabaraKono::from_relaxation(hertz(n, n.stiffness.value_or(0)), *n.relaxation);
      return damped_hertz<laws::HertzKuwabaraKono>(
          n, contact.attraction, reference, [&](const laws::Hertz& elastic, double damping) {
            // of one material, so a restitution fixes the relaxation time; a given γ_n is that of every pair
            return n.damping ? laws::HertzKuwabaraKono::from_damping(elastic, damping, n.mass_scaling)
                             : laws::HertzKuwabaraKono::from_relaxation(
                                   elastic, damping / (1.5 * elastic.stiffness(reference)));
          });
    }
    case NormalSpec::Law::walton_braun:
      return n.restitution ? laws::WaltonBraun::from_restitution(*n.stiffness, *n.restitution)
             : n.hardening ? laws::WaltonBraun::from_hardening(*n.stiffness, *n.hardening)
                           : laws::WaltonBraun::from_stiffnesses(*n.stiffness, *n.unloading_stiffness);
  }
  return {};
}

/// k_s as given, or as a multiple of the normal stiffness.
laws::PairCoefficient shear_stiffness(const ShearSpec& shear, const laws::Normal& normal) {
  laws::PairCoefficient k;
  if (shear.stiffness)
    k.constant = *shear.stiffness;
  else
    k = std::visit([](const auto& law) { return law.stiffness_coefficient(); }, normal)
            .scaled(*shear.stiffness_ratio);
  return k;
}

laws::Shear shear_law(const ContactSpec& contact, const laws::Normal& normal) {
  const ShearSpec& s = contact.tangential;
  using Law = ShearSpec::Law;
  if (s.law == Law::viscous) return laws::Viscous{s.viscosity, s.mass_scaling};
  if (s.friction == 0) return laws::Frictionless{};
  switch (s.law) {
    case Law::coulomb_viscous:
      return laws::RegularisedCoulomb{s.viscosity, s.friction, s.mass_scaling};
    case Law::coulomb:
      return laws::Coulomb{s.friction};
    case Law::cundall_strack:
      return laws::CundallStrack{shear_stiffness(s, normal), {s.friction, s.cap}};
    case Law::mindlin:
      return laws::MindlinSpring{shear_stiffness(s, normal), {s.friction, s.cap}};
    case Law::walton_braun_mindlin:
      return laws::WaltonBraunMindlin{shear_stiffness(s, normal), s.friction};
    case Law::saw_tooth:
      return laws::SawTooth{s.friction, s.tooth};
    case Law::frictionless:
    case Law::viscous:
      break;
  }
  return laws::Frictionless{};
}

}  // namespace

laws::Contact ContactSpec::laws(laws::Pair reference) const {
  const auto made = normal_law(*this, reference);
  return {made, shear_law(*this, made), attraction};
}

}  // namespace chute::scene
