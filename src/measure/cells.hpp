#pragma once
#include "measure/observer.hpp"

namespace chute::measure {

struct CellsSpec {
  double every = 0, from = 0, width = 0;
  std::optional<double> width_x;
  std::int64_t samples = 1;
};
template <class Archive>
void describe(Archive& a, CellsSpec& spec) {
  a.required("every", spec.every, positive, "time from one file to the next");
  a.value("from", spec.from, non_negative, "time of the first");
  a.value("width", spec.width, non_negative, "of a cell; default two beads' diameters");
  a.value("width_x", spec.width_x, positive, "of a cell along x, instead");
  a.value("samples", spec.samples, at_least(1), "looks that a file averages over, in the time before it");
}

/// [output.cells]: fields of a grid of cells, as VTK image data.
class CellsOutput final : public TableOutput<CellsOutput, CellsSpec> {
 public:
  static constexpr std::string_view word = "cells",
                                    text = "density, velocity and temperature by cell, as VTK image data";
  void fill(const Scales& scales) override {
    if (spec && spec->width == 0) spec->width = 2 * scales.length;
  }
  double rhythm() const override {
    return spec ? spec->every / static_cast<double>(spec->samples) : std::numeric_limits<double>::infinity();
  }
  std::vector<std::string> may_change() const override { return {"every", "from"}; }
  std::vector<std::string> files() const override { return {"cells.pvd", "cells"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

}  // namespace chute::measure
