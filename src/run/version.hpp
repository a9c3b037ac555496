#pragma once

namespace chute::run {
extern const char* const version;  ///< of chute, as in CMakeLists.txt
extern const char* const commit;   ///< the source it was built from, as git describes it
}  // namespace chute::run
