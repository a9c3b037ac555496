#include "engines/lammps/contact_model.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/root.hpp"

namespace chute::lammps {
namespace {

ContactModel refused(const char* key, std::string what) { return {"", Refusal{key, std::move(what)}}; }

/// The normal part: its text, and γ_n where that is a constant of the pair (0 else).
struct NormalPart {
  std::string text;
  double damping = 0;
  std::optional<Refusal> wrong{};
};

NormalPart normal_of(const laws::Normal& normal, laws::Pair p) {
  const double root_R = std::sqrt(p.r_eff);
  if (const auto* law = std::get_if<laws::SpringDashpot>(&normal))
    return {fmt::format("hooke {} {} damping velocity", law->stiffness(p), law->damping(p)), law->damping(p)};
  if (const auto* law = std::get_if<laws::Hertz>(&normal))
    return {fmt::format("hertz {} 0 damping velocity", law->stiffness(p) / root_R)};
  if (const auto* law = std::get_if<laws::HertzLinearDamping>(&normal))
    return {fmt::format("hertz {} {} damping velocity", law->stiffness(p) / root_R, law->damping(p)),
            law->damping(p)};
  if (const auto* law = std::get_if<laws::HertzKuwabaraKono>(&normal))
    return {fmt::format("hertz {} {} damping viscoelastic", law->stiffness(p) / root_R,
                        law->damping(p) / (root_R * p.m_eff))};
  return {"", 0,
          Refusal{"contact.normal.law",
                  "\"walton-braun\": LAMMPS has no such law; it has spring-dashpot, hertz, "
                  "hertz-linear-damping and hertz-kuwabara-kono"}};
}

constexpr const char* shear_laws =
    "LAMMPS has no such law; it has frictionless, coulomb-viscous, cundall-strack and mindlin";

ContactModel uncapped() {
  return refused("contact.tangential.cap", "false: LAMMPS cuts its springs off at the friction force (3.25)");
}

/// The tangential part for one pair, behind a normal part.
ContactModel shear_of(const laws::Shear& shear, const NormalPart& normal, laws::Pair p) {
  const double root_R = std::sqrt(p.r_eff);
  if (std::holds_alternative<laws::Frictionless>(shear)) return {"tangential linear_nohistory 0 0", {}};
  if (const auto* law = std::get_if<laws::RegularisedCoulomb>(&shear)) {
    if (!(normal.damping > 0))
      return refused(
          "contact.tangential.law",
          "\"coulomb-viscous\": LAMMPS's damping across a contact is a multiple of the one along it, which must be "
          "a constant > 0 (spring-dashpot or hertz-linear-damping with e_n < 1)");
    return {fmt::format("tangential linear_nohistory {} {}", law->effective_viscosity(p) / normal.damping,
                        law->friction),
            {}};
  }
  if (const auto* law = std::get_if<laws::CundallStrack>(&shear)) {
    if (!law->spring.cap) return uncapped();
    return {fmt::format("tangential linear_history {} 0 {}", law->stiffness(p), law->spring.friction), {}};
  }
  if (const auto* law = std::get_if<laws::MindlinSpring>(&shear)) {
    if (!law->spring.cap) return uncapped();
    return {fmt::format("tangential {} {} 0 {}", law->shrink ? "mindlin_rescale/force" : "mindlin",
                        law->stiffness(p) / root_R, law->spring.friction),
            {}};
  }
  const auto name = laws::ListOf<laws::Shear>::names[shear.index()];
  return refused("contact.tangential.law", fmt::format("\"{}\": {}", name, shear_laws));
}

std::string joined(const std::string& normal, const std::string& shear, bool attraction) {
  return fmt::format("{} {}{}", normal, shear, attraction ? "" : " limit_damping");
}

/// The e for which LAMMPS's `damping tsuji` has this ratio γ_n/√(m k_n): its α(e), a polynomial that falls from 1.2728 at
/// 0 to 0 at 1.
double tsuji_restitution(double ratio) {
  const auto alpha = [](double e) {
    return 1.2728 - 4.2783 * e + 11.087 * std::pow(e, 2) - 22.348 * std::pow(e, 3) + 27.467 * std::pow(e, 4) -
           18.022 * std::pow(e, 5) + 4.8218 * std::pow(e, 6);
  };
  return root_between([&](double e) { return alpha(e) - ratio; }, 0, 1);
}

constexpr const char* many_sizes =
    "does not scale with the grains' masses and radii as LAMMPS's coefficients do, and there are too many sizes to give each "
    "its own; ";

/// The coefficients of an older style for one pair: along and across, springs and dampings over m_eff.
struct Classic {
  const char* style;
  double k_n, k_t, gamma_n, gamma_t, friction;
  bool agrees_with(const Classic& o) const {
    const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-14 * std::abs(a); };
    return same(k_n, o.k_n) && same(k_t, o.k_t) && same(gamma_n, o.gamma_n) && same(gamma_t, o.gamma_t);
  }
};

std::optional<Classic> classic_of(const laws::ContactLaws& laws, laws::Pair p) {
  const bool smooth = std::holds_alternative<laws::Frictionless>(laws.shear);
  if (const auto* spring = std::get_if<laws::SpringDashpot>(&laws.normal)) {
    Classic model{"hooke", spring->stiffness(p), spring->stiffness(p), spring->damping(p) / p.m_eff, 0, 0};
    if (smooth) return model;
    if (const auto* law = std::get_if<laws::RegularisedCoulomb>(&laws.shear)) {
      model.gamma_t = law->effective_viscosity(p) / p.m_eff, model.friction = law->friction;
      return model;
    }
    if (const auto* law = std::get_if<laws::CundallStrack>(&laws.shear); law && law->spring.cap) {
      model.style = "hooke/history", model.k_t = law->stiffness(p), model.friction = law->spring.friction;
      return model;
    }
    return {};
  }
  const double root_R = std::sqrt(p.r_eff);
  Classic model{"hertz/history", 0, 0, 0, 0, 0};
  if (const auto* hertz = std::get_if<laws::Hertz>(&laws.normal))
    model.k_n = hertz->stiffness(p) / root_R;
  else if (const auto* kono = std::get_if<laws::HertzKuwabaraKono>(&laws.normal))
    model.k_n = kono->stiffness(p) / root_R, model.gamma_n = kono->damping(p) / (root_R * p.m_eff);
  else
    return {};
  model.k_t = model.k_n;
  if (smooth) return model;
  const auto* law = std::get_if<laws::MindlinSpring>(&laws.shear);
  if (!law || law->shrink || !law->spring.cap) return {};
  model.k_t = law->stiffness(p) / root_R, model.friction = law->spring.friction;
  return model;
}

}  // namespace

