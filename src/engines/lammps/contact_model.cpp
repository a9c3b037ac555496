#include "engines/lammps/contact_model.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>

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

/// Pairs by which it is seen how coefficients scale: one, one four times as heavy, one four times as large.
const std::array<laws::Pair, 3> alike{laws::Pair(1, 1), laws::Pair(4, 1), laws::Pair(1, 4)};

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
    "does not scale with the grains' masses and radii as LAMMPS's coefficients do, and there are too many sizes to give "
    "each its own; ";

/// A coefficient of pairs of unlike masses and radii, from which is seen how it scales with them.
struct Scaling {
  double one, heavy, large;

  template <class Coefficient>
  explicit Scaling(const Coefficient& of) : one(of(alike[0])), heavy(of(alike[1])), large(of(alike[2])) {}
  bool grows(double with_mass, double with_radius) const {
    return same(heavy, with_mass * one) && same(large, with_radius * one);
  }
  bool is_constant() const { return grows(1, 1); }
  bool is_per_mass() const { return grows(4, 1); }
  bool is_per_root_mass() const { return grows(2, 1); }
  bool is_per_root_radius() const { return grows(1, 2); }

 private:
  static bool same(double a, double b) { return std::abs(a - b) <= 1e-12 * std::abs(b); }
};

/// The normal part for all pairs; its damping is told where it is a constant, or a multiple of m_eff.
struct NormalForAll {
  std::string text;
  double constant = 0, per_mass = 0;
  std::optional<Refusal> wrong{};
};

NormalForAll normal_for_all(const laws::Normal& normal) {
  const auto of = [&](auto&& coefficient) {
    return Scaling([&](laws::Pair p) {
      return std::visit([&](const auto& law) { return coefficient(law, p); }, normal);
    });
  };
  const auto stiffness = of([](const auto&law, laws::Pair p) { return law.stiffness(p); }),
             damping = of([](const auto&law, laws::Pair p) { return law.damping(p); });
  const auto refuse = [](const char* key, const std::string& what, const char* remedy) {
    return NormalForAll{"", 0, 0, Refusal{key, what + many_sizes + remedy}};
  };
  const bool hertz = !std::holds_alternative<laws::SpringDashpot>(normal);
  if (!(hertz ? stiffness.is_per_root_radius() : stiffness.is_constant()))
    return refuse("contact.normal", "its stiffness ", "give one material (young, poisson), or equal grains");
  if (std::holds_alternative<laws::HertzKuwabaraKono>(normal))
    return refuse("contact.normal.law", "\"hertz-kuwabara-kono\" ", "give equal grains");
  const auto spring = fmt::format("{} {}", hertz ? "hertz" : "hooke", stiffness.one);
  if (damping.one == 0) return {spring + " 0 damping velocity"};
  if (damping.is_constant()) return {fmt::format("{} {} damping velocity", spring, damping.one), damping.one};
  if (damping.is_per_mass())
    return {fmt::format("{} {} damping mass_velocity", spring, damping.one), 0, damping.one};
  constexpr double least = 1e-3, most = 1.27;  // of what `damping tsuji` can have
  const double ratio = damping.one / std::sqrt(stiffness.one);
  if (hertz || !damping.is_per_root_mass() || !(ratio > least && ratio < most))
    return refuse("contact.normal.restitution", "", "give equal grains");
  return {fmt::format("{} {} damping tsuji", spring, tsuji_restitution(ratio))};
}

ContactModel shear_for_all(const laws::Shear& shear, const NormalForAll& normal) {
  const auto refuse = [](const char* key, const std::string& what, const char* remedy) {
    return refused(key, what + many_sizes + remedy);
  };
  if (const auto* law = std::get_if<laws::RegularisedCoulomb>(&shear)) {
    const Scaling gamma([&](laws::Pair p) { return law->effective_viscosity(p); });
    const double along = gamma.is_constant() ? normal.constant : gamma.is_per_mass() ? normal.per_mass : 0;
    if (along == 0)
      return refuse(
          "contact.tangential.law",
          "\"coulomb-viscous\": LAMMPS's damping across a contact is a multiple of the one along it; this one ",
          "give damping and viscosity the same mass_scaling, cundall-strack, or equal grains");
    return {fmt::format("tangential linear_nohistory {} {}", gamma.one / along, law->friction), {}};
  }
  bool scales = true;
  if (const auto* spring = std::get_if<laws::CundallStrack>(&shear))
    scales = Scaling([&](laws::Pair p) { return spring->stiffness(p); }).is_constant();
  if (const auto* spring = std::get_if<laws::MindlinSpring>(&shear))
    scales = Scaling([&](laws::Pair p) { return spring->stiffness(p); }).is_per_root_radius();
  if (!scales) return refuse("contact.tangential", "its stiffness ", "give equal grains");
  return shear_of(shear, {}, alike[0]);
}

/// The coefficients of an older style for one pair: along and across, springs and dampings over m_eff.
struct Classic {
  std::string_view style;
  double k_n, k_t, gamma_n, gamma_t, friction;
  bool attraction = true;
  bool agrees_with(const Classic& o) const {
    const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-14 * std::abs(a); };
    return style == o.style && attraction == o.attraction && friction == o.friction && same(k_n, o.k_n) &&
           same(k_t, o.k_t) && same(gamma_n, o.gamma_n) && same(gamma_t, o.gamma_t);
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

std::optional<ClassicModel> classic_model(const std::vector<MeetingKinds>& meetings) {
  std::optional<Classic> all;
  for (const auto& two : meetings) {
    auto model = classic_of(*two.laws, two.pair);
    if (!model) return {};
    model->attraction = two.laws->attraction;
    if (all && !all->agrees_with(*model)) return {};
    if (!all) all = model;
  }
  if (!all) return {};
  return ClassicModel{
      std::string(all->style),
      fmt::format("{} {} {} {} {} {}{}", all->k_n, all->k_t, all->gamma_n, all->gamma_t, all->friction,
                  all->gamma_t > 0 ? 1 : 0, all->attraction ? "" : " limit_damping")};
}

ContactModel model_of(const laws::ContactLaws& laws, laws::Pair pair) {
  const auto normal = normal_of(laws.normal, pair);
  if (normal.wrong) return {"", normal.wrong};
  auto shear = shear_of(laws.shear, normal, pair);
  if (shear.wrong) return shear;
  return {joined(normal.text, shear.text, laws.attraction), {}};
}

ContactModel model_of_all(const laws::ContactLaws& laws) {
  if (auto model = model_of(laws, alike[0]); model.wrong) return model;
  const auto normal = normal_for_all(laws.normal);
  if (normal.wrong) return {"", normal.wrong};
  auto shear = shear_for_all(laws.shear, normal);
  if (shear.wrong) return shear;
  return {joined(normal.text, shear.text, laws.attraction), {}};
}

std::optional<ClassicModel> classic_model_of_all(const std::vector<const laws::ContactLaws*>& all) {
  std::vector<MeetingKinds> meetings;
  for (const auto* laws : all)
    for (const auto& pair : alike) meetings.push_back({pair, laws});
  return classic_model(meetings);
}

}  // namespace chute::lammps
