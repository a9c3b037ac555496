#pragma once
#include <stdexcept>
#include <string>

namespace chute {

/// The command line, or a file that it was given, is wrong. The program answers with one line and exit
/// status 2. `what()` is that line: `FILE:LINE: key: what is wrong, what is allowed`.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The work failed: a run left physics, a picture differs, a disk is full. Exit status 1.
struct WorkError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace chute
