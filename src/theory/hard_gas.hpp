#pragma once
#include <array>
#include <cmath>
#include <numbers>

/// Hard discs and spheres: in equilibrium the compressibility Z = βP/n as a function of the packing fraction φ.
namespace chute::theory {

/// Discs, from their virial coefficients B_n/B_2^{n−1} up to the tenth (Clisby & McCoy 2006) in x = B_2 n = 2φ; what comes
/// after is a geometric series. Good to 0.3 % for φ ≤ 0.5.
inline double virial_discs(double phi) {
  constexpr std::array coefficients{1.0,      0.782004, 0.532232, 0.333556, 0.198843,
                                    0.114873, 0.064993, 0.036219, 0.019954};
  constexpr double ratio = 0.55;  // of a term's coefficient to the one before, about what the last ones have
  const double x = 2 * phi;
  double z = 1, power = x;
  for (const double c : coefficients) z += c * power, power *= x;
  return z + coefficients.back() * ratio * power / (1 - ratio * x);
}
/// Discs, Henderson 1975.
inline double henderson(double phi) { return (1 + phi * phi / 8) / ((1 - phi) * (1 - phi)); }
/// Spheres, Carnahan & Starling 1969.
inline double carnahan_starling(double phi) {
  return (1 + phi + phi * phi - phi * phi * phi) / ((1 - phi) * (1 - phi) * (1 - phi));
}

/// Haff's time τ of smooth discs, d = m = 1: T = T_0/(1 + t/τ)², 1/τ = (1 − e²) ω_0/4 with the collision rate of a grain
/// ω_0 = 2 n d g_d √(πT_0/m) and the pair distribution at contact g_d = (1 − 7φ/16)/(1 − φ)² (Verlet & Levesque 1982).
inline double haff_time_of_discs(double phi, double e, double T_0) {
  const double n = 4 * phi / std::numbers::pi, g = (1 - 7 * phi / 16) / ((1 - phi) * (1 - phi));
  return 4 / ((1 - e * e) * 2 * n * g * std::sqrt(std::numbers::pi * T_0));
}

/// The fourth cumulant a_2 that a cooling gas of smooth grains settles at (van Noije & Ernst 1998), of spheres (D = 3) or
/// discs (D = 2); e is α there, and good above 0.6.
inline double sonine_a2(double e, int D) {
  const double square = e * e;
  return 16 * (1 - e) * (1 - 2 * square) / (9 + 24 * D + (8 * D - 41) * e + 30 * (1 - e) * square);
}

}  // namespace chute::theory
