#include <fmt/format.h>

#include "measure/ball_outputs.hpp"
#include "measure/standstill.hpp"

namespace chute::measure {
namespace {

using Velocity = std::array<double, 3>;

class Velocities final : public Remembering<Velocities> {
 public:
  Velocities(const RunContext& run, const VelocitySpec& spec)
      : run_(run),
        due_(run.schedule(spec.from, spec.every)),
        bin_(spec.bin),
        rest_(run.frame.bead_spacing, run.gravity),
        kept_(spec.most) {}

  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }
  void look(const Look& look) override {
    if (due_.index_at(look.engine.step()) < 0) return;
    const auto grains = look.engine.grains();
    rest_.note(grains);
    for (std::size_t i = 0; i < grains.moving; ++i) {
      Velocity v{};
      for (std::size_t k = 0; k < dimensions(); ++k) v[k] = grains.velocity[k][i];
      pending_.add(i, grains.time, v);
    }
    pending_.release(grains.time, rest_, [&](std::size_t i, double time, const Velocity& v) {
      kept_.add({time, static_cast<double>(i), v[0], v[1], v[2]});
      for (std::size_t k = 0; k < dimensions(); ++k)
        counts_[k][static_cast<std::int64_t>(std::floor(v[k] / bin_))] += 1;
    });
  }
  void write(const Flow&) const override {
    std::vector<std::string_view> names{run_.offers.clock, "grain", "v_x", "v_y"};
    if (dimensions() == 3) names.emplace_back("v_z");
    io::Csv samples(run_.comments(fmt::format("velocities of moving grains, {} of {} samples",
                                              kept_.kept().size(), kept_.seen())),
                    names);
    for (const auto& s : kept_.kept()) {
      const std::vector<io::Csv::Cell> cells(s.begin(),
                                             s.begin() + static_cast<std::ptrdiff_t>(names.size()));
      samples.row(cells);
    }
    run_.write("velocities.csv", samples.text());
    io::Csv histograms(run_.comments("probability densities of the velocities of moving grains"),
                       {"component", "v", "density"});
    for (std::size_t k = 0; k < dimensions(); ++k)
      for (const auto& [bin, count] : counts_[k])
        histograms.row({axis_names[k]}, {(static_cast<double>(bin) + 0.5) * bin_,
                                         count / (static_cast<double>(kept_.seen()) * bin_)});
    run_.write("velocity_histograms.csv", histograms.text());
  }
  template <class Archive>
  void serialize(Archive& a) {
    a(rest_, pending_, kept_, counts_);
  }

 private:
  const RunContext& run_;
  Schedule due_;
  double bin_;
  Standstill rest_;
  Pending<Velocity> pending_;
  Thinned<std::array<double, 5>> kept_;
  std::array<std::map<std::int64_t, double>, 3> counts_;

  std::size_t dimensions() const { return static_cast<std::size_t>(run_.frame.dimensions); }
};

}  // namespace

void VelocitiesOutput::fill(const Scales& scales) {
  constexpr double narrow = 0.02;
  if (spec && spec->bin == 0) spec->bin = narrow * scales.velocity;
}

std::vector<std::unique_ptr<Observer>> VelocitiesOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<Velocities>(run, *spec));
  return observers;
}

}  // namespace chute::measure
