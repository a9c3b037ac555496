#pragma once
#include <array>
#include <optional>
#include <string_view>

#include "common/range.hpp"
#include "laws/mass_scaling.hpp"
#include "laws/pair.hpp"

/// What a scene says of a law. A law whose numbers stand in the scene as they are describes them itself; one
/// whose numbers follow from others, such as a damping from a restitution, has a type `Keys` that describes
/// those and makes the law. `describe` is called by the archives of common/toml_reader.hpp.
namespace chute::laws {

/// What contact times and restitutions are given for: a pair, and whether damping may attract at the end.
struct Reference {
  Pair pair;
  bool attraction = true;
};

/// Names of units, in SI and with m = g = d = 1.
struct UnitName {
  std::string_view si, reduced;
};
inline constexpr UnitName linear_stiffness_unit{"N/m", "mg/d"}, hertz_stiffness_unit{"N/m^1.5", "mg/d^1.5"};

inline constexpr std::array<std::string_view, 3> mass_scaling_words{"none", "damping", "both"};
inline constexpr Range restitution_range{0, 1, true, false};

template <class... Given>
int count_given(const std::optional<Given>&... given) {
  return (0 + ... + given.has_value());
}

/// e_n of a pair, or γ_n with a mass convention.
struct DampingKeys {
  std::optional<double> restitution, damping;
  MassScaling mass_scaling = MassScaling::none;

  template <class Archive>
  void describe(Archive& a) {
    a.value("restitution", restitution, restitution_range, "e_n, of every pair");
    a.value("damping", damping, non_negative, "γ_n, instead of a restitution");
  }
  /// After all other keys: the mass convention of a given damping.
  template <class Archive>
  void describe_scaling(Archive& a) {
    if (damping)
      a.choice("mass_scaling", mass_scaling, mass_scaling_words, "where the reduced mass enters (3.1.1)");
  }
  template <class Archive>
  void check(Archive& a, const std::optional<double>& contact_time) const {
    a.check(count_given(restitution, damping) == 1, damping ? "damping" : "restitution",
            "give either restitution or damping");
    check_time(a, contact_time);
  }
  template <class Archive>
  void check_time(Archive& a, const std::optional<double>& contact_time) const {
    a.check(!contact_time || restitution, "contact_time",
            "goes with restitution; with damping give the stiffness");
  }
};

/// Tangential stiffness k_s, or k_s/k_n.
struct SpringKeys {
  std::optional<double> stiffness, stiffness_ratio;

  template <class Archive>
  void describe(Archive& a) {
    a.value("stiffness", stiffness, positive, "k_s");
    a.value("stiffness_ratio", stiffness_ratio, positive, "k_s/k_n");
    a.check(count_given(stiffness, stiffness_ratio) == 1, stiffness ? "stiffness_ratio" : "stiffness",
            "give either stiffness, k_s, or stiffness_ratio, k_s/k_n");
  }
  PairCoefficient resolve(const PairCoefficient& normal_stiffness) const {
    return stiffness ? PairCoefficient{*stiffness, 0, 0, 0} : normal_stiffness.scaled(*stiffness_ratio);
  }
};

}  // namespace chute::laws
