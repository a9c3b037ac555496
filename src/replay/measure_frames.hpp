#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "replay/snapshot.hpp"

namespace chute::replay {

struct MeasureJob {
  std::vector<double> times;                        ///< of the frames, in order
  std::function<Snapshot(std::size_t frame)> read;  ///< called for one frame after the other
  std::filesystem::path folder;                     ///< new or empty
  double from = 0, until = std::numeric_limits<double>::infinity();
  double gap = 0;                           ///< farthest between surfaces that touch
  std::vector<std::string> only, settings;  ///< as frame_outputs
  bool network = true;                      ///< write the contact networks that were found
  std::string title, made_by;               ///< for comments
  std::function<bool(std::size_t done, std::size_t all)> progress;  ///< false stops
};

struct MeasureReport {
  std::size_t frames = 0;
  std::vector<std::string> written;  ///< files and folders
  std::vector<std::string> notes;    ///< what files lack, and what is empty for it
};

/// Is it the name of something that is written into the folder?
bool is_measured(const std::filesystem::path& name);

/// Plays the frames to the observers of a run and writes what they tell. InputError if there is nothing to measure.
MeasureReport measure_frames(const MeasureJob& job);

}  // namespace chute::replay
