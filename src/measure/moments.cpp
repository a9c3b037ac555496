#include "measure/moments.hpp"

namespace chute::measure {

Moments moments_of(const GrainsView& grains) {
  const auto D = static_cast<std::size_t>(grains.dimensions);
  const auto n = static_cast<double>(grains.moving);
  std::array<double, 3> mean{};
  for (std::size_t k = 0; k < D; ++k)
    for (std::size_t i = 0; i < grains.moving; ++i) mean[k] += grains.velocity[k][i] / n;
  double second = 0, fourth = 0;
  for (std::size_t i = 0; i < grains.moving; ++i) {
    double square = 0;
    for (std::size_t k = 0; k < D; ++k) {
      const double c = grains.velocity[k][i] - mean[k];
      square += grains.mass[i] * c * c;
    }
    second += square / n, fourth += square * square / n;
  }
  const auto d = static_cast<double>(D);
  return {second / d, second > 0 ? fourth * d / ((d + 2) * second * second) - 1 : 0};
}

namespace {

class MomentsInTime final : public Remembering<MomentsInTime> {
 public:
  MomentsInTime(const RunContext& run, const Every& every)
      : run_(run), due_(run.schedule(every.from, every.every)) {}

  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }
  void look(const Look& look) override {
    if (due_.index_at(look.engine.step()) < 0) return;
    const auto m = moments_of(look.engine.grains());
    rows_.push_back({look.engine.time(), m.temperature, m.a_2});
  }
  void write(const Flow&) const override {
    io::Csv csv(run_.comments("granular temperature, and a_2 of the velocities, of all moving grains"),
                {run_.offers.clock, "temperature", "a_2"});
    for (const auto& row : rows_) csv.row({row[0], row[1], row[2]});
    run_.write("moments.csv", csv.text());
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(rows_);
  }

 private:
  const RunContext& run_;
  Schedule due_;
  std::vector<std::array<double, 3>> rows_;
};

}  // namespace

std::vector<std::unique_ptr<Observer>> MomentsOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<MomentsInTime>(run, *spec));
  return observers;
}

}  // namespace chute::measure
