#include "measure/pair_distances.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <numbers>
#include <numeric>

namespace chute::measure {
namespace {

/// Volume (area) of the unit ball.
double unit_ball(int dimensions) { return dimensions == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3; }

}  // namespace

PairDistances::PairDistances(double reach, double bin, const Window& window)
    : reach_(reach),
      bin_(bin),
      bins_(static_cast<std::size_t>(std::floor((reach - 1) / bin))),
      blocks_(window) {}

void PairDistances::add(const GrainsView& grains) {
  auto& counts = blocks_.sample(grains.time);
  counts.resize(bins_);
  dimensions_ = grains.dimensions;
  const std::size_t n = grains.moving;
  double volume = 1, body = 0, largest = 0;
  std::array<double, 4> moment{};  // means of R^k
  for (int k = 0; k < dimensions_; ++k)
    volume *= grains.period[static_cast<std::size_t>(k)];  // 0 if it does not repeat
  for (std::size_t i = 0; i < n; ++i) {
    const double R = grains.radius[i];
    largest = std::max(largest, R);
    body += unit_ball(dimensions_) * std::pow(R, dimensions_);
    for (std::size_t k = 0; k < 4; ++k)
      moment[k] += std::pow(R, static_cast<double>(k)) / static_cast<double>(n);
  }
  phi_ = body / volume;
  const double contact = dimensions_ == 2
                             ? 2 * (moment[2] + moment[1] * moment[1])
                             : 2 * moment[3] + 6 * moment[2] * moment[1];  // mean of (R_i + R_j)^D
  expected_ =
      static_cast<double>(n) * static_cast<double>(n - 1) / 2 * unit_ball(dimensions_) * contact / volume;

  // In the order of x, partners within reach follow on each other.
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto& x = grains.position[0];
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return x[a] != x[b] ? x[a] < x[b] : a < b; });
  const double period = grains.period[0];
  const double farthest =
      std::min(reach_ * 2 * largest, period > 0 ? period / 2 : std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = order[k];
    for (std::size_t step = 1; step < n; ++step) {
      const bool around = k + step >= n;
      if (around && period == 0) break;
      const std::size_t j = order[(k + step) % n];
      if (x[j] - x[i] + (around ? period : 0) > farthest) break;
      const auto way = grains.way(i, j);
      const double r = std::sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]) /
                       (grains.radius[i] + grains.radius[j]);
      const double bin = (r - 1) / bin_;
      if (bin >= 0 && bin < static_cast<double>(bins_)) counts[static_cast<std::size_t>(bin)] += 1;
    }
  }
}

double PairDistances::expected_in(std::size_t bin) const {
  const double low = 1 + static_cast<double>(bin) * bin_, high = low + bin_;
  return expected_ * (std::pow(high, dimensions_) - std::pow(low, dimensions_));
}

std::vector<PairDistances::Row> PairDistances::result(double start) const {
  const auto stretches = blocks_.stretches(start);
  std::vector<Row> rows;
  if (stretches.empty()) return rows;
  for (std::size_t b = 0; b < bins_; ++b)
    rows.push_back({1 + (static_cast<double>(b) + 0.5) * bin_,
                    estimate_bin<double>(stretches, b, [&](double count, double samples) {
                      return count / (samples * expected_in(b));
                    })});
  return rows;
}

/// ln g as a cubic of the distance from contact, by least squares over bins near it; the variance of ln g in a bin is one
/// over its count.
double PairDistances::contact_value(const std::vector<double>& counts, double samples) const {
  constexpr double range = 0.25;
  constexpr int terms = 4;
  Eigen::Matrix<double, terms, terms> matrix = Eigen::Matrix<double, terms, terms>::Zero();
  Eigen::Vector<double, terms> right = Eigen::Vector<double, terms>::Zero();
  for (std::size_t b = 0; b < bins_ && (static_cast<double>(b) + 1) * bin_ <= range * (1 + 1e-9); ++b) {
    if (counts[b] == 0) continue;
    Eigen::Vector<double, terms> powers;
    const double x = (static_cast<double>(b) + 0.5) * bin_ / range;
    for (int k = 0; k < terms; ++k) powers[k] = std::pow(x, k);
    matrix += counts[b] * powers * powers.transpose();
    right += counts[b] * std::log(counts[b] / (samples * expected_in(b))) * powers;
  }
  return std::exp(matrix.ldlt().solve(right)[0]);
}

PairDistances::Contact PairDistances::contact(double start) const {
  Blocks<double>::Part all;
  std::vector<double> values;
  for (const auto& stretch : blocks_.stretches(start)) {
    all += stretch;
    values.push_back(contact_value(stretch.bins, stretch.samples));
  }
  Contact contact{phi_, {}, {}};
  if (values.empty()) return contact;
  contact.g = {contact_value(all.bins, all.samples), estimate_of(values).error};
  const double per_g = (dimensions_ == 2 ? 2 : 4) * phi_;
  contact.Z.mean = 1 + per_g * contact.g.mean;
  if (contact.g.error) contact.Z.error = per_g * *contact.g.error;
  return contact;
}

namespace {

class PairObserver final : public Remembering<PairObserver> {
 public:
  PairObserver(const RunContext& run, const PairSpec& spec)
      : run_(run),
        from_(spec.from),
        due_(run.schedule(spec.from.value_or(0), spec.every)),
        pairs_(spec.reach, spec.bin, run.window(spec.from)) {}

  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }
  void look(const Look& look) override {
    if (due_.index_at(look.engine.step()) >= 0) pairs_.add(look.engine.grains());
  }
  void write(const Flow& flow) const override {
    const double start = from_.value_or(flow.from);
    auto comments = run_.comments("pair distribution g of moving grains against r, in units of R_i + R_j");
    for (auto& line : run_.average_note(from_, flow)) comments.push_back(std::move(line));
    io::Csv csv(comments, {"r", "g", "g_err"});
    for (const auto& row : pairs_.result(start)) csv.row({row.r, row.g.mean, row.g.error});
    run_.write("pairs.csv", csv.text());
    const auto contact = pairs_.contact(start);
    io::Csv pressure(
        run_.comments("packing fraction, g at contact, and Z = beta P/n of hard grains of one size"),
        {"phi", "g_contact", "g_contact_err", "Z", "Z_err"});
    pressure.row({contact.phi, contact.g.mean, contact.g.error, contact.Z.mean, contact.Z.error});
    run_.write("pressure.csv", pressure.text());
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(pairs_);
  }

 private:
  const RunContext& run_;
  From from_;
  Schedule due_;
  PairDistances pairs_;
};

}  // namespace

std::vector<std::unique_ptr<Observer>> PairsOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<PairObserver>(run, *spec));
  return observers;
}

}  // namespace chute::measure
