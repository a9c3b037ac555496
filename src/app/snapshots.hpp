#pragma once
#include <string>
#include <vector>

#include "read/meanings.hpp"
#include "read/run_frames.hpp"
#include "replay/snapshot.hpp"

namespace chute::app {

/// Frames in the order of their times.
struct TimedFrames {
  std::vector<read::FrameFile> frames;
  std::vector<double> times;
};

/// The frames of all sources (read::find_frames) with their times: as an index or a text says, else as the file itself does;
/// the frames' numbers where none says. InputError if only some do.
TimedFrames timed_frames(const std::vector<std::string>& sources, const read::Meanings& meanings);

/// What the user says of a file besides the names of its arrays.
struct FileSays {
  read::Meanings meanings;
  std::vector<std::string>
      bed;  ///< types, numbers or words, of grains that do not move; chute's own files say so themselves
};

/// A frame as src/replay takes it, with the network that a run has beside it.
replay::Snapshot snapshot_of(const read::FrameFile& frame, const FileSays& says);

}  // namespace chute::app
