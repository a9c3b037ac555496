#include "measure/force_distribution.hpp"

#include <fmt/format.h>

#include <map>

#include "measure/contact_samples.hpp"

namespace chute::measure {
namespace {

class Forces final : public Remembering<Forces> {
 public:
  Forces(const RunContext& run, const ForceSpec& spec)
      : run_(run),
        spec_(spec),
        due_(run.schedule(spec.from, spec.every)),
        contacts_(run, due_.step_of(0)),
        counts_(run.window(spec.from)) {}

  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }
  bool wants_collisions(std::int64_t step) const override { return contacts_.wants_collisions(step); }
  void look(const Look& look) override {
    contacts_.gather(look);
    if (due_.index_at(look.engine.step()) < 0) return;
    const auto now = contacts_.take(look);
    if (!now) return;
    std::map<std::int64_t, std::vector<double>> forces;  // of each layer
    for (const auto& c : joined_by_pair(*now))
      if (c.normal_force > 0) forces[layer_of(c)].push_back(c.normal_force);
    if (forces.empty()) return;
    auto& bins = counts_.sample(look.engine.time());
    bins.resize(count() + 1);  // and in the last, how many contacts there were in all
    for (const auto& [layer, values] : forces) count_layer(values, bins);
  }
  void count_layer(const std::vector<double>& forces, std::vector<double>& bins) const {
    const double mean = estimate_of(forces).mean;
    for (const double f : forces) {
      const double bin = f / (mean * spec_.bin);
      if (bin < static_cast<double>(count())) bins[static_cast<std::size_t>(bin)] += 1;
    }
    bins.back() += static_cast<double>(forces.size());
  }
  void write(const Flow&) const override {
    const auto stretches = counts_.stretches();
    std::vector<double> total(count() + 1);
    for (const auto& s : stretches)
      for (std::size_t b = 0; b < s.bins.size(); ++b) total[b] += s.bins[b];
    auto comments = run_.comments(
        "probability density of normal contact forces against F_n/<F_n>, the mean of its instant");
    comments.push_back(fmt::format("{} contacts seen", total.back()));
    io::Csv csv(comments, {"force", "density", "density_err"});
    for (std::size_t b = 0; total.back() > 0 && b < count(); ++b) {
      std::vector<double> parts;
      for (const auto& s : stretches)
        if (!s.bins.empty() && s.bins.back() > 0) parts.push_back(s.bins[b] / (s.bins.back() * spec_.bin));
      csv.row({(static_cast<double>(b) + 0.5) * spec_.bin, total[b] / (total.back() * spec_.bin),
               estimate_of(parts).error});
    }
    run_.write("forces.csv", csv.text());
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(contacts_, counts_);
  }

 private:
  const RunContext& run_;
  ForceSpec spec_;
  Schedule due_;
  ContactSamples contacts_;
  Blocks<double> counts_;

  std::int64_t layer_of(const Contact& c) const {
    const double height = c.point[static_cast<std::size_t>(run_.frame.dimensions - 1)];
    return spec_.layer > 0 ? static_cast<std::int64_t>(std::floor(height / spec_.layer)) : 0;
  }
  std::size_t count() const { return static_cast<std::size_t>(std::ceil(spec_.most / spec_.bin - 1e-9)); }
};

}  // namespace

std::vector<std::unique_ptr<Observer>> ForcesOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<Forces>(run, *spec));
  return observers;
}

}  // namespace chute::measure
