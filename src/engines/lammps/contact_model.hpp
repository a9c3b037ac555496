#pragma once
#include <optional>
#include <string>
#include <vector>

#include "common/keys.hpp"
#include "laws/list.hpp"

/// chute's contact laws in the words of LAMMPS's `pair_style granular` (its documentation, 29 Sep 2021), which `fix wall/gran granular`
/// shares. With δ the overlap, R and m the effective radius and mass of a pair, a = √(R δ):
///
///     chute                                    LAMMPS
///     spring-dashpot                           hooke k_n γ_n, damping velocity
///     hertz, hertz-linear-damping              hertz k_n/√R γ_n, damping velocity
///     hertz-kuwabara-kono                      hertz k_n/√R γ_n/(√R m), damping viscoelastic
///     frictionless                             tangential linear_nohistory 0 0
///     coulomb-viscous                          tangential linear_nohistory γ_s/γ_n μ
///     cundall-strack                           tangential linear_history k_s 0 μ
///     mindlin                                  tangential mindlin_rescale/force k_s/√R 0 μ
///     mindlin with shrink = false              tangential mindlin k_s/√R 0 μ
///     attraction = false                       limit_damping
///
/// Where all pairs that can meet have coefficients in the same ratios, the older styles do the same,
///
///     gran/hooke          spring-dashpot with frictionless or coulomb-viscous, γ_n/m and γ_s/m the same for all
///     gran/hooke/history  spring-dashpot with cundall-strack, γ_n/m and k_s the same
///     gran/hertz/history  hertz or hertz-kuwabara-kono with frictionless or mindlin, shrink = false, k/√R and γ_n/(√R m) the same
///
/// and they are taken, for their torques have the lever R, as chute's; that of `granular` is R − δ/2. LAMMPS's damping across a contact in `granular` is a
/// multiple of that along it. Its springs across begin with a whole step of slip, chute's when the surfaces met: they agree as the step
/// shrinks, the laws without a memory step by step.
namespace chute::lammps {

/// A model with its coefficients, for one pair of kinds of grains or for all; or what stands in its way.
struct ContactModel {
  std::string text;
  std::optional<Refusal> wrong;
};

/// One of the older styles: gran/STYLE ARGUMENTS of pairs, STYLE ARGUMENTS of walls.
struct ClassicModel {
  std::string style, arguments;
};
/// Two kinds of grains, and what acts between them.
struct MeetingKinds {
  laws::Pair pair;
  const laws::ContactLaws* laws;
};
/// The older style that gives all of these their laws, if there is one.
std::optional<ClassicModel> classic_model(const std::vector<MeetingKinds>& all);

/// The same for pairs of any masses and radii with each of these laws.
std::optional<ClassicModel> classic_model_of_all(const std::vector<const laws::ContactLaws*>& all);

/// For pairs that all have these masses and radii. Every coefficient is exact.
ContactModel model_of(const laws::ContactLaws& laws, laws::Pair pair);

/// For pairs of any masses and radii, where LAMMPS's coefficients scale with them as chute's do; the restitution of a linear
/// spring by its `damping tsuji`, whose polynomial in e is solved for the damping that is wanted.
ContactModel model_of_all(const laws::ContactLaws& laws);

}  // namespace chute::lammps
