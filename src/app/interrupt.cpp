#include "app/interrupt.hpp"

#include <csignal>

namespace chute::app {
namespace {
volatile std::sig_atomic_t asked = 0;
}

void watch_for_interrupt() {
  std::signal(SIGINT, [](int) { asked = 1; });
  std::signal(SIGTERM, [](int) { asked = 1; });
  // a terminal that closes; nohup's wish to be left alone stands
  if (std::signal(SIGHUP, [](int) { asked = 1; }) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

bool interrupted() { return asked != 0; }

}  // namespace chute::app
