#include "scene/choose_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/world.hpp"

namespace chute::scene {
namespace {

constexpr double overlap = 0.01;     // of a diameter, at the fastest impacts
constexpr double usual_speed = 3;    // of flows on inclines, in sqrt(g d)
constexpr double slip_decay = 0.08;  // gamma_s dt 7/2m
constexpr double usual_friction = 0.5;

/// 1, 2 or 5 times a power of ten, not below x or, where it is to be less, not above.
double round_number(double x, bool up) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  const double part = x / power;
  const double rounded = up ? (part <= 1   ? 1
                               : part <= 2 ? 2
                               : part <= 5 ? 5
                                           : 10)
                            : (part >= 5   ? 5
                               : part >= 2 ? 2
                                           : 1);
  return std::stod(fmt::format("{:.3g}", rounded * power));
}

/// How high the grains lie, about.
double height_of(const engines::Setting& s) {
  const double d = s.mean_diameter;
  double ground = s.size[0] > 0 ? s.size[0] : d;
  if (s.dimensions == 3) ground *= s.size[1] > 0 ? s.size[1] : d;
  const double grains = s.independent ? 1 : static_cast<double>(s.grains);
  return std::max(d, grains * std::pow(d, s.dimensions) / ground);
}

double speed_of(const engines::Setting& s) {
  const double v = std::max(
      {s.fastest, usual_speed * std::sqrt(s.gravity * s.mean_diameter), std::sqrt(s.gravity * height_of(s))});
  return v > 0 ? v : 1;
}

bool is_law(const toml::table& table, std::string_view word) {
  const auto law = table["law"].value<std::string_view>();
  return !law || *law == word;
}

}  // namespace

std::vector<std::string> choose_contact(toml::table& table,
                                        const std::function<Scene(const toml::table&)>& make) {
  auto* contact = table["contact"].as_table();
  auto* normal = contact ? (*contact)["normal"].as_table() : nullptr;
  if (!normal) return {};
  if (!contact->contains("tangential")) contact->insert("tangential", toml::table{});
  auto* tangential = (*contact)["tangential"].as_table();
  if (!tangential) return {};
  const auto lacks = [](const toml::table& in, std::initializer_list<const char*> keys) {
    return std::ranges::none_of(keys, [&](const char* key) { return in.contains(key); });
  };
  const bool stiffness = is_law(*normal, "spring-dashpot") && normal->contains("restitution") &&
                         lacks(*normal, {"stiffness", "contact_time", "damping"});
  const bool coulomb = is_law(*tangential, "coulomb-viscous");
  const bool viscosity = coulomb && lacks(*tangential, {"viscosity"}),
             friction = coulomb && lacks(*tangential, {"friction"}) && (viscosity || tangential->empty());
  if (!stiffness && !viscosity && !friction) return {};
  // A slip is told as one, not as what was left open: with any values these keys are right.
  if (stiffness) normal->insert("stiffness", 1e6);
  if (viscosity) tangential->insert("viscosity", 1.0);
  if (friction) tangential->insert("friction", usual_friction);
  std::vector<std::string> chosen;
  if (stiffness) {
    const auto s = setting_of(make(table));
    const double v = speed_of(s), d = s.resolved_diameter();
    const double k = round_number(s.reference().m_eff * std::pow(v / (overlap * d), 2), true);
    normal->insert_or_assign("stiffness", k);
    chosen.push_back(fmt::format(
        "contact.normal.stiffness = {:g}: grains that meet at {:.3g} {} then overlap by a hundredth of {}", k,
        v, s.in("m/s", "sqrt(gd)"),
        s.bead_spacing > 0 && d < s.mean_diameter ? "a bead's diameter" : "a diameter"));
  }
  if (viscosity) {
    const auto scene = make(table);
    const auto s = setting_of(scene);
    const double dt = scene.engine->step(s);
    // Of rigid grains only friction counts: the key is there so that the scene holds for soft ones, too.
    const bool is_integrated = std::ranges::any_of(
        scene.engine->facts(s), [](const Fact& fact) { return fact.name.starts_with("gamma_s dt"); });
    const double gamma = round_number(slip_decay * s.reference().m_eff / (3.5 * dt), false);
    tangential->insert_or_assign("viscosity", gamma);
    chosen.push_back(fmt::format(
        "contact.tangential.viscosity = {:g}: {}", gamma,
        is_integrated ? fmt::format("the largest whose friction a step of {:.3g} {} integrates well", dt,
                                    s.in("s", "sqrt(d/g)"))
                      : std::string("of no effect, this method's grains slip or stick")));
  }
  if (friction) chosen.push_back(fmt::format("contact.tangential.friction = {:g}", usual_friction));
  return chosen;
}

}  // namespace chute::scene
