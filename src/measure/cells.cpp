#include "measure/cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "common/pvd.hpp"
#include "core/sphere.hpp"
#include "io/cells_file.hpp"

namespace chute::measure {
namespace {

/// What a cell gathers.
struct CellSums {
  double number = 0, content = 0, mass = 0, spinning = 0;  ///< the last: Σ I ω²
  std::array<double, 3> momentum{};
  std::array<double, 6> flux{};  ///< Σ m v v: xx, yy, zz, xy, yz, xz
  template <class Archive>
  void serialize(Archive& a) {
    a(number, content, mass, spinning, momentum, flux);
  }
};
constexpr std::array<std::array<std::size_t, 2>, 6> tensor{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};

/// A grid of cells that grows with what it is to hold. Along a period a whole number of cells fits; elsewhere they count from 0.
class Grid {
 public:
  Grid(const RunContext& run, const CellsSpec& spec)
      : dimensions_(static_cast<std::size_t>(run.facts.dimensions)) {
    double cells = 1;
    for (std::size_t k = 0; k < dimensions_; ++k) {
      side_[k] = k == 0 ? spec.width_x.value_or(spec.width) : spec.width;
      const double low = run.facts.domain[2 * k], high = run.facts.domain[2 * k + 1];
      if (!(high > low)) continue;
      origin_[k] = low;
      cells *= std::max(1.0, (high - low) / side_[k]);
      refuse_too_many(cells);
      count_[k] = std::max(1, static_cast<int>(std::lround((high - low) / side_[k])));
      side_[k] = (high - low) / count_[k];
      fixed_[k] = true;
    }
    sums_.resize(total());
  }

  void sample(const GrainsView& grains) {
    if (grains.moving == 0) return;
    make_room(grains);
    for (std::size_t i = 0; i < grains.moving; ++i) {
      std::size_t at = 0;
      for (std::size_t k = dimensions_; k-- > 0;) {
        const int index = std::clamp(index_of(k, grains.position[k][i]) - first_[k], 0, count_[k] - 1);
        at = at * static_cast<std::size_t>(count_[k]) + static_cast<std::size_t>(index);
      }
      add(sums_[at], grains, i);
    }
  }
  void clear() { std::fill(sums_.begin(), sums_.end(), CellSums{}); }

  io::CellFields fields(double time, double samples) const;

  template <class Archive>
  void serialize(Archive& a) {
    a(first_, count_, sums_);
  }

 private:
  std::size_t dimensions_;
  std::array<double, 3> origin_{}, side_{1, 1, 1};
  std::array<int, 3> first_{}, count_{1, 1, 1};
  std::array<bool, 3> fixed_{};
  bool empty() const {
    return std::all_of(sums_.begin(), sums_.end(), [](const auto& s) { return s.number == 0; });
  }
  std::vector<CellSums> sums_;

