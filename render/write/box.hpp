#pragma once
#include <array>

#include "read/grain_frame.hpp"

namespace chute::write {

/// The box that a frame's file states: along axes that repeat the period, along others as far as the grains reach. Dumps and
/// XYZ files keep their own, tilted or not.
struct Box {
  read::Lattice lattice;
  std::array<bool, 3> fitted{};  ///< along each edge: it is just the grains' extent
  Eigen::Vector3d high;          ///< upper ends of a box that is not tilted, as the file has them
};

/// A frame in the plane is as thick as its largest grain; `flat_repeats` says whether the thickness counts as a period,
/// which LAMMPS wants of its planes.
Box box_of(const read::GrainFrame& frame, bool flat_repeats);

}  // namespace chute::write
