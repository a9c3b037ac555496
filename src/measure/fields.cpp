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

Fields::Fields(double length, double width, const Window& window)
    : length_(length), width_(width), spacing_(width / 4), blocks_(window) {}

/// Calls add(sums, h) for the heights that something between `low` and `high` is felt at.
template <class Add>
void Fields::around(std::vector<LayerSums>& points, double low, double high, const Add& add) const {
  const double first = std::ceil(low / spacing_), last = std::floor((high + 2 * width_) / spacing_);
  if (!(last >= 0)) return;
  const auto to = static_cast<std::size_t>(last);
  if (to >= points.size()) points.resize(to + 1);
  for (auto p = static_cast<std::size_t>(std::max(0.0, first)); p <= to; ++p) add(points[p], height(p));
}

void Fields::sample(const GrainsView& grains, std::span<const ContactRecord> contacts) {
  auto& points = blocks_.sample(grains.time);
  for (std::size_t i = 0; i < grains.moving; ++i) {
    const double y = grains.position[1][i];
    around(points, y, y, [&](LayerSums& sums, double h) {
      sums.add_grain(grains.mass[i] * kernel((h - y) / width_) / width_, grains.velocity[0][i],
                     grains.velocity[1][i]);
    });
  }
  for (const auto& contact : contacts) {
    const Branch branch = branch_of(contact, grains);
    const double begin = branch.h_i, end = begin + branch.way[1];
    around(points, std::min(begin, end), std::max(begin, end), [&](LayerSums& sums, double h) {
      // The mean of φ along the branch; where that lies level, φ there.
      const double a = (h - begin) / width_, b = (h - end) / width_;
      const double mean =
          std::abs(b - a) > 1e-6 ? (kernel_below(a) - kernel_below(b)) / (a - b) : kernel((a + b) / 2);
      const auto stress = branch.stress(mean / width_);
      for (std::size_t k = 0; k < 3; ++k) sums.contact[k] += stress[k];
    });
  }
}

std::vector<FieldPoint> Fields::result(double start) const {
  const auto stretches = blocks_.stretches(start);
  std::vector<FieldPoint> fields;
  if (stretches.empty()) return fields;
  for (std::size_t p = 0; p < stretches[0].bins.size(); ++p) {
    const auto estimate = [&](auto&& mean_of) { return estimate_bin<LayerSums>(stretches, p, mean_of); };
    const auto kinetic = [&](std::size_t k) {
      return estimate(
          [&](const LayerSums& s, double samples) { return s.kinetic()[k] / (samples * length_); });
    };
    const auto contact = [&](std::size_t k) {
      return estimate([&](const LayerSums& s, double samples) { return s.contact[k] / (samples * length_); });
    };
    fields.push_back({height(p), estimate([&](const LayerSums& s, double samples) {
                        return s.mass / (samples * length_);
                      }),
                      estimate([](const LayerSums& s, double) { return s.momentum_x / s.mass; }),
                      estimate([](const LayerSums& s, double) { return s.momentum_y / s.mass; }), kinetic(0),
                      kinetic(1), kinetic(2), contact(0), contact(1), contact(2)});
  }
  return fields;
}

}  // namespace chute::measure
