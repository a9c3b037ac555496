#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "common/error.hpp"
#include "targets.hpp"

/// The entry that libFuzzer calls; CHUTE_FUZZ_TARGET says which reader this program is for.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    chute::fuzz::CHUTE_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  } catch (const chute::InputError&) {
  } catch (const chute::WorkError&) {
  }
  return 0;
}
