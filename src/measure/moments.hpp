#pragma once
#include "measure/observer.hpp"

namespace chute::measure {

/// Temperature and fourth cumulant of the velocities c = v − u about their mean u, of all moving grains:
/// T = ⟨m c²⟩/D, a_2 = ⟨(m c²)²⟩/(D(D + 2) T²) − 1, 0 of a Maxwellian (van Noije & Ernst 1998).
struct Moments {
  double temperature = 0, a_2 = 0;
};
Moments moments_of(const GrainsView& grains);

/// [output.moments]: these against time, the same for every method.
class MomentsOutput final : public TableOutput<MomentsOutput, Every> {
 public:
  static constexpr std::string_view word = "moments", text = "temperature and a_2 of all velocities";
  double rhythm() const override { return spec ? spec->every : std::numeric_limits<double>::infinity(); }
  std::vector<std::string> may_change() const override { return {"every", "from"}; }
  std::vector<std::string> files() const override { return {"moments.csv"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

}  // namespace chute::measure
