#pragma once
#include <limits>

#include "core/wall.hpp"
#include "engines/hard/flight.hpp"

namespace chute::hard {

/// The first time from flight.time up to `limit` at which the grain touches the wall and does not part from it; infinity
/// if there is none. As between grains, one that overlaps by rounding meets the wall at once if it approaches, and not
/// while it parts.
///
/// A plane that does not oscillate is a quadratic. For all else the time is stepped towards from below, by steps within
/// which no contact can be: the height above convex walls falls at most like a parabola with the sum of both
/// accelerations (the distance to a convex body is a convex function of the place), and the square of the way from a
/// cylinder's axis grows at most with the fastest that the grain can be. Near the contact these steps are Newton's, so
/// they converge as fast.
template <int D>
double first_contact_with_wall(const Flight<D>& flight, const Wall<D>& wall, const Domain<D>& domain,
                               double limit = std::numeric_limits<double>::infinity());

}  // namespace chute::hard
