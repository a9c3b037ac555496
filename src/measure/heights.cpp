#include "measure/outputs.hpp"

namespace chute::measure {
namespace {

/// The height of every moving grain over time: its mean, with an error from the blocks that the run is cut into, which
/// are longer than anything remembers.
class Heights final : public Remembering<Heights> {
 public:
  Heights(const RunContext& run, const HeightSpec& spec)
      : run_(run), due_(run.schedule(spec.from, spec.every)), blocks_(run.window(spec.from)) {}

  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }
  void look(const Look& look) override {
    if (due_.index_at(look.engine.step()) < 0) return;
    const auto grains = look.engine.grains();
    const auto& height = grains.position[static_cast<std::size_t>(grains.dimensions - 1)];
    auto& sums = blocks_.sample(grains.time);
    sums.resize(grains.moving);
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += height[i];
  }
  void write(const Flow&) const override {
    struct Row {
      double grain;
      Estimate height;
    };
    const auto stretches = blocks_.stretches();
    std::vector<Row> rows;
    for (std::size_t i = 0; !stretches.empty() && i < stretches.front().bins.size(); ++i)
      rows.push_back(
          {static_cast<double>(i),
           estimate_bin<double>(stretches, i, [](double sum, double samples) { return sum / samples; })});
    Columns<Row> columns;
    columns.add("grain", &Row::grain).add("height", &Row::height);
    run_.write("heights.csv", columns.csv(run_.comments("mean height of each moving grain's centre"), rows));
  }
  template <class Archive>
  void serialize(Archive& a) {
    a(blocks_);
  }

 private:
  const RunContext& run_;
  Schedule due_;
  Blocks<double> blocks_;
};

}  // namespace

std::vector<std::unique_ptr<Observer>> HeightsOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<Heights>(run, *spec));
  return observers;
}

}  // namespace chute::measure
