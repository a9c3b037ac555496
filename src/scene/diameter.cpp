#include "scene/diameter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/csv_columns.hpp"
#include "common/error.hpp"

namespace chute::scene {
namespace {

constexpr double farthest = 3;  // standard deviations

double cut_normal(Random& random) {
  for (;;)
    if (const double z = random.normal(); std::abs(z) <= farthest) return z;
}
double gaussian_below(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }
/// Standard deviation of ln d.
double log_std(const Diameter& d) { return std::sqrt(std::log1p(d.std * d.std / (d.mean * d.mean))); }

/// Sizes and weights of a CSV file with these columns.
void read_sizes(const std::string& file, Diameter& diameter) {
  const auto columns = read_csv_columns(file, {"diameter", "weight"});
  diameter.sizes = columns[0], diameter.weights = columns[1];
}

template <class Archive>
void describe_rest(Archive& a, Diameter& d) {
  using Kind = Diameter::Kind;
  const bool all = std::same_as<Archive, KeyLister>;
  if (all || d.kind == Kind::gaussian || d.kind == Kind::lognormal) {
    a.required("mean", d.mean, positive, "mean diameter");
    a.value("std", d.std, non_negative, "standard deviation; cut off at three of them");
    a.check(d.kind != Kind::gaussian || 3 * d.std < d.mean, "std",
            "must be less than a third of the mean: sizes are cut off at three standard deviations");
  }
  if (all || d.kind == Kind::uniform) {
    a.required("from", d.from, positive, "smallest diameter, of a uniform distribution");
    a.required("to", d.to, positive, "largest diameter, of a uniform distribution");
    a.check(d.from <= d.to, "to", fmt::format("{} is less than from", d.to));
  }
  if (all || d.kind == Kind::table) {
    a.value("sizes", d.sizes, positive, "diameters, of a table");
    a.value("weights", d.weights, non_negative, "how many grains have each of the sizes, of any sum");
  }
}

}  // namespace

void describe(TomlReader& a, Diameter& d) {
  a.choice("kind", d.kind, Diameter::kinds);
  describe_rest(a, d);
  if (d.kind != Diameter::Kind::table) return;
  std::optional<std::string> file;
  a.value("file", file);
  if (file) {
    a.check(!a.has("sizes") && !a.has("weights"), "file", "give either a file or sizes and weights");
    try {
      read_sizes(*file, d);
    } catch (const InputError& error) {
      a.fail("file", error.what());
    }
  }
  const char* at = file ? "file" : "sizes";
  a.check(!d.sizes.empty(), at,
          "missing: which diameters are there? Give sizes and weights, or a file of them");
  a.check(d.sizes.size() == d.weights.size(), file ? "file" : "weights",
          fmt::format("{} weights for {} sizes", d.weights.size(), d.sizes.size()));
  a.check(*std::ranges::min_element(d.sizes) > 0, at, "a diameter must be > 0");
  a.check(*std::ranges::min_element(d.weights) >= 0 &&
              std::accumulate(d.weights.begin(), d.weights.end(), 0.0) > 0,
          file ? "file" : "weights", "weights must be >= 0, and one of them > 0");
}
void describe(TomlWriter& a, Diameter& d) {
  if (d.kind != Diameter::Kind::gaussian) a.choice("kind", d.kind, Diameter::kinds);
  describe_rest(a, d);
}
void describe(KeyLister& a, Diameter& d) {
  a.choice("kind", d.kind, Diameter::kinds, "what the diameters are spread like");
  describe_rest(a, d);
  std::optional<std::string> file;
  a.value("file", file, "a CSV table with columns diameter and weight, instead of sizes and weights");
}

double Diameter::average() const {
  switch (kind) {
    case Kind::gaussian:
      return mean;
    case Kind::uniform:
      return (from + to) / 2;
    case Kind::lognormal: {
      const double s = log_std(*this);
      return mean * (gaussian_below(farthest - s) - gaussian_below(-farthest - s)) /
             (gaussian_below(farthest) - gaussian_below(-farthest));
    }
    case Kind::table:
      return std::inner_product(sizes.begin(), sizes.end(), weights.begin(), 0.0) /
             std::accumulate(weights.begin(), weights.end(), 0.0);
  }
  return mean;
}

double Diameter::draw(Random& random) const {
  switch (kind) {
    case Kind::gaussian:
      return std > 0 ? mean + std * cut_normal(random) : mean;
    case Kind::uniform:
      return random.uniform(from, to);
    case Kind::lognormal: {
      const double s = log_std(*this);
      return s > 0 ? mean * std::exp(s * cut_normal(random) - s * s / 2) : mean;
    }
    case Kind::table:
      break;
  }
  double left = random.uniform() * std::accumulate(weights.begin(), weights.end(), 0.0);
  std::size_t last = 0;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    if (weights[k] == 0) continue;
    last = k;
    if (left < weights[k]) break;
    left -= weights[k];
  }
  return sizes[last];
}

}  // namespace chute::scene
