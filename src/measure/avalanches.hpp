#pragma once
#include "measure/observer.hpp"

namespace chute::measure {

struct AvalancheSpec {
  double from = 0;
};
template <class Archive>
void describe(Archive& a, AvalancheSpec& spec) {
  a.value("from", spec.from, non_negative, "avalanches after this update");
}

/// [output.avalanches]: how often avalanches of each size came.
class AvalanchesOutput final : public TableOutput<AvalanchesOutput, AvalancheSpec> {
 public:
  static constexpr std::string_view word = "avalanches", text = "sizes of a pile's avalanches, counted";
  Needs needs() const override { return {.avalanches = true}; }
  std::vector<std::string> files() const override { return {"avalanches.csv"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

}  // namespace chute::measure
