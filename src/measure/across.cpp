#include <algorithm>

#include "measure/flow_outputs.hpp"

namespace chute::measure {
namespace {

/// What a strip along the flow gathers.
struct StripSums {
  double count = 0;
  std::array<double, 3> v{}, v2{};
  StripSums& operator+=(const StripSums& o) {
    count += o.count;
    for (std::size_t k = 0; k < 3; ++k) v[k] += o.v[k], v2[k] += o.v2[k];
    return *this;
  }
  template <class Archive>
  void serialize(Archive& a) {
    a(count, v, v2);
  }
};

/// Strips count from 0 to both sides: 0, −1, 1, −2 …, so that they need no bounds and those that are far are new ones at
/// the end.
std::size_t index_of_strip(double strip) {
  return static_cast<std::size_t>(strip >= 0 ? 2 * strip : -2 * strip - 1);
}
double strip_of_index(std::size_t index) {
  const std::size_t from_0 = (index + 1) / 2;
  const auto half = static_cast<double>(from_0);
  return index % 2 == 0 ? half : -half;
}

/// Mean velocity and temperature of strips, side by side across the flow or one behind the other.
class Across final : public Remembering<Across> {
 public:
  Across(const RunContext& run, const AcrossSpec& spec)
      : run_(run),
        axis_(spec.axis == StripAxis::x ? Frame::downhill : Frame::lateral),
        from_(spec.from),
        bin_(spec.bin),
        above_(spec.above),
        due_(run.schedule(spec.from.value_or(0), *spec.every)),
        blocks_(run.window(spec.from)) {}

  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }
  void look(const Look& look) override {
    if (due_.index_at(look.engine.step()) < 0) return;
    const auto grains = look.engine.grains();
    auto& strips = blocks_.sample(grains.time);
    for (std::size_t i = 0; i < grains.moving; ++i) {
      if (grains.position[run_.frame.normal()][i] < above_) continue;
      const double strip = std::floor(grains.position[axis_][i] / bin_);
      if (!(std::abs(strip) < most_layers / 2.0)) continue;
      const std::size_t at = index_of_strip(strip);
      if (at >= strips.size()) strips.resize(at + 1);
      StripSums& s = strips[at];
      const auto v = velocity_of(grains, i);
      s.count += 1;
      for (std::size_t k = 0; k < 3; ++k) s.v[k] += v[k], s.v2[k] += v[k] * v[k];
    }
  }
  void write(const Flow& flow) const override {
    struct Row {
      double y;
      double grains;
      std::array<Estimate, 3> v;
      Estimate temperature;
    };
    const auto stretches = blocks_.stretches(from_ ? *from_ : flow.from);
    std::vector<Row> rows;
    for (std::size_t b = 0; !stretches.empty() && b < stretches.front().bins.size(); ++b) {
      const auto estimate = [&](auto&& mean_of) { return estimate_bin<StripSums>(stretches, b, mean_of); };
      Row row{};
      row.y = (strip_of_index(b) + 0.5) * bin_;
      row.grains = estimate([](const StripSums& s, double samples) { return s.count / samples; }).mean;
      if (row.grains == 0) continue;
      for (std::size_t k = 0; k < 3; ++k)
        row.v[k] = estimate([k](const StripSums& s, double) { return s.v[k] / s.count; });
      row.temperature = estimate([this](const StripSums& s, double) {
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) sum += s.v2[k] / s.count - std::pow(s.v[k] / s.count, 2);
        return std::max(0.0, sum) / run_.frame.dimensions;
      });
      rows.push_back(row);
    }
    std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.y < b.y; });
    Columns<Row> columns;
    columns.add(axis_names[axis_], &Row::y).add("grains", &Row::grains);
    for (std::size_t k = 0; k < static_cast<std::size_t>(run_.frame.dimensions); ++k)
      columns.add_estimate(std::string("v_") + axis_names[k],
                           [k](const Row& row) -> const Estimate& { return row.v[k]; });
    columns.add("temperature", &Row::temperature);
    auto comments =
        run_.comments(axis_ == Frame::downhill ? "averages over strips across the flow, one behind the other"
                                               : "averages over strips along the flow, side by side");
    for (auto& note : run_.average_note(from_, flow)) comments.push_back(std::move(note));
    run_.write("across.csv", columns.csv(comments, rows));
  }
  template <class Archive>
  void serialize(Archive& a) {
    a(blocks_);
  }

 private:
  const RunContext& run_;
  std::size_t axis_;
  From from_;
  double bin_, above_;
  Schedule due_;
  Blocks<StripSums> blocks_;
};

}  // namespace

void AcrossOutput::fill(const Scales& scales) {
  if (!spec) return;
  if (spec->bin == 0) spec->bin = scales.length;
  if (!spec->every) spec->every = scales.between_samples;
}

std::vector<std::unique_ptr<Observer>> AcrossOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<Across>(run, *spec));
  return observers;
}

}  // namespace chute::measure
