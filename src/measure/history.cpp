#include <cmath>
#include <limits>

#include "measure/flow_outputs.hpp"

namespace chute::measure {
namespace {

struct HistorySums {
  double count = 0, v_x = 0, v_x2 = 0;
  double gravity = 0, carried = 0, dissipation = 0;  // powers
  template <class Archive>
  void serialize(Archive& a) {
    a(count, v_x, v_x2, gravity, carried, dissipation);
  }
};

using Numbers = std::array<double, 3>;
double dot(const Numbers& a, const Numbers& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Of the point `arm` away from a grain's centre.
Numbers velocity_at(const GrainsView& grains, std::size_t i, const Numbers& arm) {
  const auto v = velocity_of(grains, i);
  if (grains.dimensions == 2) {
    const double spin = grains.spin[0][i];
    return {v[0] - spin * arm[1], v[1] + spin * arm[0], 0};
  }
  const Numbers w{grains.spin[0][i], grains.spin[1][i], grains.spin[2][i]};
  return {v[0] + w[1] * arm[2] - w[2] * arm[1], v[1] + w[2] * arm[0] - w[0] * arm[2],
          v[2] + w[0] * arm[1] - w[1] * arm[0]};
}

/// Profiles of grains, their velocity and its fluctuations over the height, again and again: what a front is seen in.
class History final : public Remembering<History> {
 public:
  History(const RunContext& run, const HistorySpec& spec)
      : run_(run),
        bin_(spec.bin),
        samples_(spec.samples),
        between_(spec.between),
        powers_(spec.powers),
        due_(run.schedule(spec.from, spec.every / static_cast<double>(spec.samples))) {}

  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }
  void look(const Look& look) override {
    const auto index = due_.index_at(look.engine.step());
    if (index < 0) return;
    const auto grains = look.engine.grains();
    for (std::size_t i = 0; i < grains.moving; ++i) {
      const double x = grains.position[Frame::downhill][i];
      if (between_ && !(x >= (*between_)[0] && x < (*between_)[1])) continue;
      auto* layer = layer_at(grains.position[run_.frame.normal()][i]);
      if (!layer) continue;
      const double v = grains.velocity[Frame::downhill][i];
      layer->count += 1, layer->v_x += v, layer->v_x2 += v * v;
    }
    if (powers_) add_powers(look, grains);
    looks_ += 1;
    if (index % samples_ != 0) return;
    for (std::size_t b = 0; b < now_.size(); ++b) {
      const HistorySums& s = now_[b];
      if (s.count == 0 && s.dissipation == 0) continue;
      const double mean = s.count > 0 ? s.v_x / s.count : std::numeric_limits<double>::quiet_NaN();
      const double looks = static_cast<double>(looks_), volumes = looks * bin_ * run_.frame.footprint;
      rows_.push_back({grains.time, (static_cast<double>(b) + 0.5) * bin_, s.count / looks, mean,
                       std::sqrt(std::max(0.0, s.v_x2 / s.count - mean * mean)), s.gravity / volumes,
                       s.carried / volumes, s.dissipation / volumes});
    }
    now_.clear(), looks_ = 0;
  }
  void write(const Flow&) const override {
    std::vector<std::string_view> names{run_.offers.clock, "h", "grains", "v_x", "sigma_x"};
    if (powers_) names.insert(names.end(), {"gravity_power", "carried_power", "dissipation"});
    io::Csv csv(run_.comments("profiles over the height, each averaged over the looks since the one before"),
                names);
    for (const auto& row : rows_)
      csv.row(
          std::vector<io::Csv::Cell>(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(names.size())));
    run_.write("history.csv", csv.text());
  }
  template <class Archive>
  void serialize(Archive& a) {
    a(rows_, now_, looks_);
  }

 private:
  const RunContext& run_;
  double bin_;
  std::int64_t samples_;
  std::optional<std::vector<double>> between_;
  bool powers_;
  Schedule due_;
  std::vector<std::array<double, 8>> rows_;  // as written
  std::vector<HistorySums> now_;             // since the last profile
  std::int64_t looks_ = 0;

  HistorySums* layer_at(double height) {
    const double b = std::floor(height / bin_);
    if (!(b >= 0 && b < most_layers)) return nullptr;
    const auto at = static_cast<std::size_t>(b);
    if (at >= now_.size()) now_.resize(at + 1);
    return &now_[at];
  }

  /// A contact takes −F·(v_b − v_a) from the motion, at its point. What it does on a grain belongs where the grain's centre is:
  /// the difference is what it carries from layer to layer.
  void add_powers(const Look& look, const GrainsView& grains) {
    const auto normal = run_.frame.normal();
    const auto gravity = run_.gravity_at(grains.time);
    for (std::size_t i = 0; i < grains.moving; ++i)
      if (auto* layer = layer_at(grains.position[normal][i]))
        layer->gravity += grains.mass[i] * dot(gravity, velocity_of(grains, i));
    const auto carry = [&](std::size_t i, const Numbers& arm, const Numbers& force) {
      if (i >= grains.moving) return 0.0;
      const double power = dot(force, velocity_at(grains, i, arm));
      if (auto* layer = layer_at(grains.position[normal][i])) layer->carried += power;
      return power;
    };
    for (const auto& c : look.engine.contacts()) {
      const auto a = static_cast<std::size_t>(c.a);
      Numbers arm_a{}, arm_b{}, back{};
      for (std::size_t k = 0; k < 3; ++k) {
        const double centre = k < static_cast<std::size_t>(grains.dimensions) ? grains.position[k][a] : 0;
        arm_a[k] = c.point[k] - centre;
        arm_b[k] = arm_a[k] - c.branch[k];
        back[k] = -c.force[k];
      }
      double taken = -carry(a, arm_a, back);
      if (c.b >= 0) taken -= carry(static_cast<std::size_t>(c.b), arm_b, c.force);
      if (auto* layer = layer_at(c.point[normal])) layer->dissipation += taken, layer->carried += taken;
    }
  }
};

}  // namespace

std::vector<std::unique_ptr<Observer>> HistoryOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<History>(run, *spec));
  return observers;
}

}  // namespace chute::measure
