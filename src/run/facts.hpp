#pragma once
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace chute::run {

/// What follows from a scene, for `chute check`.
struct Fact {
  std::string name;
  double value;
  std::string unit, meaning;
};
std::vector<Fact> facts(const scene::Scene& scene);

/// A pair of grains whose impacts are of interest.
struct NamedPair {
  std::string suffix;  ///< of the facts' names: "", " bed"
  std::string name;    ///< "two mean grains"
  laws::Pair pair;
  double reach;  ///< R_i + R_j
};

/// What the laws of a scene come to for the first of some pairs at the given time step: t_n, k_n, γ_n, e_n at
/// several speeds where it depends on them, k_s, t_s/t_n, v_bf; and t_n and e_n of the other pairs.
std::vector<Fact> contact_facts(const scene::ContactSpec& contact, scene::Units units,
                                const std::vector<NamedPair>& pairs, double time_step);

}  // namespace chute::run
