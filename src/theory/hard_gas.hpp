#pragma once
#include <array>

/// Hard discs and spheres in equilibrium: the compressibility Z = βP/n as a function of the packing fraction φ.
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

}  // namespace chute::theory
