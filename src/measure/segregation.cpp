#include "measure/segregation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/sphere.hpp"
#include "measure/outputs.hpp"

namespace chute::measure {
namespace {

/// The heights of materials over time, and what each does in layers.
class Segregation final : public Remembering<Segregation> {
 public:
  Segregation(const RunContext& run, const SegregationSpec& spec)
      : run_(run),
        due_(run.schedule(0, spec.every)),
        from_(spec.from),
        bin_(spec.bin),
        layers_(run.window(spec.from)) {}

  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }
  void look(const Look& look) override {
    if (due_.index_at(look.engine.step()) < 0) return;
    const auto grains = look.engine.grains();
    const auto axis = run_.frame.normal();
    times_.push_back(grains.time);
    indices_.push_back(segregation_indices(grains, axis, count()));
    auto& heights = heights_.emplace_back(count(), 0.0);
    std::vector<double> seen(count(), 0.0);
    for (std::size_t i = 0; i < grains.moving; ++i) {
      const auto k = static_cast<std::size_t>(grains.material[i]);
      if (k >= count()) continue;
      seen[k] += 1;
      heights[k] += (grains.position[axis][i] - heights[k]) / seen[k];
    }
    for (std::size_t k = 0; k < count(); ++k)
      if (seen[k] == 0) heights[k] = std::numeric_limits<double>::quiet_NaN();
    if (grains.time >= from_.value_or(0)) sample(grains, axis);
  }
  void write(const Flow& flow) const override {
    write_series();
    write_layers(flow);
  }
  template <class Archive>
  void serialize(Archive& a) {
    a(times_, indices_, heights_, layers_);
  }

 private:
  struct Sums {
    double count = 0, volume = 0;
    std::array<double, 3> v{}, v2{};
    Sums& operator+=(const Sums& o) {
      count += o.count, volume += o.volume;
      for (std::size_t k = 0; k < 3; ++k) v[k] += o.v[k], v2[k] += o.v2[k];
      return *this;
    }
    template <class Archive>
    void serialize(Archive& a) {
      a(count, volume, v, v2);
    }
  };
  const RunContext& run_;
  Schedule due_;
  From from_;
  double bin_;
  Blocks<Sums> layers_;  // of layer b and material k at b · count() + k
  std::vector<double> times_;
  std::vector<std::vector<double>> indices_, heights_;

  std::size_t count() const { return run_.materials.size(); }

  void sample(const GrainsView& grains, std::size_t axis) {
    auto& bins = layers_.sample(grains.time);
    for (std::size_t i = 0; i < grains.moving; ++i) {
      const double b = std::floor(grains.position[axis][i] / bin_);
      const auto k = static_cast<std::size_t>(grains.material[i]);
      if (!(b >= 0 && b < most_layers) || k >= count()) continue;
      const auto at = static_cast<std::size_t>(b) * count() + k;
      if (at >= bins.size()) bins.resize((static_cast<std::size_t>(b) + 1) * count());
      const auto v = velocity_of(grains, i);
      bins[at].count += 1;
      bins[at].volume += filled_by(grains.radius[i], grains.dimensions);
      for (std::size_t d = 0; d < 3; ++d) bins[at].v[d] += v[d], bins[at].v2[d] += v[d] * v[d];
    }
  }

  /// Bed and walls have materials, too, that no moving grain is of.
  std::vector<std::size_t> seen() const {
    std::vector<std::size_t> kinds;
    for (std::size_t k = 0; k < count(); ++k)
      if (std::ranges::any_of(heights_, [k](const auto& row) { return std::isfinite(row[k]); }))
        kinds.push_back(k);
    return kinds;
  }

  void write_series() const {
    struct Instant {
      std::size_t t;
    };
    Columns<Instant> columns;
    columns.add(std::string(run_.offers.clock), [this](const Instant& now) { return times_[now.t]; });
    for (const std::size_t k : seen()) {
      columns.add("index_" + run_.materials[k], [this, k](const Instant& now) { return indices_[now.t][k]; });
      columns.add("height_" + run_.materials[k],
                  [this, k](const Instant& now) { return heights_[now.t][k]; });
    }
    std::vector<Instant> rows;
    for (std::size_t t = 0; t < times_.size(); ++t) rows.push_back({t});
    run_.write("segregation.csv",
               columns.csv(
                   run_.comments(
                       "how far each material has risen through the others (1: all of it lies above them, -1 "
                       "below), and the mean height of its grains"),
                   rows));
  }

