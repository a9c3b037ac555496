#include <algorithm>

#include "beds/flat.hpp"
#include "beds/lattice.hpp"
#include "beds/planes.hpp"
#include "beds/rough.hpp"
#include "beds/row.hpp"

namespace chute::beds {

Catalogue<Bed>& list() {
  static Catalogue<Bed> all{
      kind_of<Bed, Row>(),          kind_of<Bed, DisorderedRow>(), kind_of<Bed, Rough>(),
      kind_of<Bed, NoBed>(),        kind_of<Bed, Flat>(),          kind_of<Bed, Lattice>(),
      kind_of<Bed, RelaxedPlane>(), kind_of<Bed, RandomPlane>(),   kind_of<Bed, SpreadPlane>(),
      kind_of<Bed, LatticePlane>(), kind_of<Bed, PlaneFromFile>()};
  return all;
}

double widest(const Ground& ground) {
  double diameter = 0;
  for (const auto& bead : ground.beads) diameter = std::max(diameter, 2 * bead.radius);
  return diameter;
}

}  // namespace chute::beds
