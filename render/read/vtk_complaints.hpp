#pragma once
#include <string>

namespace chute::read {

/// While one of these lives in any thread, VTK's complaints are kept, not printed: those of this thread's reading by this thread.
class Listening {
 public:
  Listening();
  ~Listening();
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;
  /// The first thing that VTK complained of since this thread began to listen; empty if nothing.
  static const std::string& complaint();
};

}  // namespace chute::read
