#include <cmath>
#include <limits>

#include "core/vec.hpp"
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

Vec<3> place_of(const GrainsView& grains, std::size_t i) {
  return {{grains.position[0][i], grains.position[1][i], grains.dimensions == 3 ? grains.position[2][i] : 0}};
}

/// Of the point `arm` away from a grain's centre.
Vec<3> velocity_at(const GrainsView& grains, std::size_t i, const Vec<3>& arm) {
  const bool flat = grains.dimensions == 2;
  const Vec<3> spin{
      {flat ? 0 : grains.spin[0][i], flat ? 0 : grains.spin[1][i], grains.spin[flat ? 0 : 2][i]}};
  return Vec<3>{velocity_of(grains, i)} + cross(spin, arm);
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
      // A layer in which grains touch, but none has its centre, has no velocity.
      const double mean = s.count > 0 ? s.v_x / s.count : std::numeric_limits<double>::quiet_NaN();
      const double variance = s.count > 0 ? std::max(0.0, s.v_x2 / s.count - mean * mean) : mean;
      const double looks = static_cast<double>(looks_), volumes = looks * bin_ * run_.frame.footprint;
      rows_.push_back({grains.time, (static_cast<double>(b) + 0.5) * bin_, s.count / looks, mean,
                       std::sqrt(variance), s.gravity / volumes, s.carried / volumes,
                       s.dissipation / volumes});
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
    const Vec<3> gravity{run_.gravity_at(grains.time)};
    for (std::size_t i = 0; i < grains.moving; ++i)
      if (auto* layer = layer_at(grains.position[normal][i]))
        layer->gravity += grains.mass[i] * dot(gravity, Vec<3>{velocity_of(grains, i)});
    const auto carry = [&](std::size_t i, const Vec<3>& arm, const Vec<3>& force) {
      if (i >= grains.moving) return 0.0;
      const double power = dot(force, velocity_at(grains, i, arm));
      if (auto* layer = layer_at(grains.position[normal][i])) layer->carried += power;
      return power;
    };
    for (const auto& c : look.engine.contacts()) {
      const auto a = static_cast<std::size_t>(c.a);
      const Vec<3> arm = Vec<3>{c.point} - place_of(grains, a), force{c.force};
      double taken = -carry(a, arm, -1 * force);
      if (c.b >= 0) taken -= carry(static_cast<std::size_t>(c.b), arm - Vec<3>{c.branch}, force);
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
