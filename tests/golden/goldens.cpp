#include "golden.hpp"

namespace chute::golden {

std::vector<Golden> all_goldens() {
  std::vector<Golden> all;
  for (const auto& list : {plot_goldens(), frame_goldens()}) all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace chute::golden
