#include "measure/diffusion.hpp"

#include "measure/ball_outputs.hpp"
#include "measure/standstill.hpp"

namespace chute::measure {

Diffusion::Diffusion(double every, double longest, const Window& window) : every_(every), blocks_(window) {
  constexpr double finely = 1.25;  // from length to length
  const auto last = std::llround(longest / every);
  for (double length = 1; std::llround(length) < last; length *= finely)
    if (lengths_.empty() || lengths_.back() < std::llround(length)) lengths_.push_back(std::llround(length));
  lengths_.push_back(last);
}

void Diffusion::add(std::size_t grain, double time, const std::array<double, 2>& place) {
  if (grains_.size() <= grain) grains_.resize(grain + 1);
  Grain& g = grains_[grain];
  if (g.looks == 0) {
    g.begin.assign(lengths_.size(), place);
  } else {
    auto& sums = blocks_.sample(time);
    sums.resize(lengths_.size());
    for (std::size_t k = 0; k < lengths_.size(); ++k) {
      if (g.looks % lengths_[k] != 0) continue;
      sums[k].pieces += 1;
      for (std::size_t c = 0; c < 2; ++c) {
        const double way = place[c] - g.begin[k][c];
        sums[k].way[c] += way, sums[k].square[c] += way * way;
      }
      g.begin[k] = place;
    }
  }
  ++g.looks;
}

Diffusion::Result Diffusion::result() const {
  Result result{};
  result.longest = static_cast<double>(lengths_.back()) * every_;
  const auto stretches = blocks_.stretches();
  if (stretches.empty()) return result;
  const auto length = [&](std::size_t k) { return static_cast<double>(lengths_[k]) * every_; };
  result.drift = estimate_bin<PieceSums>(
      stretches, 0, [&](const PieceSums& s, double) { return s.way[0] / s.pieces / length(0); });
  const auto square = [&](std::size_t k, std::size_t c, const PieceSums& s) {
    const double drift = c == 0 ? result.drift.mean * length(k) : 0;
    return s.square[c] / s.pieces - 2 * drift * s.way[c] / s.pieces + drift * drift;
  };
  for (std::size_t k = 0; k < lengths_.size(); ++k) {
    Row row{length(k), 0, {}};
    for (const auto& part : stretches) row.pieces += part.bins[k].pieces;
    for (std::size_t c = 0; c < 2; ++c)
      row.square[c] =
          estimate_bin<PieceSums>(stretches, k, [&](const PieceSums& s, double) { return square(k, c, s); });
    result.rows.push_back(row);
  }
  // The slope 2D of a line through the mean squares at long times, each as weighty as it has pieces; the error from the
  // stretches of the run apart.
  constexpr double long_part = 1.0 / 6;
  const auto slope = [&](std::size_t c, const std::vector<PieceSums>& bins) {
    double n = 0, t = 0, s = 0, tt = 0, ts = 0;
    for (std::size_t k = 0; k < lengths_.size(); ++k) {
      if (length(k) < long_part * result.longest || bins[k].pieces == 0) continue;
      const double w = bins[k].pieces, y = square(k, c, bins[k]);
      n += w, t += w * length(k), s += w * y, tt += w * length(k) * length(k), ts += w * length(k) * y;
    }
    return (n * ts - t * s) / (n * tt - t * t) / 2;
  };
  std::vector<PieceSums> all(lengths_.size());
  for (const auto& part : stretches)
    for (std::size_t k = 0; k < all.size(); ++k) all[k] += part.bins[k];
  for (std::size_t c = 0; c < 2; ++c) {
    std::vector<double> slopes;
    for (const auto& part : stretches)
      if (const double D = slope(c, part.bins); std::isfinite(D)) slopes.push_back(D);
    result.D[c] = {slope(c, all), estimate_of(slopes).error};
    constexpr double near = 0.25;
    result.diffusive_from[c] = result.longest;
    for (std::size_t k = lengths_.size(); k-- > 0;) {
      const double D = result.rows[k].square[c].mean / (2 * length(k));
      if (!(std::abs(D - result.D[c].mean) < near * result.D[c].mean)) break;
      result.diffusive_from[c] = length(k);
    }
  }
  return result;
}

namespace {

class DiffusionObserver final : public Remembering<DiffusionObserver> {
 public:
  DiffusionObserver(const RunContext& run, const DiffusionSpec& spec)
      : run_(run),
        due_(run.schedule(spec.from, spec.every)),
        rest_(run.frame.bead_spacing, run.gravity),
        diffusion_(spec.every, spec.longest, run.window(spec.from)) {}

  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }
  void look(const Look& look) override {
    if (due_.index_at(look.engine.step()) < 0) return;
    const auto grains = look.engine.grains();
    rest_.note(grains);
    for (std::size_t i = 0; i < grains.moving; ++i)
      pending_.add(i, grains.time,
                   {grains.unwrapped(i, 0), run_.frame.has_lateral() ? grains.unwrapped(i, 1) : 0});
    pending_.release(grains.time, rest_, [&](std::size_t i, double time, const std::array<double, 2>& place) {
      diffusion_.add(i, time, place);
    });
  }
  void write(const Flow&) const override {
    const auto result = diffusion_.result();
    io::Csv table(
        run_.comments(
            "mean squares of the displacement in pieces of a time, along about the mean drift and across; "
            "errors from blocks of the time window"),
        {run_.offers.clock, "pieces", "square_x", "square_x_err", "square_y", "square_y_err"});
    for (const auto& row : result.rows)
      table.row({row.time, row.pieces, row.square[0].mean, row.square[0].error, row.square[1].mean,
                 row.square[1].error});
    run_.write("diffusion.csv", table.text());
    io::Csv coefficients(
        run_.comments(
            "(4.65), (4.66): half the slopes of the mean squares over pieces from a sixth of the longest "
            "on; from: from which length on <..^2>/2t stays within a quarter of it"),
        {"v_x", "v_x_err", "D_x", "D_x_err", "D_y", "D_y_err", "from_x", "from_y", "longest"});
    coefficients.row({result.drift.mean, result.drift.error, result.D[0].mean, result.D[0].error,
                      result.D[1].mean, result.D[1].error, result.diffusive_from[0], result.diffusive_from[1],
                      result.longest});
    run_.write(diffusion_coefficients_file, coefficients.text());
  }
  template <class Archive>
  void serialize(Archive& a) {
    a(rest_, pending_, diffusion_);
  }

 private:
  const RunContext& run_;
  Schedule due_;
  Standstill rest_;
  Pending<std::array<double, 2>> pending_;
  Diffusion diffusion_;
};

}  // namespace

std::vector<std::unique_ptr<Observer>> DiffusionOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<DiffusionObserver>(run, *spec));
  return observers;
}

}  // namespace chute::measure
