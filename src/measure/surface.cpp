#include "measure/surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "measure/flow_outputs.hpp"

namespace chute::measure {
namespace {

/// A straight line through the surface on one side of its top, `step` bins farther from it each time: the angle by which it falls.
/// NaN of fewer than three points.
double slope_from(const Surface& surface, std::size_t top, std::ptrdiff_t step, const SurfaceSpec& spec) {
  const double highest = surface.heights[top];
  double n = 0, x = 0, h = 0, xx = 0, xh = 0;
  for (auto k = static_cast<std::ptrdiff_t>(top);
       k >= 0 && k < std::ssize(surface.heights) &&
       surface.heights[static_cast<std::size_t>(k)] >= spec.low * highest;
       k += step) {  // what lies beyond a gap, or the foot, is another heap
    const double height = surface.heights[static_cast<std::size_t>(k)];
    if (height > spec.high * highest) continue;
    const double along = static_cast<double>(std::abs(k - static_cast<std::ptrdiff_t>(top))) * spec.bin;
    n += 1, x += along, h += height, xx += along * along, xh += along * height;
  }
  const double spread = n * xx - x * x;
  if (n < 3 || !(spread > 0)) return std::numeric_limits<double>::quiet_NaN();
  return std::atan(-(n * xh - x * h) / spread) * 180 / std::numbers::pi;
}

}  // namespace

Surface surface_of(const GrainsView& grains, double bin) {
  const auto normal = static_cast<std::size_t>(grains.dimensions) - 1;
  std::map<std::pair<double, double>, double> tops;  // by place along and across
  for (std::size_t i = 0; i < grains.moving; ++i) {
    const double along = std::floor(grains.position[0][i] / bin),
                 across = grains.dimensions == 3 ? std::floor(grains.position[1][i] / bin) : 0;
    if (!(std::abs(along) < most_layers / 2.0 && std::abs(across) < most_layers / 2.0)) continue;
    const double top = grains.position[normal][i] + grains.radius[i];
    const auto [at, is_new] = tops.try_emplace({along, across}, top);
    if (!is_new) at->second = std::max(at->second, top);
  }
  Surface surface;
  if (tops.empty()) return surface;
  const double first = tops.begin()->first.first, last = tops.rbegin()->first.first;
  surface.first = static_cast<std::int64_t>(first);
  surface.heights.assign(static_cast<std::size_t>(last - first) + 1, 0);
  std::vector<double> count(surface.heights.size());
  for (const auto& [place, top] : tops) {
    const auto k = static_cast<std::size_t>(place.first - first);
    surface.heights[k] += (top - surface.heights[k]) / ++count[k];
  }
  for (std::size_t k = 0; k < count.size(); ++k)
    if (count[k] == 0) surface.heights[k] = std::numeric_limits<double>::quiet_NaN();
  return surface;
}

Slopes slopes_of(const Surface& surface, const SurfaceSpec& spec) {
  Slopes slopes;
  const auto& h = surface.heights;
  const auto lower = [](double a, double b) { return std::isnan(a) || a < b; };
  const auto highest = std::max_element(h.begin(), h.end(), lower);
  if (highest == h.end() || !(*highest > 0)) return slopes;
  const auto top = static_cast<std::size_t>(highest - h.begin());
  slopes.height = *highest;
  slopes.top = (static_cast<double>(surface.first + static_cast<std::int64_t>(top)) + 0.5) * spec.bin;
  slopes.left = slope_from(surface, top, -1, spec), slopes.right = slope_from(surface, top, 1, spec);
  return slopes;
}

namespace {

/// The free surface, as time goes on.
class SurfaceObserver final : public Remembering<SurfaceObserver> {
 public:
  SurfaceObserver(const RunContext& run, const SurfaceSpec& spec)
      : run_(run), spec_(spec), due_(run.schedule(spec.from, spec.every)) {}

  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }
  void look(const Look& look) override {
    if (due_.index_at(look.engine.step()) < 0) return;
    const auto grains = look.engine.grains();
    times_.push_back(grains.time);
    seen_.push_back(surface_of(grains, spec_.bin));
  }
  void write(const Flow&) const override {
    io::Csv surface(
        run_.comments("height of the free surface: the highest point of the grains in a strip across x, in "
                      "space the mean of those of its squares"),
        {run_.offers.clock, "x", "height"}),
        slopes(run_.comments(fmt::format(
                   "slopes of the surface on both sides of its highest place, of straight lines through "
                   "it between {:g} and {:g} of that height",
                   spec_.low, spec_.high)),
               {run_.offers.clock, "angle_left", "angle_right", "top", "height"});
    for (std::size_t t = 0; t < times_.size(); ++t) {
      for (std::size_t k = 0; k < seen_[t].heights.size(); ++k)
        surface.row({times_[t],
                     (static_cast<double>(seen_[t].first + static_cast<std::int64_t>(k)) + 0.5) * spec_.bin,
                     seen_[t].heights[k]});
      const auto found = slopes_of(seen_[t], spec_);
      slopes.row({times_[t], found.left, found.right, found.top, found.height});
    }
    run_.write("surface.csv", surface.text());
    run_.write("slopes.csv", slopes.text());
  }
  template <class Archive>
  void serialize(Archive& a) {
    a(times_, seen_);
  }

 private:
  const RunContext& run_;
  SurfaceSpec spec_;
  Schedule due_;
  std::vector<double> times_;
  std::vector<Surface> seen_;
};

}  // namespace

void SurfaceOutput::fill(const Scales& scales) {
  if (spec && spec->bin == 0) spec->bin = scales.length;
}

std::vector<std::unique_ptr<Observer>> SurfaceOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<SurfaceObserver>(run, *spec));
  return observers;
}

}  // namespace chute::measure
