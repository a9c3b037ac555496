#include "measure/account.hpp"

#include <algorithm>
#include <cmath>

namespace chute::measure {

std::optional<AccountVerdict> judge_account(const EnergyAccount& e) {
  constexpr double good = 1e-3, fair = 1e-2;
  const double turned_over = std::max({std::abs(e.gravity_work), std::abs(e.wall_work), e.inflow, e.outflow,
                                       std::abs(e.projection_work), e.normal_loss + e.shear_loss, e.start});
  if (!(turned_over > 0) || !std::isfinite(e.residual())) return {};
  AccountVerdict verdict{e.residual(), e.residual() / turned_over, ""};
  const double size = std::abs(verdict.part);
  verdict.word = size <= good ? "good" : size <= fair ? "fair" : "poor";
  return verdict;
}

}  // namespace chute::measure
