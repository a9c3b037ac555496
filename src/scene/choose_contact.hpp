#pragma once
#include <functional>
#include <string>
#include <vector>

#include "common/toml_reader.hpp"
#include "scene/scene.hpp"

namespace chute::scene {

/// Fills in what a scene leaves open of its contacts: `contact.normal = { restitution = 0.6 }` alone is enough. Tells what it
/// chose and why.
///
/// k_n such that an impact at v overlaps by a hundredth of a diameter: k_n = m_eff (v / 0.01 d)², with v the fastest grain of the
/// start, 3 √(g d) as flows on inclines have, or √(g H) of a layer of height H, whichever is most; rounded up to 1, 2 or 5 times a power
/// of ten. γ_s such that γ_s dt 7/(2 m_eff) = 0.08, below which the energy account was measured to close (soft_method.cpp); rounded down.
/// μ = 0.5. `make` gives the scene of a table.
std::vector<std::string> choose_contact(toml::table& table,
                                        const std::function<Scene(const toml::table&)>& make);

}  // namespace chute::scene
