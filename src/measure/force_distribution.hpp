#pragma once
#include "measure/observer.hpp"

namespace chute::measure {

struct ForceSpec {
  double from = 0, every = 0, bin = 0.1, most = 10, layer = 0;
};
template <class Archive>
void describe(Archive& a, ForceSpec& spec) {
  a.value("from", spec.from, non_negative, "samples count after this time");
  a.required("every", spec.every, positive, "time between samples");
  a.value("bin", spec.bin, between(1e-3, 1), "width of a bin, in mean forces");
  a.value("layer", spec.layer, non_negative,
          "the mean is that of a layer so high, for forces grow with depth; 0: of all contacts");
  a.value("most", spec.most, between(1, 1000), "end of the last bin, in mean forces");
}

/// [output.forces]: how probable contact forces of each size are, against F_n/⟨F_n⟩ with the mean over the contacts of
/// the same instant (Radjai et al. 1996), all or those at the same height. Walls count as grains. Of hard grains that collide, the force between two is the
/// impulse that passed between them since the sample before, over that time.
class ForcesOutput final : public TableOutput<ForcesOutput, ForceSpec> {
 public:
  static constexpr std::string_view word = "forces", text = "distribution of contact forces over their mean";
  Needs needs() const override { return {.contacts = true}; }
  double rhythm() const override { return spec ? spec->every : std::numeric_limits<double>::infinity(); }
  std::vector<std::string> files() const override { return {"forces.csv"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

}  // namespace chute::measure
