#pragma once
#include <sstream>
#include <string>

#include "engines/soft/soft_engine.hpp"

namespace chute::test {

/// All that a checkpoint of the engine holds: two engines with the same text go on alike to the last bit.
template <int D>
std::string state(const soft::SoftEngine<D>& engine) {
  std::ostringstream out;
  engine.save(out);
  return out.str();
}

}  // namespace chute::test
