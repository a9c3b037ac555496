#pragma once
#include <vector>

#include "core/contact.hpp"
#include "core/impact.hpp"
#include "core/random.hpp"
#include "engines/dsmc/dsmc_setup.hpp"
#include "engines/hard/flight.hpp"

namespace chute::dsmc {

/// The bed's beads and the walls, which grains in flight hit exactly: where the parabola touches them first.
template <int D>
class Obstacles {
 public:
  Obstacles(const Grains<D>& grains, const DsmcSetup<D>& setup);

  bool none() const { return setup_.walls.empty() && beads_.empty(); }
  /// Flies grain i until `end`, from hit to hit. Its flight begins now. False if it was stopped before `end`, because it hit
  /// something too often: it stays where it is until the next step.
  bool fly(std::size_t i, hard::Flight<D>& flight, double end, Random& random, Tally& tally,
           std::vector<Impact>* impacts) const;
  /// Can a grain of that radius be there at the start?
  bool free(const Vec<D>& place, double radius) const;
  /// Could a grain of that radius, anywhere in a box about `middle`, touch something?
  bool near(const Vec<D>& middle, double half_diagonal, double radius) const;

 private:
  struct Bead {
    Vec<D> place;
    double radius;
    std::size_t id;
  };
  struct Hit {
    double time;
    const Bead* bead = nullptr;
    std::size_t wall = 0;
  };
  const DsmcSetup<D>& setup_;
  const Grains<D>& grains_;
  std::vector<Bead> beads_;
  double top_ = 0, widest_ = 0;  // of the beads: highest centre, largest radius
  Vec<D> low_{};
  double bin_ = 1;
  std::array<int, D - 1> bins_{};
  std::vector<std::vector<std::uint32_t>> in_bin_;  // by their place along (and across) the bed

  template <class Visit>
  void near_beads(const Vec<D>& place, double reach, const Visit& visit) const;
  Hit first_hit(const hard::Flight<D>& flight, double end) const;
  void bounce(std::size_t i, hard::Flight<D>& flight, const Hit& hit, Random& random, Tally& tally,
              std::vector<Impact>* impacts) const;
};

}  // namespace chute::dsmc
