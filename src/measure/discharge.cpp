#include "measure/flow_outputs.hpp"

namespace chute::measure {
namespace {

/// How many grains, and how much mass, lie below an opening.
class Discharge final : public Remembering<Discharge> {
 public:
  Discharge(const RunContext& run, const DischargeSpec& spec)
      : run_(run), below_(spec.below), due_(run.schedule(0, spec.every)) {}

  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }
  void look(const Look& look) override {
    if (due_.index_at(look.engine.step()) < 0) return;
    const auto grains = look.engine.grains();
    double count = 0, mass = 0;
    for (std::size_t i = 0; i < grains.moving; ++i)
      if (grains.position[run_.frame.normal()][i] < below_) count += 1, mass += grains.mass[i];
    rows_.push_back({grains.time, count, mass});
  }
  void write(const Flow&) const override {
    io::Csv csv(run_.comments("grains whose centre lies below the opening"),
                {run_.offers.clock, "out", "out_mass"});
    for (const auto& row : rows_) csv.row({row[0], row[1], row[2]});
    run_.write("discharge.csv", csv.text());
  }
  template <class Archive>
  void serialize(Archive& a) {
    a(rows_);
  }

 private:
  const RunContext& run_;
  double below_;
  Schedule due_;
  std::vector<std::array<double, 3>> rows_;  // time, number, mass
};

}  // namespace

std::vector<std::unique_ptr<Observer>> DischargeOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<Discharge>(run, *spec));
  return observers;
}

}  // namespace chute::measure
