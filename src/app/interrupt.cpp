#include "app/interrupt.hpp"

#include <csignal>

namespace chute::app {
namespace {
volatile std::sig_atomic_t asked = 0;
}

void watch_for_interrupt() {
  std::signal(SIGINT, [](int) { asked = 1; });
  std::signal(SIGTERM, [](int) { asked = 1; });
}

bool interrupted() { return asked != 0; }

}  // namespace chute::app