  /// What is told of one material in one layer.
  struct Told {
    Estimate eta, temperature;
    std::array<Estimate, 3> v;
    double grains;
  };
  struct Row {
    double h;
    std::vector<Told> of;
  };
  Told told(const std::vector<Blocks<Sums>::Part>& stretches, std::size_t at) const {
    const auto estimate = [&](auto&& mean_of) { return estimate_bin<Sums>(stretches, at, mean_of); };
    const double room = run_.frame.footprint * bin_;
    Told one{};
    one.grains = estimate([](const Sums& s, double samples) { return s.count / samples; }).mean;
    one.eta = estimate([&](const Sums& s, double samples) { return s.volume / (samples * room); });
    for (std::size_t d = 0; d < 3; ++d)
      one.v[d] = estimate([d](const Sums& s, double) { return s.v[d] / s.count; });
    one.temperature = estimate([&](const Sums& s, double) {
      double sum = 0;
      for (std::size_t d = 0; d < 3; ++d) sum += s.v2[d] / s.count - (s.v[d] / s.count) * (s.v[d] / s.count);
      return sum / run_.frame.dimensions;
    });
    return one;
  }
  void write_layers(const Flow& flow) const {
    const auto stretches = layers_.stretches(from_.value_or(flow.from));
    std::vector<Row> rows;
    for (std::size_t b = 0; !stretches.empty() && b * count() < stretches.front().bins.size(); ++b) {
      Row row{(static_cast<double>(b) + 0.5) * bin_, {}};
      for (std::size_t k = 0; k < count(); ++k) row.of.push_back(told(stretches, b * count() + k));
      rows.push_back(std::move(row));
    }
    Columns<Row> columns;
    columns.add("h", &Row::h);
    for (const std::size_t k : seen()) {
      const auto& name = run_.materials[k];
      columns.add("grains_" + name, [k](const Row& row) { return row.of[k].grains; });
      columns.add_estimate("eta_" + name, [k](const Row& row) -> const Estimate& { return row.of[k].eta; });
      for (std::size_t d = 0; d < static_cast<std::size_t>(run_.frame.dimensions); ++d)
        columns.add_estimate(std::string("v_") + axis_names[d] + "_" + name,
                             [k, d](const Row& row) -> const Estimate& { return row.of[k].v[d]; });
      columns.add_estimate("temperature_" + name,
                           [k](const Row& row) -> const Estimate& { return row.of[k].temperature; });
    }
    auto comments =
        run_.comments("time averages of each material over layers at height h above the centres of the bed");
    for (auto& line : run_.average_note(from_, flow)) comments.push_back(std::move(line));
    run_.write("species.csv", columns.csv(comments, rows));
  }
};

}  // namespace

std::vector<double> segregation_indices(const GrainsView& grains, std::size_t axis, std::size_t materials) {
  std::vector<std::size_t> order(grains.moving);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return grains.position[axis][i]; });
  double all = 0, below = 0;
  for (std::size_t i = 0; i < grains.moving; ++i) all += filled_by(grains.radius[i], grains.dimensions);
  std::vector<double> own(materials, 0.0), sum(materials, 0.0);  // volume, and ∫ u over it
  double whole = 0;
  for (const std::size_t i : order) {
    const double part = filled_by(grains.radius[i], grains.dimensions), u = (below + part / 2) / all;
    below += part, whole += part * u;
    if (const auto k = static_cast<std::size_t>(grains.material[i]); k < materials)
      own[k] += part, sum[k] += part * u;
  }
  std::vector<double> index;
  for (std::size_t k = 0; k < materials; ++k) {
    const double others = all - own[k];
    const bool both = own[k] > 0 && others > 1e-9 * all;
    index.push_back(both ? 2 * (sum[k] / own[k] - (whole - sum[k]) / others)
                         : std::numeric_limits<double>::quiet_NaN());
  }
  return index;
}

void SegregationOutput::fill(const Scales& scales) {
  if (spec && spec->bin == 0) spec->bin = scales.length;
}

std::vector<std::unique_ptr<Observer>> SegregationOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<Segregation>(run, *spec));
  return observers;
}

}  // namespace chute::measure
