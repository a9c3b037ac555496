#include "figures/extract_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>

#include "common/error.hpp"
#include "core/estimate.hpp"
#include "read/image_data.hpp"
#include "read/run_frames.hpp"
#include "read/table.hpp"

namespace chute::figures {
namespace fs = std::filesystem;
namespace {

/// A field against x at one time.
struct Line {
  double time;
  std::vector<double> x, y;
};

std::vector<Line> lines_of(const fs::path& run, const std::string& field) {
  std::vector<Line> lines;
  for (const auto& file : read::read_pvd(run / "cells.pvd")) {
    const auto grid = read::field_of(read::read_image_data(file.path), field, file.path);
    Line line{file.time.value_or(grid.time.value_or(0)), {}, {}};
    const auto nx = static_cast<std::size_t>(grid.count[0]);
    for (std::size_t i = 0; i < nx; ++i) {
      double sum = 0, known = 0;
      for (std::size_t at = i; at < grid.values.size(); at += nx)
        if (std::isfinite(grid.values[at])) sum += grid.values[at], ++known;
      line.x.push_back(grid.first[0] + static_cast<double>(i) * grid.step[0]);
      line.y.push_back(known > 0 ? sum / known : 0);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

/// The discrete Fourier transform of values whose number is a power of two, in place.
void transform(std::vector<std::complex<double>>& a) {
  const std::size_t n = a.size();
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    std::size_t bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(a[i], a[j]);
  }
  for (std::size_t size = 2; size <= n; size <<= 1) {
    const auto root = std::polar(1.0, -2 * std::numbers::pi / static_cast<double>(size));
    for (std::size_t begin = 0; begin < n; begin += size) {
      std::complex<double> w = 1;
      for (std::size_t k = begin; k < begin + size / 2; ++k, w *= root) {
        const auto even = a[k], odd = w * a[k + size / 2];
        a[k] = even + odd, a[k + size / 2] = even - odd;
      }
    }
  }
}

/// Edges of bins on a logarithmic axis: eight to a decade from 1 on, whole numbers.
std::vector<double> size_bins(double largest) {
  std::vector<double> edges{1};
  for (int k = 1; edges.back() <= largest; ++k) {
    const double edge = std::ceil(std::pow(10, k / 8.0));
    if (edge > edges.back()) edges.push_back(edge);
  }
  return edges;
}

}  // namespace

std::vector<FigureRow> field_map(const Curve& curve, std::span<const fs::path> runs) {
  std::vector<FigureRow> rows;
  for (const auto& line : lines_of(runs.front(), curve.column)) {
    const auto name = fmt::format("{} t={}", curve.series, line.time);
    for (std::size_t i = 0; i < line.x.size(); ++i) rows.push_back({curve.panel, name, line.x[i], line.y[i]});
  }
  return rows;
}

std::vector<FigureRow> spectrum(const Curve& curve, std::span<const fs::path> runs) {
  constexpr double per_decade = 8;
  std::map<int, std::vector<double>> of_bin;  // of each run
  std::map<int, double> middle;
  for (const auto& run : runs) {
    const auto lines = lines_of(run, curve.column);
    std::size_t n = 1;
    while (2 * n <= lines.size()) n *= 2;
    if (n < 16)
      throw WorkError(fmt::format("series {}: a spectrum needs 16 files of cells at least", curve.series));
    const auto last = lines.size() - n;  // the begin is left out
    const double step = (lines.back().time - lines[last].time) / static_cast<double>(n - 1);
    std::vector<double> power(n / 2);
    const std::size_t places = lines.front().x.size();
    for (std::size_t x = 0; x < places; ++x) {
      std::vector<std::complex<double>> values(n);
      double mean = 0;
      for (std::size_t t = 0; t < n; ++t) mean += lines[last + t].y[x] / static_cast<double>(n);
      // Hann's window, so that what does not repeat leaks little into other frequencies.
      for (std::size_t t = 0; t < n; ++t)
        values[t] =
            (lines[last + t].y[x] - mean) *
            (1 - std::cos(2 * std::numbers::pi * (static_cast<double>(t) + 0.5) / static_cast<double>(n)));
      transform(values);
      for (std::size_t f = 1; f < n / 2; ++f)
        power[f] += std::norm(values[f]) * step / (1.5 * static_cast<double>(n * places));
    }
    std::map<int, std::pair<double, double>> sums;
    for (std::size_t f = 1; f < n / 2; ++f) {
      const double frequency = static_cast<double>(f) / (static_cast<double>(n) * step);
      const int bin = static_cast<int>(std::floor(per_decade * std::log10(frequency)));
      sums[bin].first += power[f], ++sums[bin].second;
    }
    for (const auto& [bin, sum] : sums)
      of_bin[bin].push_back(sum.first / sum.second), middle[bin] = std::pow(10, (bin + 0.5) / per_decade);
  }
  std::vector<FigureRow> rows;
  for (const auto& [bin, values] : of_bin) {
    const auto [mean, error] = estimate_of(values);
    rows.push_back({curve.panel, curve.series, middle[bin], mean, {}, error});
  }
  return rows;
}

std::vector<FigureRow> avalanche_sizes(const Curve& curve, std::span<const fs::path> runs) {
  double largest = 1;
  std::vector<read::Table> tables;
  for (const auto& run : runs) {
    tables.push_back(read::read_table(run / "avalanches.csv"));
    largest = std::max(largest, tables.back().column("size").back());
  }
  const auto edges = size_bins(largest);
  const double tau = curve.collapse ? (*curve.collapse)[0] : 0, D = curve.collapse ? (*curve.collapse)[1] : 0;
  std::vector<FigureRow> rows;
  for (std::size_t b = 0; b + 1 < edges.size(); ++b) {
    std::vector<double> densities;
    double seen = 0;
    for (const auto& table : tables) {
      const auto size = table.column("size"), count = table.column("count");
      double all = 0, here = 0;
      for (std::size_t i = 0; i < size.size(); ++i) {
        all += count[i];
        if (size[i] >= edges[b] && size[i] < edges[b + 1]) here += count[i];
      }
      densities.push_back(here / (all * (edges[b + 1] - edges[b])));
      seen += here;
    }
    constexpr double fewest = 5;  // avalanches that make a bin worth a point
    if (seen < fewest) continue;
    const double s = std::sqrt(edges[b] * (edges[b + 1] - 1));
    const auto [mean, error] = estimate_of(densities);
    const double scale = std::pow(s, tau);
    rows.push_back({curve.panel,
                    curve.series,
                    s / std::pow(curve.length, D),
                    scale * mean,
                    {},
                    error ? std::optional(scale * *error) : std::nullopt});
  }
  return rows;
}

std::vector<FigureRow> mean_avalanche(const Curve& curve, std::span<const fs::path> runs) {
  std::vector<double> means;
  for (const auto& run : runs) {
    const auto table = read::read_table(run / "avalanches.csv");
    const auto size = table.column("size"), count = table.column("count");
    double all = 0, sum = 0;
    for (std::size_t i = 0; i < size.size(); ++i) all += count[i], sum += size[i] * count[i];
    means.push_back(sum / all);
  }
  const auto [mean, error] = estimate_of(means);
  return {{curve.panel, curve.series, curve.length, mean, {}, error}};
}

}  // namespace chute::figures