  /// Their sums would take more than a gigabyte, and a file that nobody opens.
  static void refuse_too_many(double cells) {
    constexpr double most = 1e7;
    if (cells > most)
      throw InputError(fmt::format(
          "output.cells.width: {:.2g} cells lie where grains are, at most {:.0e} can be summed; give a larger width",
          cells, most));
  }
  std::size_t total() const {
    return static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
           static_cast<std::size_t>(count_[2]);
  }
  int index_of(std::size_t k, double x) const {
    constexpr double most = 1e6;  // cells along an axis; a grain that is lost far away is counted at the edge
    return static_cast<int>(std::clamp(std::floor((x - origin_[k]) / side_[k]), -most, most));
  }
  static void add(CellSums& s, const GrainsView& grains, std::size_t i) {
    const double m = grains.mass[i], R = grains.radius[i];
    s.number += 1;
    s.content += filled_by(R, grains.dimensions);
    s.mass += m;
    std::array<double, 3> v{};
    for (std::size_t k = 0; k < 3; ++k)
      if (!grains.velocity[k].empty()) v[k] = grains.velocity[k][i];
    for (std::size_t k = 0; k < 3; ++k) s.momentum[k] += m * v[k];
    for (std::size_t t = 0; t < 6; ++t) s.flux[t] += m * v[tensor[t][0]] * v[tensor[t][1]];
    for (const auto& spin : grains.spin)
      if (!spin.empty()) s.spinning += grains.inertia[i] * spin[i] * spin[i];
  }
  void make_room(const GrainsView& grains);
};

void Grid::make_room(const GrainsView& grains) {
  auto first = first_, count = count_;
  const bool nothing = empty() && total() == 1;
  for (std::size_t k = 0; k < dimensions_; ++k) {
    if (fixed_[k]) continue;
    const auto x = grains.position[k].subspan(0, grains.moving);
    const auto [least, most] = std::minmax_element(x.begin(), x.end());
    int low = index_of(k, *least), high = index_of(k, *most);
    if (!nothing) low = std::min(low, first_[k]), high = std::max(high, first_[k] + count_[k] - 1);
    first[k] = low, count[k] = high - low + 1;
  }
  if (first == first_ && count == count_) return;
  refuse_too_many(static_cast<double>(count[0]) * count[1] * count[2]);
  const auto old = std::exchange(sums_, {});
  const auto old_first = std::exchange(first_, first), old_count = std::exchange(count_, count);
  sums_.resize(total());
  if (old.size() == 1 && old[0].number == 0) return;
  for (int z = 0; z < old_count[2]; ++z)
    for (int y = 0; y < old_count[1]; ++y)
      for (int x = 0; x < old_count[0]; ++x) {
        const std::array<int, 3> at{x, y, z};
        std::size_t to = 0, from = 0;
        for (std::size_t k = 3; k-- > 0;) {
          to = to * static_cast<std::size_t>(count_[k]) +
               static_cast<std::size_t>(at[k] + old_first[k] - first_[k]);
          from = from * static_cast<std::size_t>(old_count[k]) + static_cast<std::size_t>(at[k]);
        }
        sums_[to] = old[from];
      }
}

io::CellFields Grid::fields(double time, double samples) const {
  io::CellFields cells;
  cells.time = time;
  cells.count = count_, cells.side = side_;
  double volume = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    cells.origin[k] = origin_[k] + first_[k] * side_[k];
    if (k < dimensions_) volume *= side_[k];
  }
  const auto D = static_cast<double>(dimensions_), turns = dimensions_ == 2 ? 1.0 : 3.0;
  // Where no grain was there is no velocity and no temperature: not a number, which pictures leave blank.
  const auto field = [&](const char* name, int components, auto&& value) {
    auto& f = cells.fields.emplace_back(io::CellFields::Field{name, components, {}});
    for (const auto& s : sums_)
      for (int k = 0; k < components; ++k) f.values.push_back(value(s, static_cast<std::size_t>(k)));
  };
  const auto excess = [](const CellSums& s, std::size_t t) {  // Σ m (v − u)(v − u)
    return s.mass > 0 ? s.flux[t] - s.momentum[tensor[t][0]] * s.momentum[tensor[t][1]] / s.mass : 0;
  };
  field("number", 1, [&](const CellSums& s, std::size_t) { return s.number / samples; });
  field("density", 1, [&](const CellSums& s, std::size_t) { return s.mass / (samples * volume); });
  field("packing_fraction", 1,
        [&](const CellSums& s, std::size_t) { return s.content / (samples * volume); });
  field("velocity", 3,
        [&](const CellSums& s, std::size_t k) { return s.mass > 0 ? s.momentum[k] / s.mass : NAN; });
  field("temperature", 1, [&](const CellSums& s, std::size_t) {
    return s.number > 0 ? (excess(s, 0) + excess(s, 1) + excess(s, 2)) / (D * s.number) : NAN;
  });
  field("temperature_rotation", 1,
        [&](const CellSums& s, std::size_t) { return s.number > 0 ? s.spinning / (turns * s.number) : NAN; });
  field("kinetic_stress", 6,
        [&](const CellSums& s, std::size_t t) { return excess(s, t) / (samples * volume); });
  return cells;
}

class Cells final : public Remembering<Cells> {
 public:
  Cells(const RunContext& run, const CellsSpec& spec)
      : run_(run),
        due_(run.schedule(std::max(0.0, spec.from - first_wait(spec)),
                          spec.every / static_cast<double>(spec.samples))),
        files_(run.schedule(spec.from, spec.every)),
        grid_(run, spec) {}

  std::int64_t next_after(std::int64_t step) const override {
    return std::min(due_.after(step), files_.after(step));
  }
  void look(const Look& look) override {
    const auto file = files_.index_at(look.engine.step());
    if (due_.index_at(look.engine.step()) < 0 && file < 0) return;
    grid_.sample(look.engine.grains());
    // Counted here, because a first file at the start has fewer looks behind it than the others.
    ++sampled_;
    if (file < 0) return;
    run_.write_once(
        name(times_.size()),
        io::cells_vti(grid_.fields(look.engine.time(), static_cast<double>(sampled_)), run_.facts));
    times_.push_back(look.engine.time());
    sampled_ = 0;
    grid_.clear();
  }
  void write(const Flow&) const override {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < times_.size(); ++k) names.push_back(name(k));
    run_.write("cells.pvd", pvd(times_, names));
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(grid_, times_, sampled_);
  }

 private:
  const RunContext& run_;
  Schedule due_, files_;
  Grid grid_;
  std::vector<double> times_;
  std::int64_t sampled_ = 0;

  /// From the first look to the first file.
  static double first_wait(const CellsSpec& spec) {
    return spec.every * static_cast<double>(spec.samples - 1) / static_cast<double>(spec.samples);
  }
  static std::string name(std::size_t k) { return fmt::format("cells/{:06}.vti", k); }
};

}  // namespace

std::vector<std::unique_ptr<Observer>> CellsOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<Cells>(run, *spec));
  return observers;
}

}  // namespace chute::measure
