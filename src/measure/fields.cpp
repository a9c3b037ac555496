#include "measure/fields.hpp"

namespace chute::measure {
namespace {

/// φ at r = x w, times w.
double kernel(double x) {
  const double rest = 1 - x * x;
  return std::abs(x) < 1 ? 15.0 / 16 * rest * rest : 0;
}
/// Its integral from −∞.
double kernel_below(double x) {
  if (x <= -1) return 0;
  if (x >= 1) return 1;
  return 0.5 + x * (15.0 / 16 - x * x * (5.0 / 8 - 3.0 / 16 * x * x));
}

}  // namespace

Fields::Fields(const Frame& frame, double width, const Window& window)
    : frame_(frame), width_(width), spacing_(width / 4), blocks_(window) {}

/// Calls add(sums, h) for the heights that something between `low` and `high` is felt at.
template <class Add>
void Fields::around(std::vector<LayerSums>& points, double low, double high, const Add& add) const {
  const double first = std::max(0.0, std::ceil(low / spacing_)),
               last = std::min(std::floor((high + 2 * width_) / spacing_), most_layers - 1.0);
  if (!(last >= first)) return;
  const auto to = static_cast<std::size_t>(last);
  if (to >= points.size()) points.resize(to + 1);
  for (auto p = static_cast<std::size_t>(first); p <= to; ++p) add(points[p], height(p));
}

void Fields::sample(const GrainsView& grains, std::span<const Contact>, std::span<const Contact> forces) {
  auto& points = blocks_.sample(grains.time);
  const auto normal = frame_.normal();
  for (std::size_t i = 0; i < grains.moving; ++i) {
    const double y = grains.position[normal][i];
    beyond_ += y > height(most_layers);
    around(points, y, y, [&](LayerSums& sums, double h) {
      sums.add_grain(grains.mass[i] * kernel((h - y) / width_) / width_, velocity_of(grains, i));
    });
  }
  for (const auto& contact : forces) {
    const double begin = begin_of(contact, grains, normal), end = begin + contact.branch[normal];
    around(points, std::min(begin, end), std::max(begin, end), [&](LayerSums& sums, double h) {
      // The mean of φ along the branch; where that lies level, φ there.
      const double a = (h - begin) / width_, b = (h - end) / width_;
      const double mean =
          std::abs(b - a) > 1e-6 ? (kernel_below(a) - kernel_below(b)) / (a - b) : kernel((a + b) / 2);
      sums.add_contact(contact, mean / width_);
    });
  }
}

std::vector<FieldPoint> Fields::result(double start) const {
  const auto stretches = blocks_.stretches(start);
  std::vector<FieldPoint> fields;
  if (stretches.empty()) return fields;
  const double area = frame_.footprint;
  for (std::size_t p = 0; p < stretches[0].bins.size(); ++p) {
    const auto estimate = [&](auto&& mean_of) { return estimate_bin<LayerSums>(stretches, p, mean_of); };
    const auto per_area = [&](auto&& sum) {
      return estimate([&](const LayerSums& s, double samples) { return sum(s) / (samples * area); });
    };
    FieldPoint& at = fields.emplace_back();
    at.h = height(p);
    at.density = per_area([](const LayerSums& s) { return s.mass; });
    for (std::size_t k = 0; k < 3; ++k)
      at.v[k] = estimate([k](const LayerSums& s, double) { return s.momentum[k] / s.mass; });
    for (std::size_t t = 0; t < 6; ++t) {
      at.kinetic[t] = per_area([t](const LayerSums& s) { return s.kinetic(t); });
      at.contact[t] = per_area([t](const LayerSums& s) { return s.contact[t]; });
    }
  }
  return fields;
}

}  // namespace chute::measure
