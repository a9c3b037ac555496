#pragma once
#include <memory>
#include <optional>

#include "core/clump.hpp"
#include "engines/soft/rigid_motion.hpp"
#include "engines/soft/soft_engine.hpp"

namespace chute::soft {

/// Soft grains that are not round: rigid bodies of overlapping spheres. Search and laws see the spheres, each with the mass of
/// its body, so that m_eff is that of the bodies; what acts on spheres is added up to force and torque on their body, and
/// bodies are what is integrated (RigidMotion). Spheres of the same body do not feel each other. A step:
/// predict bodies → lay spheres → neighbour list → contacts → forces on spheres → on bodies → account → correct bodies.
///
/// Where every body is a single sphere, the numbers are those of SoftEngine, to the last bit.
template <int D>
class ClumpEngine final : public Engine {
 public:
  /// `bodies`: the moving ones at their centres of mass, their orientation that of the principal axes, then the bed.
  ClumpEngine(Grains<D> bodies, Clumps<D> clumps, const SoftSetup<D>& setup);

  std::int64_t step() const override { return step_; }
  double time_step() const override { return setup_.time_step; }
  /// The bodies, with the array `body`, which tells whoever reads them that they are not round. Their `inertia` is that about the axis that they spin about now, so that ½ Iω² is their energy.
  GrainsView grains() const override;
  /// The spheres, with the array `body`. They have the velocity and the spin of their body, and parts of its mass, by their
  /// volumes: sums over them are momenta and energies of translation of the bodies.
  GrainsView drawn() const override;
  EnergyAccount energy() const override;
  /// Of bodies: two of them may touch in several places.
  std::vector<Contact> contacts() const override;
  /// `partners`: how many others a grain touches on average, whether grains, beads or walls, in however many places.
  std::vector<std::pair<std::string, double>> tells() const override;
  void save(std::ostream& out) const override;
  void restore(std::istream& in) override;

  /// The bodies as grains() tells of them.
  const Grains<D>& state() const;
  /// Σ m r × v + Iω of the moving bodies, about the origin; places are counted on through the periods.
  Vec<turns<D>> angular_momentum() const;

 private:
  void advance(std::int64_t step) override;

  SoftSetup<D> setup_;
  Clumps<D> clumps_;
  Grains<D> bodies_;                // `spin` is λ of RigidMotion
  Grains<D> spheres_;               // those of the bodies, one body after the other, then the bed
  std::vector<std::size_t> first_;  // sphere of each body, and the end
  std::vector<int> numbers_;        // 0, 1, 2 …: of the bodies
  std::vector<int> body_;           // of each sphere; beads of the bed are bodies, too
  std::array<Array, D> at_,
      arm_;  // of the spheres, from the centre of mass: in the body's frame, and in space
  search::NeighbourList<D> list_;
  search::PairList pairs_;  // those of the list that join two bodies
  std::int64_t seen_list_ = -1;
  ContactStages<D> stages_;
  Integrator<D> integrator_;
  std::optional<RigidMotion> motion_;  // in 3D
  WallContacts<D> walls_;
  Contacts<D> contacts_;
  GrainSums<D> sphere_sums_, body_sums_;
  std::array<Array, D> start_place_;
  EnergyAccount account_;  // start, and the losses that are no sphere's
  std::int64_t step_ = 0;
  std::unique_ptr<Team> team_;
  mutable Grains<D> told_, told_spheres_;  // for who looks

  void make_spheres();
  void lay_spheres();
  search::Candidates<D> candidates();
  void forces(double duration);
  void add_up();
  void turn();
  void correct_turn();
  void look_again();
  void tilt();
  void check_overlaps() const;
  void check_floor() const;
  Contact told(const Contacts<D>& contacts, std::size_t c) const;
  template <class Each>
  void for_contacts(const Each& each) const;
  template <class Visit>
  void for_touched_beads(const Visit& visit) const;
  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self);
};

}  // namespace chute::soft
