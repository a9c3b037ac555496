#pragma once
#include <array>
#include <string_view>

/// Names of the arrays in chute's files, what they are and their unit as a power product of length L, time T,
/// mass M. Writers and readers take the names from here, so that they cannot drift apart.
namespace chute::fields {

struct Field {
  std::string_view name;     ///< array name in VTK files
  std::string_view label;    ///< what a colour bar or an axis says, in the plot's TeX subset
  std::string_view si_unit;  ///< unit in SI scenes; empty for pure numbers
  std::string_view reduced;  ///< unit in reduced scenes (m = g = d = 1)
  bool is_signed;            ///< wants a diverging colour map
};

// Grains: one point each in frames/NNNNNN.vtp
inline constexpr Field id{"id", "grain", "", "", false};
inline constexpr Field type{"type", "type", "", "", false};  ///< 0 fixed, 1 moving
inline constexpr Field radius{"radius", "R", "m", "d", false};
inline constexpr Field mass{"mass", "m", "kg", "m", false};
inline constexpr Field velocity{"velocity", "v", "m/s", "\\sqrt{gd}", false};
inline constexpr Field angular_velocity{"angular_velocity", "\\omega", "rad/s", "\\sqrt{g/d}", true};
inline constexpr Field angle{"angle", "\\phi", "rad", "rad",
                             false};  ///< turned since the start; draws the spin mark
inline constexpr Field orientation{"orientation", "q", "", "", false};  ///< 3D, instead: quaternion w x y z
inline constexpr Field force{"force", "F", "N", "mg", false};
inline constexpr Field material{"material", "material", "", "", false};  ///< species
inline constexpr Field body{"body", "body", "", "", false};  ///< of spheres that make up a grain: which

// Impacts: one point each in impacts.vtp, where the surfaces met
inline constexpr Field time{"time", "t", "s", "\\sqrt{d/g}", false};
inline constexpr Field gamma{"gamma", "\\gamma", "rad", "rad",
                             true};  ///< from the incline's normal, > 0 downhill side
inline constexpr Field phi{"phi", "\\varphi", "rad", "rad", true};    ///< azimuth about the normal; 0 in 2D
inline constexpr Field v_n{"v_n", "v_n", "m/s", "\\sqrt{gd}", true};  ///< < 0 on approach (1.13)
inline constexpr Field v_t{"v_t", "v_t", "m/s", "\\sqrt{gd}", true};  ///< translation along the surface, v·s
inline constexpr Field flight{"flight", "\\tau", "s", "\\sqrt{d/g}", false};  ///< time of flight before it
inline constexpr Field gamma_before{"gamma_before", "\\gamma'", "rad", "rad",
                                    true};                            ///< of the same grain's impact before
inline constexpr Field rolling{"rolling", "rolling", "", "", false};  ///< 1: rolling contact made up again
inline constexpr Field bead{"bead", "bead", "", "", false};           ///< id of the grain that was hit
inline constexpr Field grain{"grain", "grain", "", "", false};        ///< id of the grain that hit

inline constexpr std::array grain_fields{id,    type,        radius, mass,     velocity, angular_velocity,
                                         angle, orientation, force,  material, body};

// Contacts: one line each in contacts/NNNNNN.vtp, between the centres of a and b
inline constexpr Field contact_a{"a", "a", "", "", false};  ///< id of a moving grain
inline constexpr Field contact_b{"b", "b", "", "", false};  ///< id of the other; wall k is −1 − k
inline constexpr Field point{"point", "r", "m", "d", true};
inline constexpr Field normal{"normal", "n", "", "", true};    ///< from a to b
inline constexpr Field branch{"branch", "l", "m", "d", true};  ///< from a's centre to b's
inline constexpr Field overlap{"overlap", "\\xi", "m", "d", false};
inline constexpr Field normal_force{"normal_force", "F_n", "N", "mg", false};
inline constexpr Field shear_force{"shear_force", "F_s", "N", "mg", true};
inline constexpr Field state{"state", "state", "", "", false};  ///< 0 unknown, 1 sticks, 2 slides
// Of methods whose contacts are impulses in a step
inline constexpr Field normal_impulse{"normal_impulse", "J_n", "N s", "m\\sqrt{gd}", false};
inline constexpr Field shear_impulse{"shear_impulse", "J_s", "N s", "m\\sqrt{gd}", true};
inline constexpr Field mobilisation{"mobilisation", "|F_s|/\\mu F_n", "", "", false};
inline constexpr std::array contact_fields{contact_a,      contact_b,     point,        normal,      branch,
                                           overlap,        force,         normal_force, shear_force, state,
                                           normal_impulse, shear_impulse, mobilisation};

inline constexpr std::array impact_fields{time,   gamma,        phi,     v_n,  v_t,
                                          flight, gamma_before, rolling, bead, grain};

// Walls: one polygon (2D: line) each in walls.vtp
inline constexpr Field wall{"wall", "wall", "", "", false};  ///< its number

// Field data of every VTK file
inline constexpr std::string_view time_value = "TimeValue";  ///< ParaView's own name
inline constexpr std::string_view units = "units";           ///< "SI" or "reduced"
/// What a series may be told against: a time, or what a method without one counts.
inline constexpr std::array<std::string_view, 4> clocks{"time", "shakes", "sweeps", "updates"};
inline constexpr std::string_view clock = "clock";  ///< what a file's time counts; only where that is no time
inline constexpr std::string_view domain = "domain";    ///< x0 x1 y0 y1 z0 z1; equal ends: not periodic there
inline constexpr std::string_view gravity = "gravity";  ///< gx gy gz in the incline's frame

}  // namespace chute::fields
