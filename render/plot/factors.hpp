#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plot/figure.hpp"

/// What the names of series say about how they belong together.
namespace chute::plot {

/// The series that this one is a part or a fit of: "e_n=0.7 fit", "e_n=0.7 unsettled" and "e_n=0.7 apart" are of "e_n=0.7".
std::string base_name(const std::string& name);

/// Is it a part that the averages do not count: runs that had not settled ("… unsettled"), or starts that do not agree
/// ("… apart")? Such points are drawn hollow.
bool is_doubtful(const std::string& name);

/// Names of quantities in it, in order: "e_n= Phi=". Series of equal keys show one thing at different values.
std::string keys_of(const std::string& name);

/// Series as a table: names such as "e_n=0.7 Phi=3" say a row and a column of it. One factor is told by colour and shape,
/// the other by how markers are filled and lines are dashed, so that a legend needs an entry for each value, not for each
/// series.
struct Factors {
  struct Place {
    int color = 0, style = 0;  ///< indices into the two lists
  };
  std::map<std::string, Place> of;          ///< by name; series that are no part of the table are missing
  std::vector<std::string> colors, styles;  ///< the values as they stand in the names, in order of appearance
  bool has_lines = false;  ///< some of the series have no markers: shape cannot double their colour
};

/// Empty if the names make no table that a legend is shorter with, if one kind of line and marker does not go with each
/// style, or if a series asks for a colour, marker or dash of its own.
std::optional<Factors> factors_of(const std::vector<const Series*>& series);

}  // namespace chute::plot
