#pragma once

namespace chute::app {

/// From now on Ctrl-C and SIGTERM do not kill: long work asks `interrupted()` and ends in order.
void watch_for_interrupt();
bool interrupted();

}  // namespace chute::app
