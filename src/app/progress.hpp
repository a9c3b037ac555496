#pragma once
#include <chrono>
#include <string>

namespace chute::app {

/// One line on standard error that tells how far long work is, and how long it will still take: a bar on a terminal, rewritten
/// in place and without colours; a line every half minute elsewhere; nothing when quiet.
class Progress {
 public:
  Progress(std::string what, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `part` done, 0 to 1; `rate` is a short text such as "61 M grain steps/s", or empty.
  void show(double part, const std::string& rate = "");

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  bool quiet_, terminal_, written_ = false;
  Clock::time_point begin_ = Clock::now(), shown_ = begin_;
  double begin_part_ = -1;
};

/// "12 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

}  // namespace chute::app
