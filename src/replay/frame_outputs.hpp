#pragma once
#include <string>
#include <vector>

#include "measure/observer.hpp"

namespace chute::replay {

/// What can be measured of frames: outputs of a scene that look at grains and contacts now and then. Others watch every
/// impact, which frames do not hold.
std::vector<std::string> measurable();

/// What files tell of themselves, for defaults: how far frames are apart, what is long and fast.
struct FrameScales {
  measure::Scales scales;
  double between = 1;       ///< shortest time between two frames
  bool closed_box = false;  ///< it repeats in all directions
  bool velocities = false;  ///< grains have them
  bool forces = false;      ///< contacts have forces
  bool mixture = false;     ///< moving grains are of several species
};

/// Does the output say nothing without velocities?
bool needs_velocities(const std::string& word);

/// The outputs whose names are in `only`, or, where it is empty, those that the frames have something for, with keys as in a scene's
/// [output]: `settings` are WORD.key=value. All of them look at every frame from `from` on. InputError that names the setting.
std::vector<Chosen<measure::Output>> frame_outputs(const FrameScales& of, double from,
                                                   const std::vector<std::string>& only,
                                                   const std::vector<std::string>& settings);

}  // namespace chute::replay
