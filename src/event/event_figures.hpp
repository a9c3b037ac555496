#pragma once
#include <functional>
#include <map>
#include <string>

#include "common/figure_table.hpp"

/// The figures that the event-driven engine makes, and its share of those that it is compared in. SI units.
namespace chute::event {

using figures::FigureContext;
using figures::FigureTable;

FigureTable compute_fig_4_21(
    const FigureContext& context);  ///< region C: v_x and v_z at each collision against time
FigureTable compute_event_4_22(const FigureContext& context);  ///< region C: v_x(t) of hard grains

/// All of them, by id: `fig-4-21`; `event-4-22` is a part of a figure.
const std::map<std::string, std::function<FigureTable(const FigureContext&)>>& event_figures();

}  // namespace chute::event
