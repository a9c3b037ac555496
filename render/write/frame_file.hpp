#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "read/grain_frame.hpp"

/// The bytes of a frame in each format. Numbers are the shortest text that reads back the same, in VTK's files the numbers
/// themselves.
namespace chute::write {

/// What a frame's file says besides its grains.
struct FrameFacts {
  std::uint64_t number = 0;    ///< of the frame, from 0
  std::optional<double> time;  ///< if the file, or its index, says
  /// Numbers of grains and species begin with 1, as LAMMPS wants of what it reads itself; false: as in the file.
  bool from_one = false;
};

/// A dump of LAMMPS (commands dump and dump_modify in its documentation): places wrapped, x y z.
std::string lammps_dump(const read::GrainFrame& frame, const FrameFacts& facts);
/// Extended XYZ (https://github.com/libAtoms/extxyz).
std::string xyz_frame(const read::GrainFrame& frame, const FrameFacts& facts);
/// A table with comments as chute's own, with a row a grain. `head`: with comments and names; a table that goes on after
/// other frames has none, and each row begins with number and time of the frame.
std::string csv_frame(const read::GrainFrame& frame, const FrameFacts& facts);
std::string csv_rows(const read::GrainFrame& frame, const FrameFacts& facts, bool head);
/// VTK, polygonal and compressed, with the names and the facts of chute's own frames. WorkError if VTK cannot.
std::string vtp_frame(const read::GrainFrame& frame, const FrameFacts& facts);

}  // namespace chute::write
