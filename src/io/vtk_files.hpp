#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/engine.hpp"

/// chute's VTK files (binary appended, compressed; ParaView opens them). Each function gives the bytes of a
/// file, so that one place writes files and knows about full disks. Array names stand in common/fields.hpp.
namespace chute::io {

/// What every file says about its run.
struct RunFacts {
  std::string units;               ///< "SI" or "reduced"
  std::array<double, 6> domain{};  ///< x0 x1 y0 y1 z0 z1; equal ends where it is not periodic
  std::array<double, 3> gravity{};
};

/// All grains as vertices. 2D grains lie at z = 0 and spin about z.
std::string grains_vtp(const GrainsView& grains, const RunFacts& facts);

/// One vertex per impact, where the surfaces met.
std::string impacts_vtp(std::span<const Impact> impacts, const RunFacts& facts);

/// The contact network: a line between the centres of each touching pair (nearest images), with the arrays
/// `normal_force`, `shear_force`, `overlap`.
std::string contacts_vtp(const GrainsView& grains, std::span<const ContactRecord> contacts,
                         const RunFacts& facts);

/// Time index of files, as ParaView reads it.
std::string pvd(std::span<const double> times, std::span<const std::string> files);

}  // namespace chute::io
