#pragma once
#include <optional>
#include <string_view>

#include "core/engine.hpp"

namespace chute::measure {

/// How well an energy account closes.
struct AccountVerdict {
  double residual = 0;  ///< energy that the integration got wrong
  double part =
      0;  ///< of what was turned over: gravity's or the walls' work, what was lost, or the energy at the start
  std::string_view word;  ///< "good" up to 0.1 %, "fair" up to 1 %, "poor" beyond
  bool poor() const { return word == "poor"; }
};
/// Nothing where no energy was turned over, as with methods that know none.
std::optional<AccountVerdict> judge_account(const EnergyAccount& energy);

}  // namespace chute::measure
