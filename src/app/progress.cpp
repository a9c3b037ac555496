#include "app/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "app/say.hpp"

namespace chute::app {

std::string duration_text(double seconds) {
  const auto s = std::lround(seconds);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
}

Progress::Progress(std::string what, bool quiet)
    : what_(std::move(what)), quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (written_ && terminal_) say("\n");
}

void Progress::show(double part, const std::string& rate) {
  const auto now = Clock::now();
  if (begin_part_ < 0) begin_part_ = part, begin_ = now;
  const auto pause = terminal_ ? std::chrono::milliseconds(200) : std::chrono::milliseconds(30000);
  if (quiet_ || (part < 1 && now - shown_ < pause)) return;
  if (part >= 1 && !terminal_ && !written_) return;  // short work needs no line in a log
  shown_ = now;
  written_ = true;
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  const double gone = part - begin_part_;
  const auto left = gone > 0 && part < 1 ? duration_text(seconds * (1 - part) / gone) + " left" : "";
  if (terminal_) {
    constexpr int width = 24;
    const int full = std::clamp(static_cast<int>(std::lround(width * part)), 0, width);
    std::string bar;
    for (int i = 0; i < width; ++i) bar += i < full ? "█" : "░";
    tell("\r\x1b[K{} {} {:3.0f} %  {}{}{}", what_, bar, 100 * part, rate, rate.empty() ? "" : "  ", left);
  } else {
    tell("{}: {:3.0f} %  {}  {}\n", what_, 100 * part, rate, left);
  }
}

}  // namespace chute::app
