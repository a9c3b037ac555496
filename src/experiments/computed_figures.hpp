#pragma once
#include <functional>
#include <map>
#include <string>

#include "common/figure_table.hpp"

/// The figures that need no scene: binary impacts and other small set-ups. By id; thesis chapters 1 to 3.
namespace chute::experiments {

using figures::FigureContext;
using figures::FigureTable;

FigureTable compute_fig_1_06(const FigureContext& context);   ///< Walton's model, ψ_f(ψ_i)
FigureTable compute_fig_2_02(const FigureContext& context);   ///< brake failure
FigureTable compute_fig_2_15(const FigureContext& context);   ///< detachment: e_tot of a column
FigureTable compute_fig_3_01(const FigureContext& context);   ///< e_n(v) of three normal laws
FigureTable compute_fig_3_02(const FigureContext& context);   ///< F_n(t)
FigureTable compute_fig_3_03(const FigureContext& context);   ///< e_n(v) of the hysteretic law
FigureTable compute_fig_3_04(const FigureContext& context);   ///< ψ_f(ψ_i) of six tangential laws
FigureTable compute_fig_3_05(const FigureContext& context);   ///< e(sin ϑ) of the same
FigureTable compute_fig_3_06(const FigureContext& context);   ///< ψ_f(ψ_i), (3.6) with (3.13)
FigureTable compute_fig_3_07(const FigureContext& context);   ///< ψ_f(ψ_i), (3.6) with (3.22)
FigureTable compute_fig_3_08(const FigureContext& context);   ///< e(sin ϑ), (3.6) with (3.13)
FigureTable compute_fig_3_10(const FigureContext& context);   ///< the pushed cylinder's forces
FigureTable compute_table_3_1(const FigureContext& context);  ///< its steady state

/// All of them, by id: `fig-3-01`, `table-3-1`.
const std::map<std::string, std::function<FigureTable(const FigureContext&)>>& computed_figures();

}  // namespace chute::experiments
