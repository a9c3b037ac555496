#pragma once
#include <functional>
#include <map>
#include <string>

#include "common/figure_table.hpp"

/// The figures that are computed with the event-driven engine directly. SI units.
namespace chute::event {

using figures::FigureContext;
using figures::FigureTable;

FigureTable compute_fig_4_21(
    const FigureContext& context);  ///< region C: v_x and v_z at each collision against time

/// All of them, by id.
const std::map<std::string, std::function<FigureTable(const FigureContext&)>>& event_figures();

}  // namespace chute::event
