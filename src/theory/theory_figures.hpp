#pragma once
#include <functional>
#include <map>
#include <string>

#include "common/figure_table.hpp"

/// The figures that theory alone makes, and theory's share of those that it is compared in. SI units.
namespace chute::theory {

using figures::FigureContext;
using figures::FigureTable;

FigureTable compute_fig_4_04(const FigureContext& context);  ///< the stochastic model, <v_x>(sin θ)
FigureTable compute_fig_4_19(const FigureContext& context);  ///< v̄_x, exact and linear
FigureTable compute_fig_1_04(const FigureContext& context);  ///< sketch: the geometry of an impact
FigureTable compute_fig_3_09(const FigureContext& context);  ///< sketch: the pushed cylinder
FigureTable compute_fig_4_01(const FigureContext& context);  ///< sketch: a ball on an incline
FigureTable compute_fig_4_03(
    const FigureContext& context);  ///< sketch: the line of beads, and the impact angle
FigureTable compute_fig_4_31(const FigureContext& context);     ///< what the impact angles γ and φ are
FigureTable compute_theory_4_17(const FigureContext& context);  ///< v̄_x(sin θ), ε = 0
FigureTable compute_theory_4_18(const FigureContext& context);  ///< v̄_x(sin θ), mean gap 0.1
FigureTable compute_theory_4_20(const FigureContext& context);  ///< θ_AB(Φ)
FigureTable compute_theory_m_02(const FigureContext& context);  ///< cooling of hard discs
FigureTable compute_theory_m_03(
    const FigureContext& context);  ///< block and ball on an incline, two frictions
FigureTable compute_theory_m_05(const FigureContext& context);  ///< distribution of contact forces
FigureTable compute_theory_4_32(const FigureContext& context);  ///< times of flight of the stochastic model
FigureTable compute_theory_m_09(const FigureContext& context);  ///< heights in a Tonks gas under gravity
FigureTable compute_theory_m_08(const FigureContext& context);  ///< Z(φ) of hard discs and spheres

/// All of them, by id: `fig-4-04`, `fig-4-19`, `fig-4-31`; those named `theory-…` are parts of figures.
const std::map<std::string, std::function<FigureTable(const FigureContext&)>>& theory_figures();

}  // namespace chute::theory
