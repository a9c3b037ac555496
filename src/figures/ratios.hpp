#pragma once
#include <optional>
#include <string>
#include <vector>

#include "common/figure_table.hpp"
#include "common/toml_reader.hpp"

namespace chute {
class KeyLister;
}
namespace chute::figures {

/// Series divided by others, so that what lies on one curve, or near a theory, can be told apart. [[data.ratio]]
struct Ratio {
  std::string panel;                ///< where the quotients are drawn, under the names of the series
  std::string of;                   ///< the panel of the series
  std::vector<std::string> series;  ///< which
  std::optional<std::string> over;  ///< the panel of what they are divided by; default that of the series
  std::optional<std::string> by;  ///< the series that they are divided by; default the one of their own name
};
void describe(TomlReader& a, Ratio& ratio);
void describe(KeyLister& a, Ratio& ratio);

/// Adds the quotients to the table, with errors of both. Between points of the divisor it is taken as straight; where it
/// does not reach, or is 0, there is no quotient, and a comment counts those points.
void draw_ratio(const Ratio& ratio, FigureTable& table);

}  // namespace chute::figures
