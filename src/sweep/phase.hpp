#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "measure/steadiness.hpp"

namespace chute::sweep {

/// Many starts of one point taken together.
struct Tally {
  std::array<std::size_t, 5> of{};  ///< starts by verdict
  std::size_t starts = 0;
  Estimate v_x, omega, kinetic;  ///< over the steady starts
  /// Median of v_x over the starts that still move; NaN if none does. Its error is that of a gaussian sample
  /// with the same median deviation: 1.2533 · 1.4826 · MAD / √n.
  Estimate median{};

  /// Starts within a tenth of the median that neither stopped nor left for good: they share one mean
  /// velocity.
  std::size_t together = 0;

  std::size_t count(measure::Verdict verdict) const { return of[static_cast<std::size_t>(verdict)]; }
};

/// Errors are standard errors over the starts; of a single start, its own.
Tally tally(std::span<const measure::Flow> starts);

/// Phases of thesis 4.1, decided like this from several starts at each of several launch velocities:
/// A: at least half of all starts have stopped.
/// B: not A; at least half of those of the slowest launch are steady or unsettled; and the median velocity of
///    every faster launch is that of the slowest, to within a relative difference `alike`. That the final
///    velocity does not depend on the start is how thesis 4.2.2 tells B from C.
/// C: everything else.
enum class Phase { A, B, C };
Phase phase_of(std::span<const Tally> launches, double alike);

/// Where the phase changes along one parameter; the error is half of the bracket that is left.
struct Boundaries {
  std::optional<Estimate> AB, BC;  ///< empty: not within the range
};

/// Looks at the given values of the parameter in turn (they ascend), and bisects the first steps from A to
/// not A and from not C to C until they are within `tolerance`. It looks no farther than what is `wanted`
/// needs.
enum class Wanted { AB, both };
Boundaries find_boundaries(std::span<const double> values, double tolerance, Wanted wanted,
                           const std::function<Phase(double)>& phase_at);

}  // namespace chute::sweep
