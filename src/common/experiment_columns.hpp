#pragma once
#include <vector>

#include "common/column_texts.hpp"

namespace chute {

/// The tables that experiments with contact laws leave (src/experiments).
std::vector<TableText> experiment_tables();

}  // namespace chute
