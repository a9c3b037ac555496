#pragma once

namespace chute::app {

/// From now on Ctrl-C, SIGTERM and a terminal that closes do not kill: long work asks `interrupted()` and ends in order.
void watch_for_interrupt();
bool interrupted();

}  // namespace chute::app
