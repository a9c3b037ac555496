#pragma once
#include <optional>
#include <string>
#include <vector>

#include "report/run_files.hpp"

namespace chute::report {

/// Where the energy came from and went in a run, from the first row of series.csv to the last. What came in equals what is
/// kept more, plus what was lost, plus the residual.
struct EnergyAccount {
  struct Entry {
    std::string name;
    double amount = 0;
  };
  std::vector<Entry> in, kept, lost;
  double residual = 0;

  double total_in() const;
};

/// Nothing if the run has no series, or one whose method keeps no energies.
std::optional<EnergyAccount> account_of(const RunFiles& run);

}  // namespace chute::report
