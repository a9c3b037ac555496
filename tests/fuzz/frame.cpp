#include "common/error.hpp"
#include "read/grain_frame.hpp"
#include "read/network.hpp"
#include "targets.hpp"

void chute::fuzz::frame(std::string_view bytes) {
  // A file that is no set of grains may yet be a network.
  try {
    read::parse_frame({{"frame.vtp", std::string(bytes)}}, 0.5);
  } catch (const InputError&) {
  }
  read::parse_network({read::FileBytes{"contacts.vtp", std::string(bytes)}});
}
