#pragma once
#include <array>
#include <string_view>

/// Names of the columns in chute's tables, what an axis or a legend says of them, and their units as fields.hpp
/// writes units. A table may have other columns beside: a reader then shows the name itself.
namespace chute::columns {

struct Column {
  std::string_view name;
  std::string_view label;    ///< in the plots' TeX subset
  std::string_view si_unit;  ///< in SI scenes; empty for pure numbers
  std::string_view reduced;  ///< in reduced scenes (m = g = d = 1)
};

// clang-format off
// series.csv: a row per output time
inline constexpr std::array series{
    Column{"time", "$t$", "s", "\\sqrt{d/g}"},
    Column{"x", "mean distance $\\bar{x}$", "m", "d"},
    Column{"v_x", "mean velocity $\\bar{v}_x$", "m/s", "\\sqrt{gd}"},
    Column{"v_y", "mean velocity $\\bar{v}_y$", "m/s", "\\sqrt{gd}"},
    Column{"omega", "mean spin $\\bar{\\omega}$", "rad/s", "\\sqrt{g/d}"},
    Column{"contacts", "number of contacts", "", ""},
    Column{"translation", "energy of translation", "J", "mgd"},
    Column{"rotation", "energy of rotation", "J", "mgd"},
    Column{"elastic", "elastic energy", "J", "mgd"},
    Column{"gravity_work", "work of gravity", "J", "mgd"},
    Column{"normal_loss", "normal dissipation", "J", "mgd"},
    Column{"shear_loss", "tangential dissipation", "J", "mgd"},
    Column{"residual", "residual of the energy account", "J", "mgd"},
};
// clang-format on

}  // namespace chute::columns
