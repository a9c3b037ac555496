#pragma once
#include <functional>
#include <map>
#include <string>

#include "common/figure_table.hpp"

/// Figures that are no quantity of an experiment against another: a collision
/// operator, forces against time, a table. The others are recipes (experiments/recipe.hpp).
namespace chute::experiments {

using figures::FigureContext;
using figures::FigureTable;

FigureTable compute_fig_1_06(const FigureContext& context);   ///< Walton's model, ψ_f(ψ_i)
FigureTable compute_fig_3_02(const FigureContext& context);   ///< F_n(t)
FigureTable compute_fig_3_10(const FigureContext& context);   ///< the pushed cylinder's forces
FigureTable compute_table_3_1(const FigureContext& context);  ///< its steady state

FigureTable compute_fig_b_11(const FigureContext& context);  ///< a free top (free_top.hpp)

/// All of them, by id: `fig-3-01`, `table-3-1`.
const std::map<std::string, std::function<FigureTable(const FigureContext&)>>& computed_figures();

}  // namespace chute::experiments
