#pragma once
#include "common/column_texts.hpp"

/// Units of columns, and how a column is written down, for the files that say what tables mean.
namespace chute::column_units {

/// In SI, and with m = g = d = 1.
struct Unit {
  const char *si, *reduced;
};
inline constexpr Unit none{"", ""}, length{"m", "d"}, time{"s", "sqrt(d/g)"}, speed{"m/s", "sqrt(gd)"},
    spin{"rad/s", "sqrt(g/d)"}, energy{"J", "mgd"}, angle{"rad", "rad"}, degree{"deg", "deg"},
    spread{"m²/s", "sqrt(g d³)"}, square{"m²", "d²"}, temperature{"m²/s²", "gd"}, force{"N", "mg"},
    mass{"kg", "m"},
    // In the plane stresses are forces per length and densities masses per area.
    stress{"Pa (2D: N/m)", "mg/d² (2D: mg/d)"}, power{"W/m³ (2D: W/m²)", "mg sqrt(gd)/d³ (2D: /d²)"},
    density{"kg/m³ (2D: kg/m²)", "m/d³ (2D: m/d²)"}, impulse{"N s", "m sqrt(gd)"},
    momentum{"kg m/s", "m sqrt(gd)"}, rate{"1/m", "1/d"}, per_speed{"s/m", "1/sqrt(gd)"};

inline ColumnText column(const char* name, Unit unit, const char* meaning) {
  return {name, meaning, unit.si, unit.reduced};
}

}  // namespace chute::column_units