std::optional<ClassicModel> classic_model(const laws::ContactLaws& laws,
                                          const std::vector<laws::Pair>& pairs) {
  std::optional<Classic> all;
  for (const auto& pair : pairs) {
    const auto model = classic_of(laws, pair);
    if (!model || (all && !all->agrees_with(*model))) return {};
    if (!all) all = model;
  }
  if (!all) return {};
  return ClassicModel{all->style, fmt::format("{} {} {} {} {} {}{}", all->k_n, all->k_t, all->gamma_n,
                                              all->gamma_t, all->friction, all->gamma_t > 0 ? 1 : 0,
                                              laws.attraction ? "" : " limit_damping")};
}

ContactModel model_of(const laws::ContactLaws& laws, laws::Pair pair) {
  const auto normal = normal_of(laws.normal, pair);
  if (normal.wrong) return {"", normal.wrong};
  auto shear = shear_of(laws.shear, normal, pair);
  if (shear.wrong) return shear;
  return {joined(normal.text, shear.text, laws.attraction), {}};
}

ContactModel model_of_all(const laws::ContactLaws& laws) {
  // How a coefficient scales is seen from pairs of unlike masses and radii.
  const laws::Pair one(1, 1), heavy(4, 1), large(1, 4);
  const auto model = model_of(laws, one);
  if (model.wrong) return model;
  const double infinite =
      std::visit([](const auto& law) { return law.stiffness(laws::Pair(1, 1)); }, laws.normal);
  const auto stiffness = [&](laws::Pair p) {
    return std::visit([&](const auto& law) { return law.stiffness(p); }, laws.normal);
  };
  const auto damping = [&](laws::Pair p) {
    return std::visit([&](const auto& law) { return law.damping(p); }, laws.normal);
  };
  const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-12 * std::abs(b); };
  const bool hertz = !std::holds_alternative<laws::SpringDashpot>(laws.normal);
  if (!same(stiffness(heavy), infinite) || !same(stiffness(large), hertz ? 2 * infinite : infinite))
    return refused(
        "contact.normal",
        fmt::format("its stiffness {}give one material (young, poisson), or equal grains", many_sizes));
  std::string normal;
  double constant = 0, per_mass = 0;
  if (std::holds_alternative<laws::HertzKuwabaraKono>(laws.normal)) {
    return refused("contact.normal.law",
                   fmt::format("\"hertz-kuwabara-kono\" {}give equal grains", many_sizes));
  } else if (damping(one) == 0) {
    normal = fmt::format("{} {} 0 damping velocity", hertz ? "hertz" : "hooke", infinite);
  } else if (same(damping(heavy), damping(one))) {
    constant = damping(one);
    normal = fmt::format("{} {} {} damping velocity", hertz ? "hertz" : "hooke", infinite, constant);
  } else if (same(damping(heavy), 4 * damping(one))) {
    per_mass = damping(one);
    normal = fmt::format("{} {} {} damping mass_velocity", hertz ? "hertz" : "hooke", infinite, per_mass);
  } else {
    const double ratio = damping(one) / std::sqrt(infinite);
    constexpr double least = 1e-3, most = 1.27;  // of what `damping tsuji` can have
    if (hertz || !(ratio > least && ratio < most))
      return refused("contact.normal.restitution", fmt::format("{}give equal grains", many_sizes));
    normal = fmt::format("hooke {} {} damping tsuji", infinite, tsuji_restitution(ratio));
  }
  std::string shear = "tangential linear_nohistory 0 0";
  if (const auto* law = std::get_if<laws::RegularisedCoulomb>(&laws.shear)) {
    const double gamma = law->effective_viscosity(one), heavier = law->effective_viscosity(heavy);
    const bool as_normal =
        (constant > 0 && same(gamma, heavier)) || (per_mass > 0 && same(4 * gamma, heavier));
    if (!as_normal)
      return refused(
          "contact.tangential.law",
          fmt::format(
              "\"coulomb-viscous\": LAMMPS's damping across a contact is a multiple of the one along it; "
              "this one {}give damping and viscosity the same mass_scaling, cundall-strack, or equal grains",
              many_sizes));
    shear = fmt::format("tangential linear_nohistory {} {}", gamma / damping(one), law->friction);
  } else if (const auto* spring = std::get_if<laws::CundallStrack>(&laws.shear)) {
    if (!same(spring->stiffness(heavy), spring->stiffness(one)) ||
        !same(spring->stiffness(large), spring->stiffness(one)))
      return refused("contact.tangential", fmt::format("its stiffness {}give equal grains", many_sizes));
    shear = shear_of(laws.shear, {}, one).text;
  } else if (const auto* mindlin = std::get_if<laws::MindlinSpring>(&laws.shear)) {
    if (!same(mindlin->stiffness(heavy), mindlin->stiffness(one)) ||
        !same(mindlin->stiffness(large), 2 * mindlin->stiffness(one)))
      return refused("contact.tangential", fmt::format("its stiffness {}give equal grains", many_sizes));
    shear = shear_of(laws.shear, {}, one).text;
  }
  return {joined(normal, shear, laws.attraction), {}};
}

}  // namespace chute::lammps
